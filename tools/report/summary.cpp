#include "tools/report/summary.hpp"

#include <algorithm>
#include <cmath>

namespace eyepoint::tools {

std::optional<Percentiles> percentiles(std::span<const double> values) {
    std::vector<double> sorted(values.begin(), values.end());
    std::erase_if(sorted, [](double value) { return std::isnan(value); });
    if (sorted.empty()) return std::nullopt;
    std::ranges::sort(sorted);
    const auto rank = [&](std::size_t percent) { return sorted[(percent * sorted.size() + 99) / 100 - 1]; };
    return Percentiles{rank(50), rank(95), rank(99), sorted.back()};
}

std::vector<double> thin(std::span<const double> values, std::size_t step, Thinning thinning) {
    std::vector<double> thinned;
    for (std::size_t first = 0; first < values.size(); first += step) {
        const auto group = values.subspan(first, std::min(step, values.size() - first));
        double value = group.front();
        if (thinning == Thinning::Largest) {
            for (const double other : group) value = std::fmax(value, other);
        }
        thinned.push_back(value);
    }
    return thinned;
}

}  // namespace eyepoint::tools
