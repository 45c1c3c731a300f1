/// What pages are put together from.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <utility>

#include <nlohmann/json.hpp>

namespace eyepoint::tools {

/// A place's name and what is put there.
using PagePart = std::pair<std::string_view, std::string>;

/// The page with each {{name}} replaced; what is put in is not looked at again. Names without a part go.
[[nodiscard]] std::string fill(std::string_view page, std::span<const PagePart> parts);

/// As text of an element or a quoted attribute.
[[nodiscard]] std::string escaped(std::string_view text);

/// As text of a script element: nothing in it ends the element.
[[nodiscard]] std::string script_text(const nlohmann::json& json);

}  // namespace eyepoint::tools
