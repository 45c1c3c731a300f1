#include "ig/render/shading_trial.hpp"

#include <algorithm>
#include <array>
#include <chrono>

#include "ig/gpu_fence.hpp"

namespace eyepoint::ig {

namespace {

constexpr std::size_t kTrials = 3;
using Durations = std::array<std::chrono::steady_clock::duration, kTrials>;

std::chrono::steady_clock::duration duration_of(const std::function<void(Shading)>& draw, Shading shading) {
    const auto begin = std::chrono::steady_clock::now();
    draw(shading);
    (void)wait_for_gpu();
    return std::chrono::steady_clock::now() - begin;
}

auto median(Durations durations) {
    std::sort(durations.begin(), durations.end());
    return durations[kTrials / 2];
}

}  // namespace

Shading faster_shading(const std::function<void(Shading)>& draw) {
    Durations forward{}, deferred{};
    // The first of each pays for what is used for the first time.
    (void)duration_of(draw, Shading::Forward);
    (void)duration_of(draw, Shading::Deferred);
    for (std::size_t i = 0; i < kTrials; ++i) {
        forward[i] = duration_of(draw, Shading::Forward);
        deferred[i] = duration_of(draw, Shading::Deferred);
    }
    return median(deferred) < median(forward) ? Shading::Deferred : Shading::Forward;
}

}  // namespace eyepoint::ig
