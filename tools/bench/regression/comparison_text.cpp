#include <array>
#include <cmath>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "tools/bench/regression/comparison.hpp"

namespace eyepoint::tools {

namespace {

constexpr std::array kVerdicts{"same", "better", "worse", "different", "unclear"};
constexpr std::array kKinds{"count", "ratio", "time", "picture", "band"};

const char* name_of(Verdict verdict) { return kVerdicts[static_cast<std::size_t>(verdict)]; }
const char* name_of(ComparedLine::Kind kind) { return kKinds[static_cast<std::size_t>(kind)]; }

std::string figure(double value) {
    return value == std::floor(value) ? fmt::format("{:.0f}", value) : fmt::format("{:.4g}", value);
}

std::string percent(double ratio) { return fmt::format("{:+.1f}%", 100.0 * (ratio - 1.0)); }

std::string change(const ComparedLine& line) {
    if (line.change)
        return fmt::format("{} (95%: {} to {})", percent(line.change->value), percent(line.change->low),
                           percent(line.change->high));
    if (line.verdict == Verdict::Same || line.before == 0.0 || line.kind == ComparedLine::Kind::Band)
        return {};
    return percent(line.after / line.before);
}

}  // namespace

std::string describe(const Comparison& comparison) {
    std::string text = fmt::format("{:<11}{:<46}{:>13}{:>13}  {}\n", "", "", "before", "after", "change");
    for (const ComparedLine& line : comparison.lines) {
        text += fmt::format("{:<11}{:<46}{:>13}{:>13}  {}", name_of(line.verdict), line.what,
                            figure(line.before), figure(line.after), change(line));
        text += line.remark.empty() ? "\n" : "  " + line.remark + "\n";
    }
    for (const std::string& note : comparison.notes) text += note + "\n";
    return text;
}

std::string to_json_text(const Comparison& comparison) {
    nlohmann::ordered_json json{{"eyepoint_comparison", 1},
                                {"passes", comparison.passes(false)},
                                {"passes_exactly", comparison.passes(true)},
                                {"notes", comparison.notes}};
    for (const ComparedLine& line : comparison.lines) {
        nlohmann::ordered_json one{
            {"what", line.what},   {"kind", name_of(line.kind)},       {"before", line.before},
            {"after", line.after}, {"verdict", name_of(line.verdict)}, {"remark", line.remark}};
        if (line.change)
            one["after_over_before"] = {
                {"value", line.change->value}, {"low", line.change->low}, {"high", line.change->high}};
        json["lines"].push_back(one);
    }
    return json.dump(1) + "\n";
}

}  // namespace eyepoint::tools
