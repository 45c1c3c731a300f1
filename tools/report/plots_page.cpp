#include "tools/report/plots_page.hpp"

#include <utility>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "tools/report/page_parts.hpp"
#include "tools/report/page_texts.hpp"

namespace eyepoint::tools {

namespace {

std::string paragraph_with_code(const std::string& text) {
    std::string result;
    bool code = false;
    for (const char c : escaped(text)) {
        if (c != '`') {
            result += c;
            continue;
        }
        result += code ? "</code>" : "<code>";
        code = !code;
    }
    return code ? result + "</code>" : result;
}

std::string markup_of(const PlotSection& section) {
    return fmt::format(
        "<section>\n<h2>{}</h2>\n<p class=\"note\">{}</p>\n<div class=\"plots\"></div>\n</section>\n",
        escaped(section.heading), paragraph_with_code(section.text));
}

nlohmann::json json_of(const Plot& plot) {
    nlohmann::json series = nlohmann::json::array();
    for (const PlotSeries& one : plot.series)
        series.push_back({{"name", one.name},
                          {"colour", one.colour % kPlotColours},
                          {"dashed", one.dashed},
                          {"points", one.points}});
    return {{"title", plot.title},
            {"x", plot.x},
            {"y", plot.y},
            {"logarithmic", plot.logarithmic},
            {"series", std::move(series)}};
}

}  // namespace

std::string plots_page(const std::string& title, const std::string& lead,
                       std::span<const PlotSection> sections) {
    std::string markup;
    nlohmann::json data = nlohmann::json::array();
    for (const PlotSection& section : sections) {
        markup += markup_of(section);
        nlohmann::json plots = nlohmann::json::array();
        for (const Plot& plot : section.plots) plots.push_back(json_of(plot));
        data.push_back(std::move(plots));
    }
    const std::array<PagePart, 8> parts = {{
        {"title", escaped(title)},
        {"style", std::string(kPageCss)},
        {"lead", paragraph_with_code(lead)},
        {"sections", std::move(markup)},
        {"chart_library", std::string(kChartJs)},
        {"data", script_text(data)},
        {"charts", std::string(kChartsJs)},
        {"script", std::string(kPlotsJs)},
    }};
    return fill(kPlotsHtml, parts);
}

}  // namespace eyepoint::tools
