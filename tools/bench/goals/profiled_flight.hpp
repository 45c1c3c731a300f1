/// Selection along cruise, in instructions: other work on the machine does not count.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>
#include <tl/expected.hpp>

#include "tools/bench/goals/goal_bench.hpp"

namespace eyepoint::tools {

struct ProfiledFlight {
    std::string profile;    ///< of selection alone, by callgrind (callgrind_profile.hpp)
    nlohmann::json frames;  ///< what `eyepoint-bench measure` says of each
};

/// The first so many frames of cruise, flown by `eyepoint-bench measure` under valgrind's callgrind, with
/// these arguments more. On failure (no valgrind, or one that cannot run it): one sentence.
[[nodiscard]] tl::expected<ProfiledFlight, std::string> profile_selection(
    const GoalBench& bench, std::size_t frames, const std::vector<std::string>& arguments);

}  // namespace eyepoint::tools
