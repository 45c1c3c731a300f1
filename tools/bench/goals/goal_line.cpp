#include "tools/bench/goals/goal_line.hpp"

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <thread>
#include <utility>

#include <fmt/format.h>

namespace eyepoint::tools {

namespace {

std::string with_unit(double value, const std::string& unit) {
    const std::string number = value >= 1000.0 ? fmt::format("{:.0f}", value) : fmt::format("{:.4g}", value);
    return unit.empty() ? number : number + " " + unit;
}

std::string figure(const GoalLine& line) { return line.figure ? with_unit(*line.figure, line.unit) : "-"; }

std::string target(const GoalLine& line) {
    return (line.sense == GoalLine::Sense::AtMost ? "at most " : "at least ") +
           with_unit(line.target, line.unit);
}

const char* name(GoalVerdict verdict) {
    switch (verdict) {
        case GoalVerdict::Met:
            return "met";
        case GoalVerdict::Missed:
            return "MISSED";
        case GoalVerdict::NotMeasured:
            break;
    }
    return "not measured";
}

std::string processor() {
    std::ifstream stream("/proc/cpuinfo");
    for (std::string line; std::getline(stream, line);) {
        if (line.starts_with("model name")) return line.substr(line.find(':') + 2);
    }
    return "unknown processor";
}

}  // namespace

GoalVerdict GoalLine::verdict() const {
    if (!figure) return GoalVerdict::NotMeasured;
    const bool good = sense == Sense::AtMost ? *figure <= target : *figure >= target;
    return good ? GoalVerdict::Met : GoalVerdict::Missed;
}

GoalLine at_most(int goal, std::string what, std::optional<double> figure, double target, std::string unit) {
    return {goal, std::move(what), figure, GoalLine::Sense::AtMost, target, std::move(unit)};
}

GoalLine at_least(int goal, std::string what, std::optional<double> figure, double target, std::string unit) {
    return {goal, std::move(what), figure, GoalLine::Sense::AtLeast, target, std::move(unit)};
}

bool any_missed(std::span<const GoalLine> lines) {
    return std::ranges::any_of(lines,
                               [](const GoalLine& line) { return line.verdict() == GoalVerdict::Missed; });
}

std::string machine_name() {
    return fmt::format("{}, {} cores", processor(), std::thread::hardware_concurrency());
}

std::string describe_machine() {
    double load = 0.0;
    if (::getloadavg(&load, 1) != 1) load = 0.0;
    return fmt::format("{}, load {:.1f}", machine_name(), load);
}

std::string describe(const GoalLine& line) {
    return fmt::format("{:>2}  {:<76}{:>14}  {:<22}{}", line.goal, line.what, figure(line), target(line),
                       name(line.verdict()));
}

std::string markdown(std::span<const GoalLine> lines, const std::string& machine,
                     std::span<const std::string> notes) {
    std::string text = "# Goals, last run\n\nMachine: " + machine + "\n\n";
    text += "| goal | measured | figure | target | |\n| --- | --- | --- | --- | --- |\n";
    for (const GoalLine& line : lines) {
        const char* emphasis = line.verdict() == GoalVerdict::Missed ? "**" : "";
        text += fmt::format("| {} | {} | {} | {} | {}{}{} |\n", line.goal, line.what, figure(line),
                            target(line), emphasis, name(line.verdict()), emphasis);
    }
    for (const std::string& note : notes) text += "\n" + note + "\n";
    return text;
}

nlohmann::json to_json(std::span<const GoalLine> lines, const std::string& machine,
                       std::span<const std::string> notes) {
    nlohmann::json json{{"machine", machine}, {"notes", notes}, {"goals", nlohmann::json::array()}};
    for (const GoalLine& line : lines) {
        json["goals"].push_back({{"goal", line.goal},
                                 {"what", line.what},
                                 {"figure", line.figure ? nlohmann::json(*line.figure) : nullptr},
                                 {"target", line.target},
                                 {"sense", line.sense == GoalLine::Sense::AtMost ? "at most" : "at least"},
                                 {"unit", line.unit},
                                 {"verdict", name(line.verdict())}});
    }
    return json;
}

}  // namespace eyepoint::tools
