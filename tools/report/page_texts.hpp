/// The files of page/ and Chart.js, as text (written by the build).
#pragma once

#include <string_view>

namespace eyepoint::tools {

extern const std::string_view kPageHtml;
extern const std::string_view kPageCss;
extern const std::string_view kPageJs;
extern const std::string_view kPlotsHtml;
extern const std::string_view kPlotsJs;
extern const std::string_view kChartsJs;
extern const std::string_view kChartJs;

}  // namespace eyepoint::tools
