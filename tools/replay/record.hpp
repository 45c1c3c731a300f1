/// Writes what arrives at a UDP port into a pcap file.
#pragma once

#include <cstdint>
#include <filesystem>
#include <limits>
#include <string>

#include <tl/expected.hpp>

#include "tools/replay/stop_signal.hpp"

namespace eyepoint::tools {

struct RecordRequest {
    std::filesystem::path file;
    std::string address = "0.0.0.0";  ///< numeric IPv4 address to listen on
    std::uint16_t port = 0;
    double for_s = std::numeric_limits<double>::infinity();
};

struct RecordReport {
    std::uint64_t packets = 0;
    double seconds = 0.0;  ///< from the first datagram to the last
};

/// Until a signal comes or for_s has passed. Times are the kernel's arrival times. The file appears when
/// recording ends; none appears when nothing came, which is an error. On failure: one sentence.
[[nodiscard]] tl::expected<RecordReport, std::string> record(const RecordRequest& request,
                                                             const StopSignal& stop);

}  // namespace eyepoint::tools
