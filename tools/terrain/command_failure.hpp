/// How a command of eyepoint-terrain ends that cannot do what it was asked.
#pragma once

#include <cstdio>
#include <string_view>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

namespace eyepoint::tools {

/// One line on stderr.
inline void report_failure(std::string_view command, std::string_view reason) {
    fmt::print(stderr, "eyepoint-terrain {}: {}\n", command, reason);
}

/// The same, and ends the program with exit code 1 by throwing CLI::RuntimeError.
[[noreturn]] inline void fail(std::string_view command, std::string_view reason) {
    report_failure(command, reason);
    throw CLI::RuntimeError(1);
}

}  // namespace eyepoint::tools
