// CIGI 3 packet layouts, as tabled in docs/protocols.md.
#include "net/wire/cigi_packets.hpp"

#include <algorithm>
#include <cmath>
#include <string_view>

#include <fmt/format.h>

#include "net/wire/angles.hpp"
#include "net/wire/fgnetfdm.hpp"

namespace eyepoint::net::wire {
namespace {

constexpr std::uint16_t kMagic = 0x8000;
constexpr std::uint8_t kMajorVersion = 3;
constexpr std::string_view kEntityControl = "Entity Control";
// CIGI's Minor Version as its most used library writes it for 3.3 and 3.1.
constexpr unsigned kMinorVersion33 = 3, kMinorVersion31 = 1;

template <typename... Arguments>
tl::unexpected<WireError> refuse(DropReason reason, fmt::format_string<Arguments...> text,
                                 Arguments&&... arguments) {
    return tl::unexpected(WireError{reason, fmt::format(text, std::forward<Arguments>(arguments)...)});
}

tl::unexpected<WireError> too_small(std::string_view packet, std::size_t size, std::size_t expected) {
    return refuse(DropReason::BadPacketSize, "CIGI {} of {} bytes, expected {}", packet, size, expected);
}

// The order in which the magic number is 0x8000.
tl::expected<ByteOrder, WireError> order_of(std::span<const std::byte> packet) {
    if (ByteReader(packet, ByteOrder::Big).u16(6) == kMagic) return ByteOrder::Big;
    if (ByteReader(packet, ByteOrder::Little).u16(6) == kMagic) return ByteOrder::Little;
    return refuse(DropReason::WrongByteOrder,
                  "CIGI byte-swap magic number is {:02x} {:02x}, expected 80 00 or 00 80",
                  std::to_integer<unsigned>(packet[6]), std::to_integer<unsigned>(packet[7]));
}

// The first of some named numbers that is not finite.
struct Named {
    std::string_view name;
    double value;
};
std::optional<WireError> first_not_finite(std::string_view packet, std::uint16_t id,
                                          std::span<const Named> numbers) {
    for (const Named& number : numbers) {
        if (std::isfinite(number.value)) continue;
        return WireError{DropReason::NotFinite, fmt::format("CIGI {} {} with {} {}, expected a finite number",
                                                            packet, id, number.name, number.value)};
    }
    return std::nullopt;
}

WireError out_of_range(std::string_view packet, std::uint16_t id, Named number, double lowest,
                       double highest) {
    return {DropReason::OutOfRange, fmt::format("CIGI {} {} with {} {}, expected {} to {}", packet, id,
                                                number.name, number.value, lowest, highest)};
}

std::optional<WireError> check_place(std::uint16_t id, std::span<const Named> place, double pitch) {
    const auto outside = [](const Named& number, double lowest, double highest) {
        return number.value < lowest || number.value > highest;
    };
    if (outside(place[0], -90.0, 90.0)) return out_of_range(kEntityControl, id, place[0], -90.0, 90.0);
    if (outside(place[1], -360.0, 360.0)) return out_of_range(kEntityControl, id, place[1], -360.0, 360.0);
    if (outside(place[2], kLowestAltitudeM, kHighestAltitudeM)) {
        return out_of_range(kEntityControl, id, place[2], kLowestAltitudeM, kHighestAltitudeM);
    }
    if (outside({"pitch", pitch}, -90.0, 90.0))
        return out_of_range(kEntityControl, id, {"pitch", pitch}, -90.0, 90.0);
    return std::nullopt;
}

tl::expected<EntityState, WireError> decode_place(const ByteReader& reader, std::uint16_t id) {
    const std::array<Named, 6> numbers{{{"latitude", reader.f64(24)},
                                        {"longitude", reader.f64(32)},
                                        {"altitude", reader.f64(40)},
                                        {"roll", reader.f32(12)},
                                        {"pitch", reader.f32(16)},
                                        {"yaw", reader.f32(20)}}};
    if (auto error = first_not_finite("Entity Control", id, numbers))
        return tl::unexpected(std::move(*error));
    const auto [latitude, longitude, altitude, roll, pitch, yaw] = numbers;
    if (auto error = check_place(id, numbers, pitch.value)) return tl::unexpected(std::move(*error));
    EntityState state;
    state.latitude_deg = latitude.value;
    state.longitude_deg = turn_180(longitude.value);
    state.altitude_m = altitude.value;
    state.attitude = {turn_0_360(yaw.value), pitch.value, turn_180(roll.value)};
    state.above_ground = reader.bits(4, 5, 2) != 0;
    return state;
}

}  // namespace

tl::expected<CigiIgControl, WireError> decode_ig_control(std::span<const std::byte> packet) {
    if (packet.size() < kShortIgControlBytes) return too_small("IG Control", packet.size(), kIgControlBytes);
    const auto order = order_of(packet);
    if (!order) return tl::unexpected(order.error());
    const ByteReader reader(packet, *order);
    if (reader.u8(2) != kMajorVersion) {
        return refuse(DropReason::WrongVersion, "CIGI {} is not supported: set the host to CIGI 3.3",
                      reader.u8(2));
    }
    CigiIgControl control;
    control.dialect = {*order, packet.size() < kIgControlBytes};
    control.database = reader.i8(3);
    control.mode = static_cast<std::uint8_t>(reader.bits(4, 0, 2));
    control.timestamp_valid = reader.bits(4, 2, 1) != 0;
    control.host_frame = reader.u32(8);
    control.timestamp_10us = reader.u32(12);
    control.last_ig_frame = control.dialect.short_layout ? 0 : reader.u32(16);
    return control;
}

tl::expected<CigiEntityControl, WireError> decode_entity_control(std::span<const std::byte> packet,
                                                                 ByteOrder order) {
    if (packet.size() < kEntityControlBytes)
        return too_small("Entity Control", packet.size(), kEntityControlBytes);
    const ByteReader reader(packet, order);
    CigiEntityControl control;
    control.entity_id = reader.u16(2);
    const unsigned state = reader.bits(4, 0, 2);
    if (state > 2) {
        return refuse(DropReason::OutOfRange, "CIGI Entity Control {} with entity state 3, expected 0 to 2",
                      control.entity_id);
    }
    control.state = static_cast<CigiEntityControl::State>(state);
    const bool child = reader.bits(4, 2, 1) != 0;
    if (child || control.state == CigiEntityControl::State::Destroyed) return control;
    auto placed = decode_place(reader, control.entity_id);
    if (!placed) return tl::unexpected(std::move(placed.error()));
    placed->active = control.state == CigiEntityControl::State::Active;
    control.placed = *placed;
    return control;
}

tl::expected<CigiRateControl, WireError> decode_rate_control(std::span<const std::byte> packet,
                                                             ByteOrder order) {
    if (packet.size() < kRateControlBytes) return too_small("Rate Control", packet.size(), kRateControlBytes);
    const ByteReader reader(packet, order);
    const std::array<Named, 6> numbers{{{"X rate", reader.f32(8)},
                                        {"Y rate", reader.f32(12)},
                                        {"Z rate", reader.f32(16)},
                                        {"roll rate", reader.f32(20)},
                                        {"pitch rate", reader.f32(24)},
                                        {"yaw rate", reader.f32(28)}}};
    CigiRateControl control;
    control.entity_id = reader.u16(2);
    if (auto error = first_not_finite("Rate Control", control.entity_id, numbers)) {
        return tl::unexpected(std::move(*error));
    }
    const auto [x, y, z, roll, pitch, yaw] = numbers;
    control.of_part = reader.bits(5, 0, 1) != 0;
    control.rates.axes =
        reader.bits(5, 1, 1) != 0 ? EntityRates::Axes::Body : EntityRates::Axes::NorthEastDown;
    control.rates.velocity_mps = {x.value, y.value, z.value};
    control.rates.turn = EntityRates::Turn::AboutAxes;
    control.rates.turn_deg_s = {yaw.value, pitch.value, roll.value};
    return control;
}

tl::expected<CigiViewControl, WireError> decode_view_control(std::span<const std::byte> packet,
                                                             ByteOrder order) {
    if (packet.size() < kViewControlBytes) return too_small("View Control", packet.size(), kViewControlBytes);
    const ByteReader reader(packet, order);
    CigiViewControl control;
    control.view_id = reader.u16(2);
    control.group_id = reader.u8(4);
    control.entity_id = reader.u16(6);
    const auto enabled = [&](unsigned bit, std::size_t offset) -> std::optional<double> {
        if (reader.bits(5, bit, 1) == 0) return std::nullopt;
        return reader.f32(offset);
    };
    control.offset_m = {enabled(0, 8), enabled(1, 12), enabled(2, 16)};
    control.roll_deg = enabled(3, 20);
    control.pitch_deg = enabled(4, 24);
    control.yaw_deg = enabled(5, 28);
    const std::array<Named, 6> numbers{{{"X offset", control.offset_m[0].value_or(0.0)},
                                        {"Y offset", control.offset_m[1].value_or(0.0)},
                                        {"Z offset", control.offset_m[2].value_or(0.0)},
                                        {"roll", control.roll_deg.value_or(0.0)},
                                        {"pitch", control.pitch_deg.value_or(0.0)},
                                        {"yaw", control.yaw_deg.value_or(0.0)}}};
    if (auto error = first_not_finite("View Control", control.view_id, numbers)) {
        return tl::unexpected(std::move(*error));
    }
    if (std::abs(control.pitch_deg.value_or(0.0)) > 90.0) {
        return tl::unexpected(
            out_of_range("View Control", control.view_id, {"pitch", *control.pitch_deg}, -90.0, 90.0));
    }
    if (control.roll_deg) control.roll_deg = turn_180(*control.roll_deg);
    if (control.yaw_deg) control.yaw_deg = turn_0_360(*control.yaw_deg);
    return control;
}

tl::expected<CigiViewDefinition, WireError> decode_view_definition(std::span<const std::byte> packet,
                                                                   ByteOrder order) {
    if (packet.size() < kViewDefinitionBytes)
        return too_small("View Definition", packet.size(), kViewDefinitionBytes);
    const ByteReader reader(packet, order);
    CigiViewDefinition definition;
    definition.view_id = reader.u16(2);
    definition.group_id = reader.u8(4);
    const auto enabled = [&](unsigned bit, std::size_t offset) -> std::optional<double> {
        if (reader.bits(5, bit, 1) == 0) return std::nullopt;
        return reader.f32(offset);
    };
    definition.near_m = enabled(0, 8);
    definition.far_m = enabled(1, 12);
    definition.left_deg = enabled(2, 16);
    definition.right_deg = enabled(3, 20);
    definition.top_deg = enabled(4, 24);
    definition.bottom_deg = enabled(5, 28);
    const std::array<Named, 6> numbers{{{"near", definition.near_m.value_or(1.0)},
                                        {"far", definition.far_m.value_or(1.0)},
                                        {"left", definition.left_deg.value_or(0.0)},
                                        {"right", definition.right_deg.value_or(0.0)},
                                        {"top", definition.top_deg.value_or(0.0)},
                                        {"bottom", definition.bottom_deg.value_or(0.0)}}};
    if (auto error = first_not_finite("View Definition", definition.view_id, numbers)) {
        return tl::unexpected(std::move(*error));
    }
    if (numbers[0].value <= 0.0) {
        return refuse(DropReason::OutOfRange, "CIGI View Definition {} with near {} m, expected more than 0",
                      definition.view_id, numbers[0].value);
    }
    for (const Named& angle : std::span(numbers).subspan(2)) {
        if (std::abs(angle.value) < 90.0) continue;
        return tl::unexpected(out_of_range("View Definition", definition.view_id, angle, -90.0, 90.0));
    }
    return definition;
}

std::vector<std::byte> encode_start_of_frame(const CigiStartOfFrame& start, CigiDialect dialect) {
    const std::size_t size = dialect.short_layout ? kShortIgControlBytes : kIgControlBytes;
    const unsigned minor = dialect.short_layout ? kMinorVersion31 : kMinorVersion33;
    std::vector<std::byte> bytes(size);
    const ByteWriter writer(bytes, dialect.order);
    writer.u8(0, static_cast<std::uint8_t>(CigiPacketId::StartOfFrame));
    writer.u8(1, static_cast<std::uint8_t>(size));
    writer.u8(2, kMajorVersion);
    writer.u8(3, static_cast<std::uint8_t>(start.database));
    writer.u8(4, start.status_code);
    const unsigned valid = start.timestamp_valid ? 4U : 0U;
    writer.u8(5, static_cast<std::uint8_t>((start.mode & 3U) | valid | (minor << 4U)));
    writer.u16(6, kMagic);
    writer.u32(8, start.ig_frame);
    writer.u32(12, start.timestamp_10us);
    writer.u32(16, start.last_host_frame);
    return bytes;
}

tl::expected<CigiStartOfFrame, WireError> decode_start_of_frame(std::span<const std::byte> packet) {
    if (packet.size() < kShortIgControlBytes)
        return too_small("Start Of Frame", packet.size(), kIgControlBytes);
    const auto order = order_of(packet);
    if (!order) return tl::unexpected(order.error());
    const ByteReader reader(packet, *order);
    if (reader.u8(0) != static_cast<std::uint8_t>(CigiPacketId::StartOfFrame) ||
        reader.u8(2) != kMajorVersion) {
        return refuse(DropReason::WrongVersion,
                      "packet {} of CIGI {}, expected Start Of Frame (101) of CIGI 3", reader.u8(0),
                      reader.u8(2));
    }
    CigiStartOfFrame start;
    start.database = reader.i8(3);
    start.status_code = reader.u8(4);
    start.mode = static_cast<std::uint8_t>(reader.bits(5, 0, 2));
    start.timestamp_valid = reader.bits(5, 2, 1) != 0;
    start.ig_frame = reader.u32(8);
    start.timestamp_10us = reader.u32(12);
    start.last_host_frame = packet.size() < kIgControlBytes ? 0 : reader.u32(16);
    return start;
}

}  // namespace eyepoint::net::wire
