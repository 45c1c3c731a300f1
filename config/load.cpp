#include "config/load.hpp"

#include <algorithm>
#include <array>

#include <fmt/format.h>
#include <unistd.h>

#include "config/keys.hpp"
#include "config/near_match.hpp"
#include "config/toml_file.hpp"
#include "config/value.hpp"

namespace eyepoint::config {
namespace {

using namespace std::string_view_literals;

constexpr std::array kOtherVariables = {"EYEPOINT_REAL_DATA"sv};

/// What has been loaded so far, and every fault met.
struct Loading {
    LoadedSettings loaded;
    std::vector<std::string> faults;

    void take(const Key& key, const tl::expected<Value, std::string>& value, const Origin& origin) {
        if (!value) {
            faults.push_back(
                fmt::format("{}: {} {}", one_line(origin.where), key.full_name(), value.error()));
            return;
        }
        key.set(loaded.settings, *value);
        loaded.origins[key.full_name()] = origin;
    }
};

std::vector<std::string> full_names() {
    std::vector<std::string> names;
    for (const Key& key : keys()) names.push_back(key.full_name());
    return names;
}

/// "unknown key 'terrain.databse'; did you mean 'terrain.database'?" A name without its section is known too.
std::string unknown_key(std::string_view typed) {
    const auto says = fmt::format("unknown key '{}'", one_line(typed));
    const auto name_alone =
        typed.substr(typed.rfind('.') == std::string_view::npos ? 0 : typed.rfind('.') + 1);
    const auto same_name = std::ranges::find(keys(), name_alone, &Key::name);
    if (same_name != keys().end()) return fmt::format("{}; did you mean '{}'?", says, same_name->full_name());
    if (const auto meant = near_match(typed, full_names()))
        return fmt::format("{}; did you mean '{}'?", says, *meant);
    return fmt::format("{}; --print-config lists every key", says);
}

std::string unknown_section(std::string_view typed) {
    std::vector<std::string> names;
    for (const Section& section : sections()) names.emplace_back(section.name);
    const auto says = fmt::format("unknown section '{}'", one_line(typed));
    if (const auto meant = near_match(typed, names))
        return fmt::format("{}; did you mean '{}'?", says, *meant);
    return fmt::format("{}; the sections are {}", says, fmt::join(names, ", "));
}

bool is_section(std::string_view name) {
    return std::ranges::find(sections(), name, &Section::name) != sections().end();
}

tl::expected<Value, std::string> value_of(const Key& key, const FileEntry& entry) {
    if (const auto* value = std::get_if<Value>(&entry.value)) return check(key, *value);
    return tl::unexpected(
        fmt::format("is {}; expected {}", std::get<OtherValue>(entry.value).description, expected_of(key)));
}

void take_entry(Loading& loading, const FileEntry& entry, const std::string& where) {
    const auto section = entry.name.substr(0, entry.name.find('.'));
    const auto fault = [&](const std::string& sentence) {
        loading.faults.push_back(fmt::format("{}: {}", one_line(where), sentence));
    };
    if (const Key* key = find_key(entry.name)) {
        loading.take(*key, value_of(*key, entry), {Origin::Kind::File, where});
    } else if (entry.name == section && is_section(section)) {
        if (!entry.is_section) fault(fmt::format("'{0}' is a value; expected the section [{0}]", section));
    } else if (entry.is_section) {
        fault(unknown_section(entry.name));
    } else {
        fault(unknown_key(entry.name));
    }
}

void take_file(Loading& loading, const std::filesystem::path& file) {
    const auto entries = read_toml_file(file);
    if (!entries) {
        loading.faults.push_back(entries.error());
        return;
    }
    for (const FileEntry& entry : *entries) {
        take_entry(loading, entry, fmt::format("{}:{}", file.string(), entry.line));
    }
}

std::string unknown_variable(std::string_view name) {
    std::vector<std::string> names;
    for (const Key& key : keys()) names.push_back(key.variable());
    const auto says = fmt::format("unknown environment variable '{}'", one_line(name));
    if (const auto meant = near_match(name, names))
        return fmt::format("{}; did you mean '{}'?", says, *meant);
    return fmt::format("{}; expected EYEPOINT_<SECTION>_<KEY>, such as {}", says, names.front());
}

void take_environment(Loading& loading, const EnvironmentVariables& environment) {
    for (const auto& [name, value] : environment) {
        if (!name.starts_with(kVariablePrefix)) continue;
        if (std::ranges::find(kOtherVariables, name) != kOtherVariables.end()) continue;
        const auto key = std::ranges::find(keys(), name, &Key::variable);
        if (key == keys().end()) {
            loading.faults.push_back(unknown_variable(name));
        } else {
            loading.take(*key, parse_text(*key, value), {Origin::Kind::Environment, name});
        }
    }
}

void take_overrides(Loading& loading, std::span<const Override> overrides) {
    for (const Override& given : overrides) {
        const Key* key = find_key(given.key);
        if (key == nullptr) {
            loading.faults.push_back(fmt::format("{}: {}", one_line(given.flag), unknown_key(given.key)));
        } else {
            loading.take(*key, parse_text(*key, given.value), {Origin::Kind::Flag, given.flag});
        }
    }
}

}  // namespace

tl::expected<LoadedSettings, std::string> load(const LoadRequest& request) {
    Loading loading;
    for (const Key& key : keys()) loading.loaded.origins[key.full_name()] = {};
    if (request.file) take_file(loading, *request.file);
    take_environment(loading, request.environment);
    take_overrides(loading, request.overrides);
    const auto& faults = loading.faults;
    if (faults.empty()) return loading.loaded;
    if (faults.size() == 1) return tl::unexpected(faults.front());
    return tl::unexpected(fmt::format("{} (and {} more fault{})", faults.front(), faults.size() - 1,
                                      faults.size() == 2 ? "" : "s"));
}

EnvironmentVariables process_environment() {
    EnvironmentVariables variables;
    for (char** entry = environ; entry != nullptr && *entry != nullptr; ++entry) {
        const std::string_view text(*entry);
        const auto equals = text.find('=');
        if (equals == std::string_view::npos) continue;
        variables.emplace_back(text.substr(0, equals), text.substr(equals + 1));
    }
    return variables;
}

std::span<const std::string_view> other_environment_variables() { return kOtherVariables; }

}  // namespace eyepoint::config
