/// What a build made, for people and for programs.
#pragma once

#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "terrain/database/database.hpp"
#include "tools/terrain/mosaic.hpp"

namespace eyepoint::tools {

struct BuildReport {
    std::string output;
    terrain::Manifest manifest;
    std::vector<LayerFacts> elevation;  ///< finest first
    std::vector<FileFacts> imagery;     ///< finest first
    std::vector<std::string> notes;
    double seconds = 0.0;
};

[[nodiscard]] std::string as_text(const BuildReport& report);
[[nodiscard]] nlohmann::json as_json(const BuildReport& report);

}  // namespace eyepoint::tools
