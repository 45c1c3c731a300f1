/// A goal, what was measured, and whether that is good enough.
#pragma once

#include <optional>
#include <span>
#include <string>

#include <nlohmann/json.hpp>

namespace eyepoint::tools {

enum class GoalVerdict { Met, Missed, NotMeasured };

struct GoalLine {
    enum class Sense { AtMost, AtLeast };

    int goal = 0;                  ///< its number (goal_choice.hpp)
    std::string what;              ///< what is measured, and where
    std::optional<double> figure;  ///< none: could not be measured here
    Sense sense = Sense::AtMost;
    double target = 0.0;
    std::string unit;  ///< empty for counts and ratios

    /// A figure that is not a number is missed.
    [[nodiscard]] GoalVerdict verdict() const;
};

[[nodiscard]] GoalLine at_most(int goal, std::string what, std::optional<double> figure, double target,
                               std::string unit = "");
[[nodiscard]] GoalLine at_least(int goal, std::string what, std::optional<double> figure, double target,
                                std::string unit = "");

/// What was not measured is not missed.
[[nodiscard]] bool any_missed(std::span<const GoalLine> lines);

/// Processor and number of cores.
[[nodiscard]] std::string machine_name();
/// The machine that goals were measured on, in one line: processor, cores, load.
[[nodiscard]] std::string describe_machine();

/// A line each, for people.
[[nodiscard]] std::string describe(const GoalLine& line);
/// A page with a table. `notes`: paragraphs under it.
[[nodiscard]] std::string markdown(std::span<const GoalLine> lines, const std::string& machine,
                                   std::span<const std::string> notes);
/// "figure" is null where it was not measured.
[[nodiscard]] nlohmann::json to_json(std::span<const GoalLine> lines, const std::string& machine,
                                     std::span<const std::string> notes);

}  // namespace eyepoint::tools
