/// A settings file as plain values with line numbers, before any of it is checked.
#pragma once

#include <filesystem>
#include <string>
#include <variant>
#include <vector>

#include <tl/expected.hpp>

#include "config/keys.hpp"

namespace eyepoint::config {

/// What no setting can be: a date, an array, a table or a truth value.
struct OtherValue {
    std::string description;  ///< "an array"
};

struct FileEntry {
    std::string name;  ///< "section.name"; a value outside every section, and an empty section, has no dot
    bool is_section = false;  ///< a section that holds nothing
    int line = 0;
    std::variant<Value, OtherValue> value;
};

/// Reads a TOML file; the entries are in the order of their lines. On failure: one sentence with file and
/// line.
[[nodiscard]] tl::expected<std::vector<FileEntry>, std::string> read_toml_file(
    const std::filesystem::path& file);

}  // namespace eyepoint::config
