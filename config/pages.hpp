/// The pages that the table of settings is written out to.
#pragma once

#include <string>

namespace eyepoint::config {

/// config/eyepoint.toml: every key at its built-in value, with its description.
[[nodiscard]] std::string sample_file();

/// docs/settings.md: every key, what it takes and its built-in value.
[[nodiscard]] std::string reference_page();

}  // namespace eyepoint::config
