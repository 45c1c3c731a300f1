// Facts from FlightGear's src/Network/net_fdm.hxx and from packets of JSBSim and FlightGear; see
// docs/protocols.md.
#include "net/wire/fgnetfdm.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <fmt/format.h>

#include "net/wire/angles.hpp"
#include "net/wire/byte_order.hpp"

namespace eyepoint::net::wire {
namespace {

constexpr double kMetresPerFoot = 0.3048;
constexpr double kDegreesPerRadian = 180.0 / std::numbers::pi;
// A pitch of pi/2 rounded up to a float lies 4.4e-8 rad above it.
constexpr double kPitchRoundingDeg = 1.0e-5;
constexpr std::uint32_t kJsbsimConstantTime = 1234567890;
constexpr double kYear2000 = 946684800.0;
constexpr double kYear2106 = 4291747200.0;

// Offsets that versions 24 and 25 share.
constexpr std::size_t kLongitude = 8, kLatitude = 16, kAltitude = 24, kAboveGround = 32;
constexpr std::size_t kRoll = 36, kPitch = 40, kYaw = 44;
constexpr std::size_t kRollRate = 56, kPitchRate = 60, kYawRate = 64, kClimbRate = 72;
constexpr std::size_t kVelocityNorth = 76, kVelocityEast = 80, kVelocityDown = 84;
// Offsets of version 24; version 25 has everything from the wheels on 144 bytes later.
constexpr std::size_t kCurTime = 356, kWarp = 360, kVisibility = 364;
constexpr std::size_t kVersion25Shift = 144;

double finite_or_zero(double value) { return std::isfinite(value) ? value : 0.0; }

WireError wrong_version(std::uint32_t version, std::uint32_t swapped, std::size_t size) {
    if (swapped == 24 || swapped == 25) {
        return {
            DropReason::WrongByteOrder,
            fmt::format(
                "FGNetFDM version {} in little-endian byte order ({} bytes): the sender has to swap every "
                "field to network byte order",
                swapped, size)};
    }
    return {
        DropReason::WrongVersion,
        fmt::format(
            "FlightGear packet of version {} in {} bytes, expected FGNetFDM version 24 in 408 or 25 in 552 "
            "(--native-fdm, not --native-gui or --native-ctrls)",
            version, size)};
}

std::optional<WireError> check_form(const ByteReader& reader) {
    if (reader.size() < 8) {
        return WireError{DropReason::Short,
                         fmt::format("FGNetFDM of {} bytes, expected 408 or 552", reader.size())};
    }
    const std::uint32_t version = reader.u32(0);
    if (version != 24 && version != 25) {
        const std::uint32_t swapped = ((version & 0xffU) << 24U) | ((version & 0xff00U) << 8U) |
                                      ((version >> 8U) & 0xff00U) | (version >> 24U);
        return wrong_version(version, swapped, reader.size());
    }
    const std::size_t expected = version == 24 ? kFgNetFdm24Bytes : kFgNetFdm25Bytes;
    if (reader.size() == expected) return std::nullopt;
    return WireError{
        reader.size() < expected ? DropReason::Short : DropReason::Long,
        fmt::format("FGNetFDM version {} in {} bytes, expected {}", version, reader.size(), expected)};
}

std::optional<WireError> check_place(const ByteReader& reader) {
    const double latitude = reader.f64(kLatitude), longitude = reader.f64(kLongitude),
                 altitude = reader.f64(kAltitude);
    const double roll = reader.f32(kRoll), pitch = reader.f32(kPitch), yaw = reader.f32(kYaw);
    if (!(std::isfinite(latitude) && std::isfinite(longitude) && std::isfinite(altitude) &&
          std::isfinite(roll) && std::isfinite(pitch) && std::isfinite(yaw))) {
        return WireError{
            DropReason::NotFinite,
            fmt::format("FGNetFDM with latitude {} rad, longitude {} rad, altitude {} m, roll {} pitch {} "
                        "yaw {} rad: all have to be finite",
                        latitude, longitude, altitude, roll, pitch, yaw)};
    }
    if (std::abs(latitude) > std::numbers::pi / 2 || std::abs(longitude) > 2 * std::numbers::pi) {
        return WireError{
            DropReason::OutOfRange,
            fmt::format("FGNetFDM with latitude {} rad, longitude {} rad, expected at most pi/2 and 2 pi "
                        "(are these degrees?)",
                        latitude, longitude)};
    }
    if (altitude < kLowestAltitudeM || altitude > kHighestAltitudeM) {
        return WireError{DropReason::OutOfRange, fmt::format("FGNetFDM with altitude {} m, expected {} to {}",
                                                             altitude, kLowestAltitudeM, kHighestAltitudeM)};
    }
    if (std::abs(pitch) * kDegreesPerRadian > 90.0 + kPitchRoundingDeg) {
        return WireError{DropReason::OutOfRange,
                         fmt::format("FGNetFDM with pitch {} rad, expected -pi/2 to pi/2", pitch)};
    }
    return std::nullopt;
}

}  // namespace

std::optional<double> FgNetFdm::utc_s() const {
    const double utc = static_cast<double>(cur_time) + warp_s;
    if (cur_time == kJsbsimConstantTime || utc < kYear2000 || utc > kYear2106) return std::nullopt;
    return utc;
}

tl::expected<FgNetFdm, WireError> decode_fgnetfdm(std::span<const std::byte> datagram) {
    const ByteReader reader(datagram, ByteOrder::Big);
    if (auto error = check_form(reader)) return tl::unexpected(std::move(*error));
    if (auto error = check_place(reader)) return tl::unexpected(std::move(*error));
    const auto degrees = [&](std::size_t offset) { return reader.f32(offset) * kDegreesPerRadian; };
    const auto rate = [&](std::size_t offset) { return finite_or_zero(degrees(offset)); };
    const auto speed = [&](std::size_t offset) {
        return finite_or_zero(reader.f32(offset) * kMetresPerFoot);
    };
    const std::size_t shift = reader.size() == kFgNetFdm25Bytes ? kVersion25Shift : 0;

    FgNetFdm fdm;
    fdm.latitude_deg = std::clamp(reader.f64(kLatitude) * kDegreesPerRadian, -90.0, 90.0);
    fdm.longitude_deg = turn_180(reader.f64(kLongitude) * kDegreesPerRadian);
    fdm.altitude_m = reader.f64(kAltitude);
    fdm.attitude = {turn_0_360(degrees(kYaw)), std::clamp(degrees(kPitch), -90.0, 90.0),
                    turn_180(degrees(kRoll))};
    fdm.attitude_rate = {rate(kYawRate), rate(kPitchRate), rate(kRollRate)};
    fdm.velocity_ned_mps = {speed(kVelocityNorth), speed(kVelocityEast), speed(kVelocityDown)};
    fdm.above_ground_m = finite_or_zero(reader.f32(kAboveGround));
    fdm.visibility_m = finite_or_zero(reader.f32(kVisibility + shift));
    fdm.cur_time = reader.u32(kCurTime + shift);
    fdm.warp_s = reader.i32(kWarp + shift);
    return fdm;
}

std::array<std::byte, kFgNetFdm24Bytes> encode_fgnetfdm24(const FgNetFdm& fdm) {
    std::array<std::byte, kFgNetFdm24Bytes> bytes{};
    const ByteWriter writer(bytes, ByteOrder::Big);
    const auto angle = [&](std::size_t offset, double degrees) {
        writer.f32(offset, static_cast<float>(degrees / kDegreesPerRadian));
    };
    const auto speed = [&](std::size_t offset, double mps) {
        writer.f32(offset, static_cast<float>(mps / kMetresPerFoot));
    };
    writer.u32(0, 24);
    writer.f64(kLongitude, fdm.longitude_deg / kDegreesPerRadian);
    writer.f64(kLatitude, fdm.latitude_deg / kDegreesPerRadian);
    writer.f64(kAltitude, fdm.altitude_m);
    writer.f32(kAboveGround, static_cast<float>(fdm.above_ground_m));
    angle(kRoll, fdm.attitude.roll_deg);
    angle(kPitch, fdm.attitude.pitch_deg);
    angle(kYaw, fdm.attitude.yaw_deg);
    angle(kRollRate, fdm.attitude_rate.roll_deg);
    angle(kPitchRate, fdm.attitude_rate.pitch_deg);
    angle(kYawRate, fdm.attitude_rate.yaw_deg);
    speed(kClimbRate, -fdm.velocity_ned_mps[2]);
    speed(kVelocityNorth, fdm.velocity_ned_mps[0]);
    speed(kVelocityEast, fdm.velocity_ned_mps[1]);
    speed(kVelocityDown, fdm.velocity_ned_mps[2]);
    writer.u32(kCurTime, fdm.cur_time);
    writer.i32(kWarp, fdm.warp_s);
    writer.f32(kVisibility, static_cast<float>(fdm.visibility_m));
    return bytes;
}

}  // namespace eyepoint::net::wire
