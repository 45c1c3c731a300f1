#include "config/value.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <optional>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace eyepoint::config {
namespace {

/// Number of bytes of the well-formed UTF-8 character that `text` begins with, by the Unicode Standard's
/// table of well-formed byte sequences (chapter 3, D92); 0 where there is none.
std::size_t utf8_length(std::string_view text) {
    const auto at = [&](std::size_t i) -> unsigned {
        return i < text.size() ? static_cast<unsigned char>(text[i]) : 0U;
    };
    const auto between = [](unsigned byte, unsigned low, unsigned high) {
        return byte >= low && byte <= high;
    };
    const unsigned lead = at(0);
    if (lead < 0x80) return text.empty() ? 0 : 1;
    const unsigned second_low = lead == 0xE0 ? 0xA0 : lead == 0xF0 ? 0x90 : 0x80;
    const unsigned second_high = lead == 0xED ? 0x9F : lead == 0xF4 ? 0x8F : 0xBF;
    const std::size_t length = between(lead, 0xC2, 0xDF)   ? 2
                               : between(lead, 0xE0, 0xEF) ? 3
                               : between(lead, 0xF0, 0xF4) ? 4
                                                           : 0;
    if (length == 0 || !between(at(1), second_low, second_high)) return 0;
    for (std::size_t i = 2; i < length; ++i) {
        if (!between(at(i), 0x80, 0xBF)) return 0;
    }
    return length;
}

constexpr std::size_t kLongestLine = 200;

bool is_control(char c) { return static_cast<unsigned char>(c) < 0x20 || c == 0x7F; }

/// A file must be able to hold every text there is: TOML is UTF-8.
bool is_plain_utf8(std::string_view text) {
    while (!text.empty()) {
        const auto length = utf8_length(text);
        if (length == 0 || is_control(text.front())) return false;
        text.remove_prefix(length);
    }
    return true;
}

bool has_form(const Key& key, std::string_view text) {
    return is_plain_utf8(text) && (key.accepts == nullptr || key.accepts(text));
}

tl::unexpected<std::string> refused(const Key& key, std::string_view found) {
    return tl::unexpected(fmt::format("is {}; expected {}", found, expected_of(key)));
}

bool in_range(const Key& key, double value) { return value >= key.minimum && value <= key.maximum; }

template <typename Number>
std::optional<Number> read_number(std::string_view text) {
    Number number{};
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
    if (error != std::errc{} || end != text.data() + text.size()) return std::nullopt;
    return number;
}

}  // namespace

std::string expected_of(const Key& key) {
    switch (key.kind) {
        case ValueKind::Text:
            return key.form.empty() ? "text (UTF-8, one line)" : std::string(key.form);
        case ValueKind::Number:
            return fmt::format("a number from {:.15g} to {:.15g}", key.minimum, key.maximum);
        case ValueKind::Whole:
            return fmt::format("a whole number from {:.15g} to {:.15g}", key.minimum, key.maximum);
        case ValueKind::Choice:
            break;
    }
    std::string names;
    for (std::size_t i = 0; i < key.choices.size(); ++i) {
        const bool last = i + 1 == key.choices.size();
        names += fmt::format("{}\"{}\"", i == 0 ? "" : last ? " or " : ", ", key.choices[i]);
    }
    return names;
}

tl::expected<Value, std::string> check(const Key& key, const Value& value) {
    const auto* text = std::get_if<std::string>(&value);
    const auto* number = std::get_if<double>(&value);
    const auto* whole = std::get_if<std::int64_t>(&value);
    switch (key.kind) {
        case ValueKind::Text:
            if (text != nullptr && has_form(key, *text)) return value;
            break;
        case ValueKind::Number:
            if (number != nullptr && in_range(key, *number)) return value;
            if (whole != nullptr && in_range(key, static_cast<double>(*whole)))
                return static_cast<double>(*whole);
            break;
        case ValueKind::Whole:
            if (whole != nullptr && in_range(key, static_cast<double>(*whole))) return value;
            break;
        case ValueKind::Choice:
            if (text != nullptr && std::ranges::find(key.choices, *text) != key.choices.end()) return value;
            break;
    }
    return refused(key, one_line(toml_text(value)));
}

tl::expected<Value, std::string> parse_text(const Key& key, std::string_view text) {
    if (key.kind == ValueKind::Number) {
        if (const auto number = read_number<double>(text)) return check(key, *number);
    } else if (key.kind == ValueKind::Whole) {
        if (const auto whole = read_number<std::int64_t>(text)) return check(key, *whole);
    }
    return check(key, std::string(text));
}

std::string toml_text(const Value& value) {
    if (const auto* whole = std::get_if<std::int64_t>(&value)) return fmt::format("{}", *whole);
    if (const auto* number = std::get_if<double>(&value)) {
        std::string digits = fmt::format("{}", *number);
        const bool is_whole = digits.find_first_not_of("-0123456789") == std::string::npos;
        return is_whole ? digits + ".0" : digits;
    }
    std::string quoted = "\"";
    for (const char c : std::get<std::string>(value)) {
        if (is_control(c)) {
            quoted += fmt::format("\\u{:04X}", static_cast<unsigned>(static_cast<unsigned char>(c)));
        } else {
            if (c == '"' || c == '\\') quoted += '\\';
            quoted += c;
        }
    }
    return quoted + '"';
}

std::string one_line(std::string_view text) {
    std::string line;
    while (!text.empty() && line.size() < kLongestLine) {
        const auto length = utf8_length(text);
        const bool shown = length != 0 && !is_control(text.front());
        line += shown ? text.substr(0, length) : std::string_view("?");
        text.remove_prefix(std::max<std::size_t>(length, 1));
    }
    return text.empty() ? line : line + "...";
}

}  // namespace eyepoint::config
