/// A goal, what was measured, and whether that is good enough.
#pragma once

#include <span>
#include <string>

#include <nlohmann/json.hpp>

namespace eyepoint::tools {

struct GoalLine {
    enum class Sense { AtMost, AtLeast };

    int goal = 0;      ///< its number
    std::string what;  ///< what is measured, and where
    double figure = 0.0;
    Sense sense = Sense::AtMost;
    double target = 0.0;
    std::string unit;  ///< empty for counts

    [[nodiscard]] bool met() const { return sense == Sense::AtMost ? figure <= target : figure >= target; }
};

/// Processor and number of cores.
[[nodiscard]] std::string machine_name();
/// The machine that goals were measured on, in one line: processor, cores, load.
[[nodiscard]] std::string describe_machine();

/// A line each, for people.
[[nodiscard]] std::string describe(const GoalLine& line);
/// A page with a table. `notes`: paragraphs under it.
[[nodiscard]] std::string markdown(std::span<const GoalLine> lines, const std::string& machine,
                                   std::span<const std::string> notes);
[[nodiscard]] nlohmann::json to_json(std::span<const GoalLine> lines, const std::string& machine,
                                     std::span<const std::string> notes);

}  // namespace eyepoint::tools
