#include "tools/bench/papers/paper_plots.hpp"

#include <algorithm>
#include <array>
#include <optional>
#include <utility>
#include <vector>

#include <fmt/format.h>

namespace eyepoint::tools {

namespace {

using Points = std::vector<std::array<double, 2>>;

Points points_of(const PaperTable& table, const std::string& line, const std::string& what,
                 std::optional<double> PaperFigure::*whose) {
    Points points;
    for (const PaperRow& row : table.rows) {
        const auto figure = std::ranges::find(row.figures, what, &PaperFigure::what);
        if (row.line == line && figure != row.figures.end() && (*figure).*whose)
            points.push_back({row.x, *((*figure).*whose)});
    }
    return points;
}

std::string name_of(const PaperPlot& plot, const std::string& line, const std::string& figure) {
    if (plot.figures.size() == 1) return line;
    return plot.lines.size() == 1 ? figure : fmt::format("{}, {}", line, figure);
}

Plot drawn(const PaperTable& table, const PaperPlot& plot) {
    Plot result{plot.title, plot.x, "", plot.logarithmic, {}};
    std::size_t colour = 0;
    for (const std::string& figure : plot.figures) {
        for (const std::string& line : plot.lines) {
            const std::string name = name_of(plot, line, figure);
            Points ours = points_of(table, line, figure, &PaperFigure::ours),
                   papers = points_of(table, line, figure, &PaperFigure::paper);
            if (!ours.empty()) result.series.push_back({name, colour, false, std::move(ours)});
            if (!papers.empty()) result.series.push_back({name + ", paper", colour, true, std::move(papers)});
            ++colour;
        }
    }
    return result;
}

}  // namespace

PlotSection plots_of(const PaperTable& table) {
    PlotSection section{table.source, table.setting, {}};
    for (const PaperPlot& plot : table.plots) section.plots.push_back(drawn(table, plot));
    return section;
}

std::string plots_page(const PaperResults& results) {
    std::vector<PlotSection> sections;
    for (const PaperTable& table : results.tables) sections.push_back(plots_of(table));
    return plots_page("Published experiments",
                      fmt::format("Dashed: the paper's figures, of another machine, terrain and flight. "
                                  "Tables and notes: `papers.md`. Machine: {}",
                                  results.machine),
                      sections);
}

}  // namespace eyepoint::tools
