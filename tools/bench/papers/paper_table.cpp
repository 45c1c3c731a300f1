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
    nlohmann::json json{
        {"name", row.name}, {"x", row.x}, {"line", row.line}, {"figures", nlohmann::json::array()}};
    for (const PaperFigure& figure : row.figures)
        json["figures"].push_back(
            {{"what", figure.what}, {"ours", json_of(figure.ours)}, {"paper", json_of(figure.paper)}});
    return json;
}

nlohmann::json json_of(const PaperPlot& plot) {
    return {{"title", plot.title},
            {"x", plot.x},
            {"figures", plot.figures},
            {"lines", plot.lines},
            {"logarithmic", plot.logarithmic}};
}

// What these read throws where it is not what json_of() gave.

std::optional<double> number_of(const nlohmann::json& json) {
    return json.is_null() ? std::nullopt : std::optional{json.get<double>()};
}

PaperRow row_of(const nlohmann::json& json) {
    PaperRow row{json.at("name"), {}, json.at("x"), json.at("line")};
    for (const auto& figure : json.at("figures"))
        row.figures.push_back(
            {figure.at("what"), number_of(figure.at("ours")), number_of(figure.at("paper"))});
    return row;
}

PaperTable table_of(const nlohmann::json& json) {
    PaperTable table{json.at("source"), json.at("setting"), json.at("names"), {}, json.at("notes"), {}};
    for (const auto& row : json.at("rows")) table.rows.push_back(row_of(row));
    for (const auto& plot : json.at("plots"))
        table.plots.push_back(
            {plot.at("title"), plot.at("x"), plot.at("figures"), plot.at("lines"), plot.at("logarithmic")});
    return table;
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
        nlohmann::json plots = nlohmann::json::array();
        for (const PaperPlot& plot : table.plots) plots.push_back(json_of(plot));
        json["tables"].push_back({{"source", table.source},
                                  {"setting", table.setting},
                                  {"names", table.names},
                                  {"rows", std::move(rows)},
                                  {"notes", table.notes},
                                  {"plots", std::move(plots)}});
    }
    return json;
}

tl::expected<PaperResults, std::string> parse_paper_results(const std::string& text) {
    try {
        const auto json = nlohmann::json::parse(text);
        PaperResults results{json.at("machine"), {}};
        for (const auto& table : json.at("tables")) results.tables.push_back(table_of(table));
        return results;
    } catch (const nlohmann::json::exception& error) {
        return tl::unexpected(fmt::format("not results of eyepoint-bench papers: {}", error.what()));
    }
}

}  // namespace eyepoint::tools
