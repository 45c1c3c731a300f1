/// The table of settings: one row a key, from which loading, checking, printing, docs/settings.md and the
/// sample config/eyepoint.toml all follow.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <variant>

#include "config/settings.hpp"

namespace eyepoint::config {

/// A setting's value: text (also a choice's name), a number, or a whole number.
using Value = std::variant<std::string, double, std::int64_t>;

enum class ValueKind : std::uint8_t { Text, Number, Whole, Choice };

struct Section {
    std::string_view name;
    std::string_view description;
};

struct Key {
    std::string_view section;
    std::string_view name;
    std::string_view description;  ///< one sentence without its full stop
    ValueKind kind = ValueKind::Text;
    double minimum = 0.0, maximum = 0.0;          ///< Number and Whole, both allowed
    std::span<const std::string_view> choices{};  ///< Choice
    std::string_view form{};                      ///< Text: the form expected, for messages; empty: any text
    bool (*accepts)(std::string_view text) = nullptr;  ///< Text: whether it has that form; nullptr: any text
    Value (*get)(const Settings&) = nullptr;
    void (*set)(Settings&, const Value&) = nullptr;  ///< the value must have passed check()

    [[nodiscard]] std::string full_name() const;  ///< "terrain.tau_px"
    [[nodiscard]] std::string variable() const;   ///< "EYEPOINT_TERRAIN_TAU_PX"
};

inline constexpr std::string_view kVariablePrefix = "EYEPOINT_";

/// In the order of the sample file; the keys of a section stand together.
[[nodiscard]] std::span<const Section> sections();
[[nodiscard]] std::span<const Key> keys();

/// nullptr where there is no such key.
[[nodiscard]] const Key* find_key(std::string_view full_name);

}  // namespace eyepoint::config
