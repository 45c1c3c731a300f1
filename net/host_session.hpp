/// One host: datagrams in, the state in force and what to answer out. No sockets, no clock: pure, so that it
/// is tested and fuzzed without either.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <tl/expected.hpp>

#include "net/drop_reason.hpp"
#include "net/frame_order.hpp"
#include "net/host_state.hpp"
#include "net/wire/cigi_packets.hpp"

namespace eyepoint::net {

struct SessionCounters {
    std::uint64_t datagrams = 0;
    std::uint64_t applied = 0;
    std::array<std::uint64_t, static_cast<std::size_t>(DropReason::Count)> dropped{};
    [[nodiscard]] std::uint64_t dropped_total() const;
};

/// What the IG says of itself in CIGI's Start Of Frame.
struct IgStatus {
    std::uint32_t ig_frame = 0;
    IgMode mode = IgMode::Standby;
    std::int8_t database = 0;  ///< CIGI database number: loaded, -n loading, -128 not available
    std::uint8_t status_code = 0;
    std::uint32_t timestamp_10us = 0;
};

/// Result of one datagram: applied (perhaps with packets in it dropped), or dropped whole.
struct Reception {
    bool applied = false;
    std::optional<DropReason> dropped;  ///< the first reason met
    std::string detail;  ///< for the log: what came and what was expected; empty when nothing was dropped
};

class HostSession {
  public:
    /// Takes one datagram. Only a datagram that is valid as a whole position changes an entity: the last good
    /// eye stays. Never throws, never reads outside `bytes`.
    Reception receive(std::span<const std::byte> bytes, ArrivalTime arrival);

    /// nullptr until a host has spoken validly.
    [[nodiscard]] const HostState* state() const;
    [[nodiscard]] const SessionCounters& counters() const { return counters_; }

    /// The Start Of Frame datagram for the host (3.3 layout; 16-byte layout for a 3.0/3.1 host), in the
    /// host's byte order; before the first host message little-endian 3.3.
    [[nodiscard]] std::vector<std::byte> start_of_frame(const IgStatus& status) const;

  private:
    Reception receive_fgnetfdm(std::span<const std::byte> bytes, ArrivalTime arrival);
    Reception receive_cigi(std::span<const std::byte> bytes, ArrivalTime arrival);
    void begin(Protocol protocol);
    std::optional<WireError> obey(const wire::CigiIgControl& control);
    std::optional<WireError> apply_packet(std::uint8_t id, std::span<const std::byte> packet);
    void apply(const wire::CigiEntityControl& control);
    void apply(const wire::CigiRateControl& control);
    void apply(const wire::CigiViewControl& control);
    tl::expected<void, WireError> apply(const wire::CigiViewDefinition& definition);
    void count(Reception& reception, WireError error);

    HostState state_;
    bool spoken_ = false;
    SessionCounters counters_;
    wire::CigiDialect dialect_;
    FrameOrder frame_order_;
    std::optional<std::uint32_t> last_timestamp_10us_;
    std::int64_t host_clock_10us_ = 0;  ///< the timestamps with their wraps taken out
};

}  // namespace eyepoint::net
