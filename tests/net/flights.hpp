/// Recorded flights for tests: the sample in the tree, and the captures beside the real data where there are
/// some.
#pragma once

#include <cstdlib>
#include <filesystem>
#include <optional>
#include <stdexcept>
#include <vector>

#include "net/pcap_file.hpp"

namespace eyepoint::net::testing {

inline std::filesystem::path sample_flight() {
    return std::filesystem::path(EYEPOINT_SOURCE_DIR) / "tools/flights/goms-c172-60s-30hz.pcap";
}

/// The folder of captures, or nullopt where EYEPOINT_REAL_DATA is not set.
inline std::optional<std::filesystem::path> captures_folder() {
    const char* data = std::getenv("EYEPOINT_REAL_DATA");
    if (data == nullptr || *data == '\0') return std::nullopt;
    return std::filesystem::path(data) / ".." / "flights";
}

inline std::vector<CapturedDatagram> datagrams_to(const std::filesystem::path& file, std::uint16_t port) {
    auto recording = read_pcap(file);
    if (!recording) throw std::runtime_error(recording.error());
    std::vector<CapturedDatagram> chosen;
    for (auto& datagram : recording->datagrams) {
        if (datagram.destination_port == port) chosen.push_back(std::move(datagram));
    }
    return chosen;
}

}  // namespace eyepoint::net::testing
