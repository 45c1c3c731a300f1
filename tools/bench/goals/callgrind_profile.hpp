/// What valgrind's callgrind writes: instructions by function.
#pragma once

#include <cstdint>
#include <istream>
#include <map>
#include <string>

namespace eyepoint::tools {

/// Instructions that each function took itself, those that it called left out; functions by their full names.
/// Reads the first event of a "callgrind format" file, version 1, as the Valgrind manual describes it
/// (cost lines, "fn=", and "calls=" whose next line is the callee's); lines of other kinds are passed over.
[[nodiscard]] std::map<std::string, std::uint64_t> instructions_by_function(std::istream& profile);

}  // namespace eyepoint::tools
