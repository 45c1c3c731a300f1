#include "tools/bench/goals/goal_line.hpp"

#include <cstdlib>
#include <fstream>
#include <thread>

#include <fmt/format.h>

namespace eyepoint::tools {

namespace {

std::string with_unit(double value, const std::string& unit) {
    const std::string number = value >= 1000.0 ? fmt::format("{:.0f}", value) : fmt::format("{:.4g}", value);
    return unit.empty() ? number : number + " " + unit;
}

std::string target(const GoalLine& line) {
    return (line.sense == GoalLine::Sense::AtMost ? "at most " : "at least ") +
           with_unit(line.target, line.unit);
}

std::string processor() {
    std::ifstream stream("/proc/cpuinfo");
    for (std::string line; std::getline(stream, line);) {
        if (line.starts_with("model name")) return line.substr(line.find(':') + 2);
    }
    return "unknown processor";
}

}  // namespace

std::string machine_name() {
    return fmt::format("{}, {} cores", processor(), std::thread::hardware_concurrency());
}

std::string describe_machine() {
    double load = 0.0;
    if (::getloadavg(&load, 1) != 1) load = 0.0;
    return fmt::format("{}, load {:.1f}", machine_name(), load);
}

std::string describe(const GoalLine& line) {
    return fmt::format("{}  {:<72}{:>14}  {:<22}{}", line.goal, line.what, with_unit(line.figure, line.unit),
                       target(line), line.met() ? "met" : "MISSED");
}

std::string markdown(std::span<const GoalLine> lines, const std::string& machine,
                     std::span<const std::string> notes) {
    std::string text = "# Level-of-detail goals, last run\n\nMachine: " + machine + "\n\n";
    text += "| goal | measured | figure | target | |\n| --- | --- | --- | --- | --- |\n";
    for (const GoalLine& line : lines) {
        text +=
            fmt::format("| {} | {} | {} | {} | {} |\n", line.goal, line.what,
                        with_unit(line.figure, line.unit), target(line), line.met() ? "met" : "**missed**");
    }
    for (const std::string& note : notes) text += "\n" + note + "\n";
    return text;
}

nlohmann::json to_json(std::span<const GoalLine> lines, const std::string& machine,
                       std::span<const std::string> notes) {
    nlohmann::json json{{"machine", machine}, {"notes", notes}};
    for (const GoalLine& line : lines) {
        json["goals"].push_back({{"goal", line.goal},
                                 {"what", line.what},
                                 {"figure", line.figure},
                                 {"target", line.target},
                                 {"sense", line.sense == GoalLine::Sense::AtMost ? "at most" : "at least"},
                                 {"unit", line.unit},
                                 {"met", line.met()}});
    }
    return json;
}

}  // namespace eyepoint::tools
