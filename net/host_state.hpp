/// What a host has said, as values: the one shape that every protocol is decoded into.
/// Angles in degrees and heights in metres as on the wire; the datum of heights is the host's, a setting.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <optional>

namespace eyepoint::net {

enum class Protocol : std::uint8_t { FgNetFdm, Cigi };

/// Kernel arrival time of a datagram, nanoseconds of CLOCK_REALTIME (SO_TIMESTAMPNS), or the capture's time.
struct ArrivalTime {
    std::int64_t realtime_ns = 0;
};

/// Yaw from true north clockwise, pitch nose up, roll right wing down; applied in this order. Degrees.
struct AttitudeDeg {
    double yaw_deg = 0.0;
    double pitch_deg = 0.0;
    double roll_deg = 0.0;
    bool operator==(const AttitudeDeg&) const = default;
};

/// How an entity moves, as its host states it.
struct EntityRates {
    enum class Axes : std::uint8_t { NorthEastDown, Body };
    enum class Turn : std::uint8_t {
        EulerAngles,  ///< of yaw, pitch and roll themselves
        AboutAxes,    ///< yaw about the third of the axes, pitch about the second, roll about the first
    };
    Axes axes = Axes::NorthEastDown;
    std::array<double, 3> velocity_mps{};  ///< along the axes, against the Earth
    Turn turn = Turn::EulerAngles;
    AttitudeDeg turn_deg_s{};
};

/// A top-level entity: geodetic WGS84 latitude -90..90, longitude -180..180, altitude above the host's datum.
struct EntityState {
    double latitude_deg = 0.0;
    double longitude_deg = 0.0;
    double altitude_m = 0.0;
    AttitudeDeg attitude;
    bool active = true;
    /// CIGI's ground clamp: altitude_m is above the terrain surface below the entity, which the IG has to
    /// look up.
    bool above_ground = false;
    /// Absent where the host has not said; CIGI's stay in force until the host says others.
    std::optional<EntityRates> rates{};
};

/// A view as the host has defined and placed it; what it has not said is absent.
struct ViewState {
    std::uint16_t entity_id = 0;
    /// Along the entity's body axes (forward, right, down), metres.
    std::array<double, 3> offset_m{};
    AttitudeDeg attitude;  ///< against the entity's body axes
    /// Half angles from the view axis, degrees, -90..90: left < right, bottom < top.
    std::optional<double> left_deg, right_deg, bottom_deg, top_deg;
    std::optional<double> near_m;
};

/// CIGI's IG mode.
enum class IgMode : std::uint8_t { Standby = 0, Operate = 1, Debug = 2, Maintenance = 3 };

/// Everything in force after the newest message.
struct HostState {
    Protocol protocol = Protocol::FgNetFdm;
    /// 0 is the ownship. Only top-level entities: one that is attached to another is not among them.
    std::map<std::uint16_t, EntityState> entities;
    std::map<std::uint16_t, ViewState> views;
    IgMode commanded_mode = IgMode::Operate;
    /// CIGI database number that the host asked for last; 0: none so far.
    std::int8_t requested_database = 0;
    /// The host's frame number (CIGI), or the count of valid packets (FGNetFDM has none).
    std::uint32_t host_frame = 0;
    /// The host's own clock in seconds, where it sends one: CIGI timestamp, its wraps taken out, from an
    /// origin of the host's own; FGNetFDM cur_time + warp where that is a believable UTC, seconds since 1970.
    std::optional<double> host_time_s;
    ArrivalTime arrival;

    [[nodiscard]] const EntityState* ownship() const {
        const auto found = entities.find(0);
        return found == entities.end() ? nullptr : &found->second;
    }
};

}  // namespace eyepoint::net
