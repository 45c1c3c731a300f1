#include "tools/report/page_parts.hpp"

#include <algorithm>

namespace eyepoint::tools {

std::string fill(std::string_view page, std::span<const PagePart> parts) {
    std::string result;
    while (true) {
        const auto open = page.find("{{");
        const auto close = page.find("}}", open);
        if (open == std::string_view::npos || close == std::string_view::npos) return result += page;
        result += page.substr(0, open);
        const auto name = page.substr(open + 2, close - open - 2);
        const auto part = std::ranges::find(parts, name, [](const auto& entry) { return entry.first; });
        if (part != parts.end()) result += part->second;
        page.remove_prefix(close + 2);
    }
}

std::string escaped(std::string_view text) {
    std::string result;
    for (const char c : text) {
        switch (c) {
            case '&':
                result += "&amp;";
                break;
            case '<':
                result += "&lt;";
                break;
            case '>':
                result += "&gt;";
                break;
            case '"':
                result += "&quot;";
                break;
            default:
                result += c;
        }
    }
    return result;
}

std::string script_text(const nlohmann::json& json) {
    std::string text;
    for (const char c : json.dump(-1, ' ', true))
        text += c == '<' ? std::string("\\u003c") : std::string(1, c);
    return text;
}

}  // namespace eyepoint::tools
