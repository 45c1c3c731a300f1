/// One value: read from text, checked against its key's row, written as TOML.
#pragma once

#include <string>
#include <string_view>

#include <tl/expected.hpp>

#include "config/keys.hpp"

namespace eyepoint::config {

/// What the key wants, for messages and for the manual: "a number from 0.1 to 100".
[[nodiscard]] std::string expected_of(const Key& key);

/// Checks type, range, choice and form. A Number takes a whole number too. On failure: "is 500; expected a
/// number from 0.1 to 100", to stand behind the key's name.
[[nodiscard]] tl::expected<Value, std::string> check(const Key& key, const Value& value);

/// Reads the text of a variable or a flag; no quotes, no spaces around numbers. Fails as check() does.
[[nodiscard]] tl::expected<Value, std::string> parse_text(const Key& key, std::string_view text);

/// As TOML: text quoted and escaped, a number in the fewest digits that read back to the same bits.
[[nodiscard]] std::string toml_text(const Value& value);

/// Text fit for one line of a message or comment: control characters replaced, long text cut.
[[nodiscard]] std::string one_line(std::string_view text);

}  // namespace eyepoint::config
