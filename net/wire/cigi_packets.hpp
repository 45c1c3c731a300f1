/// CIGI 3 packets as values, and Start Of Frame as bytes. Offsets are those of CIGI 3.3; 3.0 to 3.2 differ
/// only in the length of IG Control and Start Of Frame. Source of the layouts: docs/protocols.md.
///
/// Every decoder takes the bytes of exactly one packet, reads nothing outside them, allocates nothing unless
/// it refuses, and checks every number that it returns.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include <tl/expected.hpp>

#include "net/drop_reason.hpp"
#include "net/host_state.hpp"
#include "net/wire/byte_order.hpp"

namespace eyepoint::net::wire {

enum class CigiPacketId : std::uint8_t {
    IgControl = 1,
    EntityControl = 2,
    RateControl = 8,
    ViewControl = 16,
    ViewDefinition = 21,
    StartOfFrame = 101,
};

/// How a host writes CIGI 3, and so how it is answered.
struct CigiDialect {
    ByteOrder order = ByteOrder::Little;
    bool short_layout = false;  ///< 3.0 and 3.1: IG Control and Start Of Frame of 16 bytes
    bool operator==(const CigiDialect&) const = default;
};

inline constexpr std::size_t kIgControlBytes = 24;
inline constexpr std::size_t kShortIgControlBytes = 16;
inline constexpr std::size_t kEntityControlBytes = 48;
inline constexpr std::size_t kRateControlBytes = 32;
inline constexpr std::size_t kViewControlBytes = 32;
inline constexpr std::size_t kViewDefinitionBytes = 32;

struct CigiIgControl {
    CigiDialect dialect;
    std::int8_t database = 0;  ///< 0: no request, 1..127: load that one; negative numbers break the rule
    std::uint8_t mode = 0;     ///< 0 standby, 1 operate, 2 debug; 3 breaks the rule
    bool timestamp_valid = false;
    std::uint32_t host_frame = 0;  ///< 3.0 and 3.1: the frame counter
    std::uint32_t timestamp_10us = 0;
    std::uint32_t last_ig_frame = 0;  ///< 0 in 3.0 and 3.1
};

/// Byte order and layout come from the packet itself (byte-swap magic, size).
[[nodiscard]] tl::expected<CigiIgControl, WireError> decode_ig_control(std::span<const std::byte> packet);

struct CigiEntityControl {
    enum class State : std::uint8_t { Inactive = 0, Active = 1, Destroyed = 2 };
    std::uint16_t entity_id = 0;
    State state = State::Active;
    /// Where a top-level entity is; absent for a child and for one that is destroyed (its numbers are not
    /// looked at).
    std::optional<EntityState> placed;
};
[[nodiscard]] tl::expected<CigiEntityControl, WireError> decode_entity_control(
    std::span<const std::byte> packet, ByteOrder order);

struct CigiRateControl {
    std::uint16_t entity_id = 0;
    bool of_part = false;  ///< of an articulated part of the entity, not of the entity
    EntityRates rates;
};
[[nodiscard]] tl::expected<CigiRateControl, WireError> decode_rate_control(std::span<const std::byte> packet,
                                                                           ByteOrder order);

/// What is not enabled is absent, and its bytes are not looked at.
struct CigiViewControl {
    std::uint16_t view_id = 0;
    std::uint8_t group_id = 0;  ///< not 0: the packet is for a group, and view_id means nothing
    std::uint16_t entity_id = 0;
    std::array<std::optional<double>, 3> offset_m;  ///< forward, right, down
    std::optional<double> roll_deg, pitch_deg, yaw_deg;
};
[[nodiscard]] tl::expected<CigiViewControl, WireError> decode_view_control(std::span<const std::byte> packet,
                                                                           ByteOrder order);

/// What is not enabled is absent, and its bytes are not looked at. Each half angle lies inside -90..90
/// degrees.
struct CigiViewDefinition {
    std::uint16_t view_id = 0;
    std::uint8_t group_id = 0;
    std::optional<double> near_m, far_m;
    std::optional<double> left_deg, right_deg, top_deg, bottom_deg;
};
[[nodiscard]] tl::expected<CigiViewDefinition, WireError> decode_view_definition(
    std::span<const std::byte> packet, ByteOrder order);

struct CigiStartOfFrame {
    std::int8_t database = 0;
    std::uint8_t status_code = 0;
    std::uint8_t mode = 0;
    bool timestamp_valid = true;
    std::uint32_t ig_frame = 0;
    std::uint32_t timestamp_10us = 0;
    std::uint32_t last_host_frame = 0;  ///< not sent in 3.0 and 3.1
    bool operator==(const CigiStartOfFrame&) const = default;
};
[[nodiscard]] std::vector<std::byte> encode_start_of_frame(const CigiStartOfFrame& start,
                                                           CigiDialect dialect);
[[nodiscard]] tl::expected<CigiStartOfFrame, WireError> decode_start_of_frame(
    std::span<const std::byte> packet);

}  // namespace eyepoint::net::wire
