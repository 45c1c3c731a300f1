#include "tools/replay/track_curve.hpp"

#include <algorithm>
#include <cmath>

namespace eyepoint::tools {
namespace {

constexpr double kSpeedOverSlowerLeg = 2.0;

double length(const Vector3& v) { return std::hypot(v[0], v[1], v[2]); }

Vector3 combine(double a, const Vector3& x, double b, const Vector3& y) {
    return {a * x[0] + b * y[0], a * x[1] + b * y[1], a * x[2] + b * y[2]};
}

}  // namespace

TrackCurve::TrackCurve(const Track& track) {
    const TrackFix& middle = track.fixes[track.fixes.size() / 2];
    frame_.Reset(middle.latitude_deg, middle.longitude_deg, middle.altitude_m);
    knots_.reserve(track.fixes.size());
    for (const TrackFix& fix : track.fixes) {
        Knot knot{fix.time_s, {}, {}};
        frame_.Forward(fix.latitude_deg, fix.longitude_deg, fix.altitude_m, knot.position_m[0],
                       knot.position_m[1], knot.position_m[2]);
        knots_.push_back(knot);
    }
    set_velocities();
}

void TrackCurve::set_velocities() {
    const auto leg = [&](std::size_t i) {
        const double time_s = knots_[i + 1].time_s - knots_[i].time_s;
        return combine(1.0 / time_s, knots_[i + 1].position_m, -1.0 / time_s, knots_[i].position_m);
    };
    knots_.front().velocity_mps = leg(0);
    knots_.back().velocity_mps = leg(knots_.size() - 2);
    for (std::size_t i = 1; i + 1 < knots_.size(); ++i) {
        const double before_s = knots_[i].time_s - knots_[i - 1].time_s;
        const double after_s = knots_[i + 1].time_s - knots_[i].time_s;
        const Vector3 before = leg(i - 1), after = leg(i);
        const double total_s = before_s + after_s;
        const Vector3 parabola = combine(after_s / total_s, before, before_s / total_s, after);
        const double limit = kSpeedOverSlowerLeg * std::min(length(before), length(after));
        const double speed = length(parabola);
        knots_[i].velocity_mps = combine(speed > limit ? limit / speed : 1.0, parabola, 0.0, parabola);
    }
}

TrackCurve::Point TrackCurve::at(double time_s) const {
    const auto after = std::upper_bound(knots_.begin(), knots_.end(), time_s,
                                        [](double time, const Knot& knot) { return time < knot.time_s; });
    if (after == knots_.begin()) return {knots_.front().position_m, {}};
    const Knot& a = *(after - 1);
    if (after == knots_.end()) {
        return {a.position_m, time_s > a.time_s ? Vector3{} : a.velocity_mps};
    }
    const Knot& b = *after;
    const double step_s = b.time_s - a.time_s;
    const double u = (time_s - a.time_s) / step_s, u2 = u * u, u3 = u2 * u;
    const Vector3 along = combine(1.0, b.position_m, -1.0, a.position_m);
    const Vector3 moved = combine(1.0, a.position_m, 3 * u2 - 2 * u3, along);
    const Vector3 bent =
        combine((u3 - 2 * u2 + u) * step_s, a.velocity_mps, (u3 - u2) * step_s, b.velocity_mps);
    const Vector3 turned = combine(3 * u2 - 4 * u + 1, a.velocity_mps, 3 * u2 - 2 * u, b.velocity_mps);
    return {combine(1.0, moved, 1.0, bent), combine(6 * (u - u2) / step_s, along, 1.0, turned)};
}

TrackCurve::Place TrackCurve::place(const Vector3& position_m) const {
    Place place{};
    std::vector<double> axes(9);
    frame_.Reverse(position_m[0], position_m[1], position_m[2], place.latitude_deg, place.longitude_deg,
                   place.altitude_m, axes);
    std::copy(axes.begin(), axes.end(), place.axes.begin());
    return place;
}

}  // namespace eyepoint::tools
