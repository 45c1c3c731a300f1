#include <algorithm>

#include <fmt/format.h>

#include "config/keys.hpp"
#include "config/load.hpp"
#include "config/value.hpp"

namespace eyepoint::config {
namespace {

constexpr std::size_t kWidest = 40;  ///< value that comments still stand in one column behind

std::string describe(const Origin& origin) {
    switch (origin.kind) {
        case Origin::Kind::BuiltIn:
            return "built-in";
        case Origin::Kind::File:
            return fmt::format("file {}", one_line(origin.where));
        case Origin::Kind::Environment:
            return fmt::format("environment {}", one_line(origin.where));
        case Origin::Kind::Flag:
            break;
    }
    return fmt::format("flag {}", one_line(origin.where));
}

std::string print_section(const Section& section, const LoadedSettings& loaded) {
    std::vector<std::pair<std::string, std::string>> lines;
    for (const Key& key : keys()) {
        if (key.section != section.name) continue;
        const auto origin = loaded.origins.find(key.full_name());
        lines.emplace_back(fmt::format("{} = {}", key.name, toml_text(key.get(loaded.settings))),
                           describe(origin == loaded.origins.end() ? Origin{} : origin->second));
    }
    // Comments stand in one column, but one long path does not push all of them off the screen.
    std::size_t width = 0;
    for (const auto& [value, origin] : lines) {
        if (value.size() <= kWidest) width = std::max(width, value.size());
    }
    std::string text = fmt::format("[{}]\n", section.name);
    for (const auto& [value, origin] : lines) text += fmt::format("{:<{}}  # {}\n", value, width, origin);
    return text;
}

}  // namespace

std::string print(const LoadedSettings& loaded) {
    std::string text;
    for (const Section& section : sections()) {
        if (!text.empty()) text += '\n';
        text += print_section(section, loaded);
    }
    return text;
}

}  // namespace eyepoint::config
