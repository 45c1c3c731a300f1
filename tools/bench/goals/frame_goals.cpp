#include "tools/bench/goals/frame_goals.hpp"

#include <algorithm>
#include <map>
#include <optional>

#include "tools/bench/regression/flight_ratios.hpp"

namespace eyepoint::tools {

namespace {

constexpr double kTrianglesOfGoal = 25000.0;

/// Median time outside GL of the frames with about as many triangles as the goal is stated for; where no
/// frame has, of all frames, times what they have fewer or more.
std::optional<double> outside_gl_ms(const FlightResult& result) {
    const auto *outside_ms = result.find("outside_gl_ms"), *triangles = result.find("triangles");
    if (outside_ms == nullptr || triangles == nullptr) return std::nullopt;
    std::vector<double> scaled_ms;
    for (std::size_t i = 0; i < result.frames; ++i)
        scaled_ms.push_back((*outside_ms)[i] * kTrianglesOfGoal / std::max((*triangles)[i], 1.0));
    const auto middle = scaled_ms.begin() + static_cast<std::ptrdiff_t>(scaled_ms.size() / 2);
    std::nth_element(scaled_ms.begin(), middle, scaled_ms.end());
    return *middle;
}

/// The driver has the states of another mesh to leave again.
bool after_still(const FlightResult& result, std::size_t frame) {
    const auto* still_ms = result.find("still_cpu_ms");
    return still_ms != nullptr && frame > 0 && (*still_ms)[frame - 1] > 0.0;
}

/// Of a column, over the frames after the first that `counts`.
template <typename Counts>
double sum_after_first(const std::vector<double>& column, const Counts& counts) {
    double sum = 0.0;
    for (std::size_t i = 1; i < column.size(); ++i) sum += counts(i) ? column[i] : 0.0;
    return sum;
}

}  // namespace

std::vector<GoalLine> frame_goals(const FlightResult& result, int goal) {
    const std::map<std::string, double> targets{
        {"price_of_lod", 1.10}, {"p99_over_median", 1.25}, {"p999_over_median", 1.5}};
    std::vector<GoalLine> lines;
    const auto add = [&](const std::string& what, double figure, double target, const char* unit) {
        lines.push_back(
            {goal, what + ", " + result.identity.flight, figure, GoalLine::Sense::AtMost, target, unit});
    };
    for (const FlightRatio& ratio : flight_ratios(result)) {
        const auto target = targets.find(ratio.key);
        if (target != targets.end()) add(ratio.what, ratio.interval().value, target->second, "");
    }
    if (const auto outside_ms = outside_gl_ms(result))
        add("frame thread outside GL at 25,000 triangles", *outside_ms, 0.5, "ms");
    const auto *allocations = result.find("allocations"), *uploads = result.find("blocks_uploaded");
    if (allocations != nullptr && uploads != nullptr)
        add("heap allocations of the frame thread in frames without uploads",
            sum_after_first(*allocations,
                            [&](std::size_t i) { return (*uploads)[i] == 0.0 && !after_still(result, i); }),
            0.0, "");
    if (const auto* pairs = result.find("new_state_pairs"))
        add("new programs and state pairs after the first frame",
            sum_after_first(*pairs, [](std::size_t) { return true; }), 0.0, "");
    const auto read_ms = result.figures.find("readback_ms"), copy_ms = result.figures.find("copy_ms");
    if (read_ms != result.figures.end() && copy_ms != result.figures.end())
        add("reading a frame back over copying its bytes", read_ms->second / copy_ms->second, 1.1, "");
    return lines;
}

}  // namespace eyepoint::tools
