#include "tools/replay/track_flight.hpp"

#include <algorithm>
#include <cmath>

#include "tools/replay/track_curve.hpp"
#include "tools/replay/track_motion.hpp"

namespace eyepoint::tools {
namespace {

// Smoothing of velocities, as a standard deviation: enough to take a GNSS receiver's noise out of the course,
// not so much that a glider's circle of 20 seconds loses its bank.
constexpr double kLeastSmoothing_s = 0.75, kMostSmoothing_s = 3.0, kSmoothingOfSpacing = 0.75;

double median_spacing_s(const Track& track) {
    std::vector<double> spacings;
    for (std::size_t i = 1; i < track.fixes.size(); ++i) {
        spacings.push_back(track.fixes[i].time_s - track.fixes[i - 1].time_s);
    }
    const auto middle = spacings.begin() + static_cast<std::ptrdiff_t>(spacings.size() / 2);
    std::nth_element(spacings.begin(), middle, spacings.end());
    return *middle;
}

std::vector<double> sample_times(const Track& track, const FlightSampling& sampling) {
    const double first = track.fixes.front().time_s, duration = track.fixes.back().time_s - first;
    const double from = std::max(0.0, sampling.from_s), until = std::min(duration, sampling.until_s);
    std::vector<double> times;
    // The last fix is hit in spite of the rounding of i / rate.
    const double rounding = 1.0e-9 * std::max(1.0, until);
    for (std::size_t i = 0; from + static_cast<double>(i) / sampling.rate_hz <= until + rounding; ++i) {
        times.push_back(first + from + static_cast<double>(i) / sampling.rate_hz);
    }
    return times;
}

// Into north, east, down of the place: the transpose of its axes.
Vector3 to_ned(const TrackCurve::Place& place, const Vector3& v) {
    const auto along = [&](std::size_t column) {
        return place.axes[column] * v[0] + place.axes[column + 3] * v[1] + place.axes[column + 6] * v[2];
    };
    return {along(1), along(0), -along(2)};
}

std::vector<Vector3> derivative(const std::vector<Vector3>& values, double step_s) {
    std::vector<Vector3> slopes(values.size());
    for (std::size_t i = 0; i < values.size(); ++i) {
        const std::size_t before = i == 0 ? 0 : i - 1, after = std::min(i + 1, values.size() - 1);
        const double time_s = step_s * static_cast<double>(std::max<std::size_t>(after - before, 1));
        for (std::size_t axis = 0; axis < 3; ++axis) {
            slopes[i][axis] = (values[after][axis] - values[before][axis]) / time_s;
        }
    }
    return slopes;
}

std::vector<net::AttitudeDeg> logged_attitudes(const Track& track, const std::vector<double>& times) {
    std::vector<net::AttitudeDeg> attitudes;
    attitudes.reserve(times.size());
    std::size_t leg = 0;
    for (const double time_s : times) {
        while (leg + 2 < track.fixes.size() && track.fixes[leg + 1].time_s <= time_s) ++leg;
        const TrackFix &a = track.fixes[leg], &b = track.fixes[leg + 1];
        const double u = std::clamp((time_s - a.time_s) / (b.time_s - a.time_s), 0.0, 1.0);
        const auto between = [u](double from, double to) {
            return from + u * std::remainder(to - from, 360.0);
        };
        attitudes.push_back({between(a.attitude->yaw_deg, b.attitude->yaw_deg),
                             between(a.attitude->pitch_deg, b.attitude->pitch_deg),
                             between(a.attitude->roll_deg, b.attitude->roll_deg)});
    }
    return attitudes;
}

void fill_attitude_rates(std::vector<FlightSample>& samples, double step_s) {
    for (std::size_t i = 0; i < samples.size(); ++i) {
        const std::size_t before = i == 0 ? 0 : i - 1, after = std::min(i + 1, samples.size() - 1);
        if (before == after) return;
        const net::AttitudeDeg &a = samples[before].fdm.attitude, &b = samples[after].fdm.attitude;
        const double time_s = step_s * static_cast<double>(after - before);
        const auto rate = [time_s](double from, double to) {
            return std::remainder(to - from, 360.0) / time_s;
        };
        samples[i].fdm.attitude_rate = {rate(a.yaw_deg, b.yaw_deg), rate(a.pitch_deg, b.pitch_deg),
                                        rate(a.roll_deg, b.roll_deg)};
    }
}

std::vector<Motion> motions_of(const TrackCurve& curve, const std::vector<TrackCurve::Place>& places,
                               const std::vector<double>& times, double step_s, double smoothing_s) {
    std::vector<Vector3> velocities;
    velocities.reserve(times.size());
    for (const double time_s : times) velocities.push_back(curve.at(time_s).velocity_mps);
    velocities = smoothed(std::move(velocities), smoothing_s / step_s);
    const auto accelerations = smoothed(derivative(velocities, step_s), smoothing_s / step_s);
    std::vector<Motion> motions;
    motions.reserve(times.size());
    for (std::size_t i = 0; i < times.size(); ++i) {
        motions.push_back({to_ned(places[i], velocities[i]), to_ned(places[i], accelerations[i])});
    }
    return motions;
}

}  // namespace

std::vector<FlightSample> sample_flight(const Track& track, const FlightSampling& sampling) {
    const std::vector<double> times = sample_times(track, sampling);
    const double step_s = 1.0 / sampling.rate_hz;
    const TrackCurve curve(track);
    std::vector<TrackCurve::Place> places;
    places.reserve(times.size());
    for (const double time_s : times) places.push_back(curve.place(curve.at(time_s).position_m));
    const double smoothing_s =
        std::clamp(kSmoothingOfSpacing * median_spacing_s(track), kLeastSmoothing_s, kMostSmoothing_s);
    const auto motions = motions_of(curve, places, times, step_s, smoothing_s);
    const bool logged = std::all_of(track.fixes.begin(), track.fixes.end(),
                                    [](const TrackFix& fix) { return fix.attitude.has_value(); });
    const auto attitudes = logged ? logged_attitudes(track, times) : coordinated_attitudes(motions, step_s);

    std::vector<FlightSample> samples(times.size());
    for (std::size_t i = 0; i < samples.size(); ++i) {
        samples[i].time_s = times[i] - track.fixes.front().time_s;
        net::wire::FgNetFdm& fdm = samples[i].fdm;
        fdm.latitude_deg = places[i].latitude_deg;
        fdm.longitude_deg = places[i].longitude_deg;
        fdm.altitude_m = places[i].altitude_m + sampling.altitude_offset_m;
        fdm.attitude = attitudes[i];
        fdm.velocity_ned_mps = motions[i].velocity_ned;
        if (track.start_utc_s) {
            fdm.cur_time = static_cast<std::uint32_t>(static_cast<double>(*track.start_utc_s) + times[i]);
        }
    }
    fill_attitude_rates(samples, step_s);
    return samples;
}

}  // namespace eyepoint::tools
