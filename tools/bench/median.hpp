/// The median of what was measured.
#pragma once

#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

namespace eyepoint::tools {

/// Of an even number, the upper of the two in the middle; 0 of none.
[[nodiscard]] inline double median(std::vector<double> values) {
    if (values.empty()) return 0.0;
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    return *middle;
}

/// Of what `value` gives of each.
template <class Measured, class Value>
[[nodiscard]] double median_of(const Measured& measured, const Value& value) {
    std::vector<double> values;
    for (const auto& one : measured) values.push_back(value(one));
    return median(std::move(values));
}

}  // namespace eyepoint::tools
