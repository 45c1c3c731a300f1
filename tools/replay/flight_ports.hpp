/// What a capture holds, by the UDP port that the datagrams went to.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <tl/expected.hpp>

#include "net/host_session.hpp"
#include "net/pcap_file.hpp"

namespace eyepoint::tools {

/// Lowest and highest of something.
struct Range {
    double lowest = 0.0;
    double highest = 0.0;
};

/// The datagrams to one port, as a host session takes them.
struct PortSummary {
    std::uint16_t port = 0;
    std::uint64_t datagrams = 0;
    double duration_s = 0.0;  ///< from the first to the last
    double median_spacing_s = 0.0;
    Range spacing_s;
    net::SessionCounters counters;
    std::string
        first_drop;  ///< what was wrong with the first datagram that had something wrong; empty: none had
    std::optional<net::Protocol> protocol;  ///< of the last valid datagram
    /// Of the ownship, where there is one. Longitudes are as sent: a flight across the antimeridian spans
    /// -180 to 180.
    std::optional<Range> latitude_deg, longitude_deg, altitude_m;
};

/// One summary a port, by falling count of valid datagrams, then of datagrams.
[[nodiscard]] std::vector<PortSummary> summarize_ports(const net::PcapRecording& recording);

/// The port to replay: the one wanted, else the first of summarize_ports. Refuses a port that nothing was
/// sent to, and a recording without datagrams.
[[nodiscard]] tl::expected<std::uint16_t, std::string> choose_port(const net::PcapRecording& recording,
                                                                   std::optional<std::uint16_t> wanted);

}  // namespace eyepoint::tools
