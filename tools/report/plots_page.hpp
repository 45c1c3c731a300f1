/// A page of plots: one HTML file that opens offline and asks nothing of any server.
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <string>
#include <vector>

namespace eyepoint::tools {

/// Colours there are.
inline constexpr std::size_t kPlotColours = 6;

struct PlotSeries {
    std::string name;
    std::size_t colour = 0;  ///< 0..kPlotColours - 1
    bool dashed = false;
    std::vector<std::array<double, 2>> points;  ///< x, y; joined in this order
};

struct Plot {
    std::string title;
    std::string x, y;          ///< what the axes are, with units
    bool logarithmic = false;  ///< y
    std::vector<PlotSeries> series;
};

struct PlotSection {
    std::string heading;
    std::string text;  ///< a paragraph; `so` is code
    std::vector<Plot> plots;
};

/// lead: a paragraph under the title.
[[nodiscard]] std::string plots_page(const std::string& title, const std::string& lead,
                                     std::span<const PlotSection> sections);

}  // namespace eyepoint::tools
