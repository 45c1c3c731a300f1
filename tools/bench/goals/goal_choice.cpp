#include "tools/bench/goals/goal_choice.hpp"

#include <algorithm>
#include <charconv>
#include <sstream>
#include <utility>

#include <fmt/format.h>

namespace eyepoint::tools {

GoalChoice::GoalChoice() {
    for (const GoalSubject& subject : kGoalSubjects) numbers_.insert(subject.number);
}

tl::expected<GoalChoice, std::string> GoalChoice::parse(const std::string& text) {
    const GoalChoice all;
    std::set<int> numbers;
    std::istringstream stream(text);
    for (std::string part; std::getline(stream, part, ',');) {
        int number = 0;
        const char* end = part.data() + part.size();
        const auto [rest, fault] = std::from_chars(part.data(), end, number);
        if (fault != std::errc{} || rest != end || !all.has(number)) {
            return tl::unexpected(fmt::format("'{}' is no goal; goals are {} to {}, written as 3,8", part,
                                              kGoalSubjects.front().number, kGoalSubjects.back().number));
        }
        numbers.insert(number);
    }
    if (numbers.empty()) return tl::unexpected(std::string("no goal is named; write them as 3,8"));
    return GoalChoice(std::move(numbers));
}

bool GoalChoice::has_any(std::span<const int> goals) const {
    return std::ranges::any_of(goals, [&](int goal) { return has(goal); });
}

}  // namespace eyepoint::tools
