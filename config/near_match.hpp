/// Which known name somebody meant who typed an unknown one.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace eyepoint::config {

/// Letters to insert, leave out, replace or swap with the next to get from one to the other (optimal string
/// alignment distance).
[[nodiscard]] std::size_t edit_distance(std::string_view from, std::string_view to);

/// The nearest of the names, where it is near enough to be meant: at most a third of the typed letters wrong.
[[nodiscard]] std::optional<std::string> near_match(std::string_view typed,
                                                    std::span<const std::string> names);

}  // namespace eyepoint::config
