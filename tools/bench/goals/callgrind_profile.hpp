/// What valgrind's callgrind writes: instructions by function.
#pragma once

#include <cstdint>
#include <istream>
#include <map>
#include <string>
#include <string_view>

namespace eyepoint::tools {

/// Instructions that each function took itself, those that it called left out; functions by their full names.
/// Reads the first event of a "callgrind format" file, version 1, as the Valgrind manual describes it
/// (cost lines, "fn=", and "calls=" whose next line is the callee's); lines of other kinds are passed over.
[[nodiscard]] std::map<std::string, std::uint64_t> instructions_by_function(std::istream& profile);

/// Instructions of calls, what was called in them included, of functions with `name` in theirs. Calls by such
/// a function itself are within.
[[nodiscard]] std::uint64_t instructions_of_calls(std::istream& profile, std::string_view name);

}  // namespace eyepoint::tools
