/// What a recorded flight holds, for a person.
#pragma once

#include <filesystem>
#include <string>

#include <tl/expected.hpp>

namespace eyepoint::tools {

/// A few lines of text, ending in a newline. On failure: one sentence.
[[nodiscard]] tl::expected<std::string, std::string> describe_flight(const std::filesystem::path& file);

}  // namespace eyepoint::tools
