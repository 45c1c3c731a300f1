#include "tools/bench/papers/paper_table.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include <fmt/format.h>

namespace eyepoint::tools {

namespace {

/// Three digits, or whole.
std::string number(std::optional<double> value) {
    if (!value) return "";
    const double size = std::abs(*value);
    return fmt::format("{:.{}f}", *value, size >= 100.0 ? 0 : size >= 10.0 ? 1 : 2);
}

bool paper_gives(const PaperTable& table, std::size_t column) {
    return std::ranges::any_of(table.rows,
                               [&](const PaperRow& row) { return row.figures[column].paper.has_value(); });
}

std::string head(const PaperTable& table) {
    std::string names = fmt::format("| {} |", table.names), rule = "| --- |";
    for (std::size_t column = 0; column < table.rows.front().figures.size(); ++column) {
        names += fmt::format(" {} |", table.rows.front().figures[column].what);
        rule += " --- |";
        if (!paper_gives(table, column)) continue;
        names += " paper |";
        rule += " --- |";
    }
    return names + "\n" + rule + "\n";
}

std::string line(const PaperTable& table, const PaperRow& row) {
    std::string text = fmt::format("| {} |", row.name);
    for (std::size_t column = 0; column < row.figures.size(); ++column) {
        text += fmt::format(" {} |", number(row.figures[column].ours));
        if (paper_gives(table, column)) text += fmt::format(" {} |", number(row.figures[column].paper));
    }
    return text + "\n";
}

nlohmann::json json_of(std::optional<double> value) {
    return value ? nlohmann::json(*value) : nlohmann::json(nullptr);
}

nlohmann::json json_of(const PaperRow& row) {
    nlohmann::json json{{"name", row.name}, {"figures", nlohmann::json::array()}};
    for (const PaperFigure& figure : row.figures)
        json["figures"].push_back(
            {{"what", figure.what}, {"ours", json_of(figure.ours)}, {"paper", json_of(figure.paper)}});
    return json;
}

}  // namespace

std::string markdown(std::span<const PaperTable> tables, const std::string& machine) {
    std::string text = fmt::format("# Published experiments, last run\n\nMachine: {}\n", machine);
    for (const PaperTable& table : tables) {
        text += fmt::format("\n## {}\n\n{}\n\n", table.source, table.setting);
        if (!table.rows.empty()) text += head(table);
        for (const PaperRow& row : table.rows) text += line(table, row);
        for (const std::string& note : table.notes) text += fmt::format("\n{}\n", note);
    }
    return text;
}

nlohmann::json to_json(std::span<const PaperTable> tables, const std::string& machine) {
    nlohmann::json json{{"machine", machine}, {"tables", nlohmann::json::array()}};
    for (const PaperTable& table : tables) {
        nlohmann::json rows = nlohmann::json::array();
        for (const PaperRow& row : table.rows) rows.push_back(json_of(row));
        json["tables"].push_back({{"source", table.source},
                                  {"setting", table.setting},
                                  {"names", table.names},
                                  {"rows", std::move(rows)},
                                  {"notes", table.notes}});
    }
    return json;
}

}  // namespace eyepoint::tools
