#include "ig/motion/host_motion.hpp"

#include <algorithm>
#include <utility>

#include <glm/geometric.hpp>

#include "net/nanoseconds.hpp"

namespace eyepoint::ig {

namespace {

/// Of a history of half a second, kept at most every 8 ms.
constexpr std::size_t kMostSamples = 64;
/// Two differences, however old; one alone may be a jump.
constexpr std::size_t kLeastSamples = 3;
constexpr double kLeastSpacingS = 0.008;
/// Two states that came closer together than this say nothing of a velocity.
constexpr double kLeastSpanS = 0.0005;
/// What the stated velocities' way may differ from the real one: a share of the longer, for packets that come
/// early or late, and a little for rounding.
constexpr double kAgreement = 0.3;
constexpr double kAgreementM = 2.0;
constexpr double kAgreementRad = 0.035;
/// A way that departs this far from the expected one is a jump: as far again as was expected, over a span of
/// at least kJumpSpanS (packets come in bunches), and some metres.
constexpr double kJumpM = 5.0;
constexpr double kJumpSpanS = 0.1;

double span_s(const StateTime& from, const StateTime& to) {
    const double arrival_s =
        static_cast<double>(to.arrival_ns - from.arrival_ns) * net::kSecondsPerNanosecond;
    if (!from.host_time_s || !to.host_time_s) return arrival_s;
    const double host_s = *to.host_time_s - *from.host_time_s;
    // Some hosts count another unit: their clock is believed where it agrees with the packets' arrival.
    return host_s > 0.5 * arrival_s && host_s < 2.0 * arrival_s ? host_s : arrival_s;
}

bool same_pose(const net::EntityState& a, const net::EntityState& b) {
    return a.latitude_deg == b.latitude_deg && a.longitude_deg == b.longitude_deg &&
           a.altitude_m == b.altitude_m && a.attitude == b.attitude && a.above_ground == b.above_ground;
}

bool agree(const glm::dvec3& stated, const glm::dvec3& real, double rounding) {
    const double longer = std::max(glm::length(stated), glm::length(real));
    return glm::length(stated - real) <= kAgreement * longer + rounding;
}

}  // namespace

HostMotion::HostMotion() { samples_.reserve(kMostSamples + 1); }

void HostMotion::forget() {
    samples_.clear();
    velocity_.reset();
    believed_ = false;
}

void HostMotion::start_from(Sample sample) {
    forget();
    samples_.push_back(std::move(sample));
}

void HostMotion::stand_still(Sample sample) {
    const bool states = sample.stated.has_value();
    start_from(std::move(sample));
    if (!states) velocity_ = Velocity{};
}

bool HostMotion::observe(const net::EntityState& entity, const StateTime& time) {
    Sample sample{.entity = entity, .time = time, .stated = stated_velocity(entity)};
    if (sample.stated && glm::length(sample.stated->ned_mps) > kFastestMps) sample.stated.reset();
    if (samples_.empty()) {
        start_from(std::move(sample));
        return false;
    }
    const Sample& newest = samples_.back();
    const double span = span_s(newest.time, time);
    if (same_pose(newest.entity, entity)) {
        if (span > kStillS) stand_still(std::move(sample));
        return false;
    }
    if (span > kLongestGapS) {
        start_from(std::move(sample));
        return false;
    }
    if (span < kLeastSpanS) {
        samples_.back().entity = entity;
        return false;
    }
    if (jumped(sample, span)) {
        start_from(std::move(sample));
        return true;
    }
    append(std::move(sample), span);
    estimate();
    return false;
}

bool HostMotion::jumped(const Sample& to, double span) const {
    const Sample& from = samples_.back();
    const glm::dvec3 way_m = way_between(from.entity, to.entity);
    if (glm::length(way_m) > kFastestMps * span + kJumpM) return true;
    std::optional<glm::dvec3> expected_mps;
    if (velocity_) {
        expected_mps = velocity_->ned_mps;
    } else if (from.stated) {
        expected_mps = from.stated->ned_mps;
    }
    if (!expected_mps) return false;
    const double allowed_m = kJumpM + glm::length(*expected_mps) * std::max(span, kJumpSpanS);
    return glm::length(way_m - *expected_mps * span) > allowed_m;
}

void HostMotion::append(Sample sample, double span) {
    const Sample& from = samples_.back();
    if (from.stated && sample.stated) {
        sample.stated_way_m =
            from.stated_way_m + (from.stated->ned_mps + sample.stated->ned_mps) * (0.5 * span);
        sample.stated_turn_rad =
            from.stated_turn_rad + (from.stated->turn_rad_s + sample.stated->turn_rad_s) * (0.5 * span);
    }
    const bool crowded =
        samples_.size() > 1 && span_s(samples_[samples_.size() - 2].time, sample.time) < kLeastSpacingS;
    if (crowded) samples_.pop_back();
    samples_.push_back(std::move(sample));
    const auto too_old = [&](const Sample& old) {
        return span_s(old.time, samples_.back().time) > kHistoryS;
    };
    while (samples_.size() > kLeastSamples && (too_old(samples_.front()) || samples_.size() > kMostSamples))
        samples_.erase(samples_.begin());
}

void HostMotion::estimate() {
    const Sample& newest = samples_.back();
    const auto since = [&](const Sample& old) { return span_s(old.time, newest.time); };
    // The previous one at the least.
    const auto previous = std::prev(samples_.end(), 2);
    const Sample& base = *std::find_if(samples_.begin(), previous,
                                       [&](const Sample& old) { return since(old) <= kDifferenceS; });
    Velocity velocity{way_between(base.entity, newest.entity) / since(base),
                      turn_between(base.entity, newest.entity) / since(base)};
    const Sample& oldest = samples_.front();
    believed_ = samples_.size() >= kLeastSamples;
    if (newest.stated && oldest.stated) {
        if (agree(newest.stated_way_m - oldest.stated_way_m, way_between(oldest.entity, newest.entity),
                  kAgreementM)) {
            velocity.ned_mps = newest.stated->ned_mps;
            believed_ = true;
        }
        if (agree(newest.stated_turn_rad - oldest.stated_turn_rad, turn_between(oldest.entity, newest.entity),
                  kAgreementRad))
            velocity.turn_rad_s = newest.stated->turn_rad_s;
    }
    if (glm::length(velocity.turn_rad_s) > kFastestTurnRadS) velocity.turn_rad_s = glm::dvec3(0.0);
    velocity_ = velocity;
}

std::optional<HostMotion::MovedOn> HostMotion::at(std::int64_t time_ns) const {
    if (samples_.empty()) return std::nullopt;
    const Sample& newest = samples_.back();
    const double ahead_s = static_cast<double>(time_ns - newest.time.arrival_ns) * net::kSecondsPerNanosecond;
    if (!believed_ || ahead_s <= 0.0) return MovedOn{newest.entity, 0.0};
    const double by_s = std::min(ahead_s, kLongestS);
    return MovedOn{moved_on(newest.entity, *velocity_, by_s), by_s};
}

}  // namespace eyepoint::ig
