/// The manifest as text (docs/database-format.md, "Manifest").
#pragma once

#include <string>
#include <string_view>

#include <tl/expected.hpp>

#include "terrain/database/database.hpp"

namespace eyepoint::terrain {

inline constexpr const char* kManifestFile = "manifest.json";
/// The value of "format" in every manifest: how a folder is known to be a terrain database.
inline constexpr const char* kFormatName = "eyepoint-terrain";

[[nodiscard]] std::string to_json(const Manifest& manifest);

/// On failure: the fault, without naming the file.
[[nodiscard]] tl::expected<Manifest, std::string> manifest_from_json(std::string_view text);

}  // namespace eyepoint::terrain
