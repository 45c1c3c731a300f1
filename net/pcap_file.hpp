/// UDP datagrams in pcap files: what a recorded flight is. Reads pcap and pcapng; writes pcap that any packet
/// tool opens.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include <tl/expected.hpp>

namespace eyepoint::net {

struct CapturedDatagram {
    std::int64_t time_ns = 0;  ///< of capture, since 1970-01-01 UTC
    /// IPv4 addresses in the order they are written; 0.0.0.0 where the capture has IPv6.
    std::array<std::uint8_t, 4> source_address{127, 0, 0, 1};
    std::array<std::uint8_t, 4> destination_address{127, 0, 0, 1};
    std::uint16_t source_port = 0;
    std::uint16_t destination_port = 0;
    std::vector<std::byte> payload;
};

struct PcapRecording {
    std::vector<CapturedDatagram> datagrams;  ///< in the order of the file
    std::uint64_t other_packets = 0;          ///< not UDP over IP, or malformed; skipped
    std::uint64_t fragments = 0;              ///< of fragmented IP datagrams; skipped
    std::uint64_t cut_packets = 0;  ///< caught with a snapshot length shorter than they were; skipped
    bool truncated = false;         ///< the file ends in the middle of a packet; what came before is here
};

/// Reads every UDP datagram of a capture (Ethernet with or without VLAN tags, Linux cooked v1 and v2, raw IP,
/// BSD loopback; IPv4 and IPv6). On failure: one sentence that names the file.
[[nodiscard]] tl::expected<PcapRecording, std::string> read_pcap(const std::filesystem::path& file);

/// Writes Ethernet/IPv4/UDP packets with checksums, times to the microsecond. The file stands under its name
/// only after finish(); a writer destroyed before that leaves nothing. Movable. Thread use: one thread at a
/// time.
class PcapWriter {
  public:
    [[nodiscard]] static tl::expected<PcapWriter, std::string> create(const std::filesystem::path& file);
    PcapWriter(PcapWriter&&) noexcept;
    PcapWriter& operator=(PcapWriter&&) noexcept;
    ~PcapWriter();

    /// The payload may be at most 65,507 bytes, as UDP over IPv4 has it.
    [[nodiscard]] tl::expected<void, std::string> write(const CapturedDatagram& datagram);

    /// Brings everything to the disk and gives the file its name.
    [[nodiscard]] tl::expected<void, std::string> finish();

  private:
    struct Output;
    explicit PcapWriter(std::unique_ptr<Output> output);
    std::unique_ptr<Output> output_;
};

}  // namespace eyepoint::net
