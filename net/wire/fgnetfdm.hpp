/// FGNetFDM, the structure that FlightGear, JSBSim and others send: version 24 (408 bytes) and 25 (552
/// bytes), network byte order, one datagram each. Layout and units: docs/protocols.md.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

#include <tl/expected.hpp>

#include "net/drop_reason.hpp"
#include "net/host_state.hpp"

namespace eyepoint::net::wire {

inline constexpr std::size_t kFgNetFdm24Bytes = 408;
inline constexpr std::size_t kFgNetFdm25Bytes = 552;
/// Altitudes outside are refused, for every protocol: below every shore, above low orbit.
inline constexpr double kLowestAltitudeM = -1000.0;
inline constexpr double kHighestAltitudeM = 1.0e6;

/// The fields an image generator may use, in SI units and degrees. Velocities and rates are 0 from senders
/// that do not fill them in.
struct FgNetFdm {
    double latitude_deg = 0.0;   ///< geodetic WGS84, -90..90
    double longitude_deg = 0.0;  ///< -180..180
    double altitude_m = 0.0;  ///< above what the sender calls sea level, kLowestAltitudeM..kHighestAltitudeM
    AttitudeDeg attitude;     ///< yaw 0..360, pitch -90..90, roll -180..180
    AttitudeDeg attitude_rate;  ///< rates of the Euler angles, degrees a second
    std::array<double, 3> velocity_ned_mps{};
    double above_ground_m = 0.0;  ///< by the sender's own terrain
    double visibility_m = 0.0;    ///< 0 or less: not given
    std::uint32_t cur_time =
        0;  ///< as sent: seconds of UTC since 1970 from some, simulation time from others
    std::int32_t warp_s = 0;

    /// cur_time + warp as UTC in seconds since 1970, where that is believable: 2000 to 2106, and not JSBSim's
    /// constant.
    [[nodiscard]] std::optional<double> utc_s() const;
};

/// Takes version 24 in 408 bytes and version 25 in 552 bytes; refuses every other length and version,
/// little-endian senders (by name), and a position or attitude that is not finite or out of range.
/// Velocities, rates and the other numbers that are not needed to place the eye read 0 where they are not
/// finite.
[[nodiscard]] tl::expected<FgNetFdm, WireError> decode_fgnetfdm(std::span<const std::byte> datagram);

/// Version 24. Fields that FgNetFdm does not have are 0, but for the rate of climb, which is that of the
/// velocity.
[[nodiscard]] std::array<std::byte, kFgNetFdm24Bytes> encode_fgnetfdm24(const FgNetFdm& fdm);

}  // namespace eyepoint::net::wire
