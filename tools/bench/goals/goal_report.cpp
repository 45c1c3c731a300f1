#include "tools/bench/goals/goal_report.hpp"

namespace eyepoint::tools {

void GoalReport::add(GoalLine line) {
    if (!wants(line.goal)) return;
    if (hear_) hear_(line);
    lines_.push_back(std::move(line));
}

}  // namespace eyepoint::tools
