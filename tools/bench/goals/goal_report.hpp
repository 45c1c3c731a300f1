/// What goals came to, gathered as they are measured.
#pragma once

#include <functional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include <tl/expected.hpp>

#include "tools/bench/goals/goal_choice.hpp"
#include "tools/bench/goals/goal_line.hpp"

namespace eyepoint::tools {

/// Thread use: one thread.
class GoalReport {
  public:
    /// `hear` is told of each line as it comes. Lines of goals that are not chosen are dropped.
    GoalReport(GoalChoice chosen, std::function<void(const GoalLine&)> hear)
        : chosen_(std::move(chosen)), hear_(std::move(hear)) {}

    [[nodiscard]] bool wants(int goal) const { return chosen_.has(goal); }
    void add(GoalLine line);
    /// A sentence beside the lines.
    void note(std::string text) { notes_.push_back(std::move(text)); }

    [[nodiscard]] std::span<const GoalLine> lines() const { return lines_; }
    [[nodiscard]] std::span<const std::string> notes() const { return notes_; }

  private:
    GoalChoice chosen_;
    std::function<void(const GoalLine&)> hear_;
    std::vector<GoalLine> lines_;
    std::vector<std::string> notes_;
};

/// Of measuring; on failure: one sentence.
using GoalDone = tl::expected<void, std::string>;

}  // namespace eyepoint::tools
