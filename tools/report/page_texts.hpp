/// The files of page/ and Chart.js, as text (written by the build).
#pragma once

#include <string_view>

namespace eyepoint::tools {

extern const std::string_view page_html;
extern const std::string_view page_css;
extern const std::string_view page_js;
extern const std::string_view chart_js;

}  // namespace eyepoint::tools
