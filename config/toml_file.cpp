#include "config/toml_file.hpp"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <system_error>

#include <fmt/format.h>
#include <toml++/toml.h>

#include "config/value.hpp"

namespace eyepoint::config {
namespace {

constexpr std::size_t kLargestBytes = 1 << 20;

tl::expected<std::string, std::string> read_whole(const std::filesystem::path& file) {
    const auto unreadable = [&](std::string_view reason) {
        return tl::unexpected(
            fmt::format("{}: settings file cannot be read: {}", one_line(file.string()), reason));
    };
    std::error_code error;
    const auto status = std::filesystem::status(file, error);
    if (std::filesystem::is_directory(status)) return unreadable("it is a folder");
    std::ifstream stream(file, std::ios::binary);
    if (!stream) return unreadable(std::strerror(errno));
    std::string content(kLargestBytes + 1, '\0');
    stream.read(content.data(), static_cast<std::streamsize>(content.size()));
    if (stream.bad()) return unreadable(std::strerror(errno));
    content.resize(static_cast<std::size_t>(stream.gcount()));
    if (content.size() > kLargestBytes) return unreadable("it is larger than 1 MiB, so not a settings file");
    return content;
}

std::string describe(toml::node_type type) {
    switch (type) {
        case toml::node_type::boolean:
            return "true or false";
        case toml::node_type::array:
            return "an array";
        case toml::node_type::table:
            return "a table";
        default:
            return "a date or time";
    }
}

std::variant<Value, OtherValue> value_of(const toml::node& node) {
    if (const auto* text = node.as_string()) return Value(text->get());
    if (const auto* number = node.as_floating_point()) return Value(number->get());
    if (const auto* whole = node.as_integer()) return Value(static_cast<std::int64_t>(whole->get()));
    return OtherValue{describe(node.type())};
}

int line_of(const toml::key& key) { return static_cast<int>(key.source().begin.line); }

/// The keys of one section; what lies deeper is reported as the table that it is.
void append_section(const toml::key& section, const toml::table& content, std::vector<FileEntry>& entries) {
    if (content.empty()) {
        entries.push_back({std::string(section.str()), true, line_of(section), OtherValue{"a table"}});
    }
    for (const auto& [key, node] : content) {
        entries.push_back(
            {fmt::format("{}.{}", section.str(), key.str()), false, line_of(key), value_of(node)});
    }
}

std::vector<FileEntry> entries_of(const toml::table& root) {
    std::vector<FileEntry> entries;
    for (const auto& [key, node] : root) {
        if (const auto* section = node.as_table()) {
            append_section(key, *section, entries);
        } else {
            entries.push_back({std::string(key.str()), false, line_of(key), value_of(node)});
        }
    }
    std::ranges::stable_sort(entries, {}, &FileEntry::line);
    return entries;
}

}  // namespace

tl::expected<std::vector<FileEntry>, std::string> read_toml_file(const std::filesystem::path& file) {
    const auto content = read_whole(file);
    if (!content) return tl::unexpected(content.error());
    try {
        return entries_of(toml::parse(*content));
    } catch (const toml::parse_error& error) {
        return tl::unexpected(fmt::format("{}:{}: not valid TOML: {}", one_line(file.string()),
                                          error.source().begin.line, one_line(error.description())));
    }
}

}  // namespace eyepoint::config
