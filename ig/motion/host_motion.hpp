/// The motion of the entity that a view stands on, followed from packet to packet.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "ig/motion/dead_reckoning.hpp"
#include "net/host_state.hpp"

namespace eyepoint::ig {

/// When a host's state was true.
struct StateTime {
    std::int64_t arrival_ns = 0;        ///< of the steady clock
    std::optional<double> host_time_s;  ///< the host's own clock, where it is finer than a second
};

/// Moves the newest state on to the time that a frame is seen at, within bounds that keep a host's odd
/// moments from being made worse:
/// - by kLongestS at most: a host that falls silent leaves its vehicle standing;
/// - not before two packets (three, where no velocities are stated) have come that a body can have flown
///   between: not after a jump (a new start, a teleport), not faster than kFastestMps or kFastestTurnRadS;
/// - by the velocities that the host states, while they agree with the way that its packets went over the
/// last
///   kHistoryS; else, and where it states none, by the differences over the last kDifferenceS;
/// - not where the host repeats the same place and attitude for kStillS: it is paused.
/// Thread use: one thread.
class HostMotion {
  public:
    static constexpr double kLongestS = 0.2;
    static constexpr double kFastestMps = 10'000.0;  ///< above low orbit's 7,800
    static constexpr double kFastestTurnRadS = 12.6;
    static constexpr double kHistoryS = 0.5;
    static constexpr double kDifferenceS = 0.15;
    static constexpr double kStillS = 0.1;
    static constexpr double kLongestGapS = 2.5;  ///< packets further apart have nothing to do with each other

    HostMotion();

    /// Takes in the newest state. True: it lies where nothing could have flown to.
    bool observe(const net::EntityState& entity, const StateTime& time);
    /// Begins anew, as for another entity.
    void forget();

    struct MovedOn {
        net::EntityState entity;
        double by_s = 0.0;  ///< 0: the entity is the newest packet's, bit for bit
    };
    /// The newest state at a time of the steady clock; none before the first observe().
    [[nodiscard]] std::optional<MovedOn> at(std::int64_t time_ns) const;

  private:
    struct Sample {
        net::EntityState entity;
        StateTime time;
        std::optional<Velocity> stated;
        glm::dvec3 stated_way_m{0.0};     ///< stated velocity summed up since the history's begin
        glm::dvec3 stated_turn_rad{0.0};  ///< the same of the turn
    };

    void start_from(Sample sample);
    void stand_still(Sample sample);
    void append(Sample sample, double span_s);
    [[nodiscard]] bool jumped(const Sample& to, double span_s) const;
    void estimate();

    std::vector<Sample> samples_;       ///< oldest first
    std::optional<Velocity> velocity_;  ///< what the next packet is expected to agree with
    bool believed_ = false;             ///< whether to move on by it
};

}  // namespace eyepoint::ig
