/// A recorded flight as the eyes it makes, in virtual time: no socket, no clock, the same every time.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <tl/expected.hpp>

#include "ig/eyepoint.hpp"
#include "net/pcap_file.hpp"

namespace eyepoint::ig {

struct FlightEye {
    double time_s = 0.0;  ///< since the flight's first datagram
    std::uint32_t host_frame = 0;
    Eyepoint eyepoint;
};

/// The UDP destination port that most of a recording's datagrams went to; none when it holds no datagram.
[[nodiscard]] std::optional<std::uint16_t> busiest_port(const net::PcapRecording& recording);

/// One eye a frame at a frame rate: the newest that had arrived when the frame began. Frames before the first
/// valid eye are left out. Datagrams for other ports than the given one are passed over. On failure (no valid
/// eye): one sentence.
[[nodiscard]] tl::expected<std::vector<FlightEye>, std::string> fly(const net::PcapRecording& recording,
                                                                    std::uint16_t port,
                                                                    const EyepointReading& reading,
                                                                    PictureSize size, double rate_hz);

}  // namespace eyepoint::ig
