#include "config/near_match.hpp"

#include <algorithm>
#include <numeric>
#include <vector>

namespace eyepoint::config {
namespace {

/// Longer than any name could be: not a slip of the keyboard, and not worth the time.
constexpr std::size_t kLongest = 100;

}  // namespace

std::size_t edit_distance(std::string_view from, std::string_view to) {
    // Rows of the dynamic programme: before_last, last and current prefix of `from` against every prefix of
    // `to`.
    std::vector<std::size_t> before_last(to.size() + 1), last(to.size() + 1), current(to.size() + 1);
    std::iota(last.begin(), last.end(), std::size_t{0});
    for (std::size_t i = 1; i <= from.size(); ++i) {
        current[0] = i;
        for (std::size_t j = 1; j <= to.size(); ++j) {
            const std::size_t replaced = last[j - 1] + (from[i - 1] == to[j - 1] ? 0 : 1);
            current[j] = std::min({last[j] + 1, current[j - 1] + 1, replaced});
            const bool swapped = i > 1 && j > 1 && from[i - 1] == to[j - 2] && from[i - 2] == to[j - 1];
            if (swapped) current[j] = std::min(current[j], before_last[j - 2] + 1);
        }
        std::swap(before_last, last);
        std::swap(last, current);
    }
    return last[to.size()];
}

std::optional<std::string> near_match(std::string_view typed, std::span<const std::string> names) {
    if (typed.empty() || typed.size() > kLongest || names.empty()) return std::nullopt;
    const auto distance = [&](const std::string& name) { return edit_distance(typed, name); };
    const auto nearest = std::ranges::min_element(names, {}, distance);
    if (distance(*nearest) > std::max<std::size_t>(1, typed.size() / 3)) return std::nullopt;
    return *nearest;
}

}  // namespace eyepoint::config
