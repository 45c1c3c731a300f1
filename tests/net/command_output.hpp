/// Other programs asked in tests.
#pragma once

#include <array>
#include <cstdio>
#include <string>

namespace eyepoint::net::testing {

/// What a shell command prints on stdout; empty where it cannot be started.
[[nodiscard]] inline std::string output_of(const std::string& command) {
    std::string text;
    std::FILE* pipe = ::popen(command.c_str(), "r");
    std::array<char, 512> chunk{};
    while (pipe != nullptr && std::fgets(chunk.data(), chunk.size(), pipe) != nullptr) text += chunk.data();
    if (pipe != nullptr) ::pclose(pipe);
    return text;
}

}  // namespace eyepoint::net::testing
