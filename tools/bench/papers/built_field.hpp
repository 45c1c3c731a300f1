/// Fields built with eyepoint-terrain for an experiment.
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include <tl/expected.hpp>

#include "terrain/database/database.hpp"
#include "tools/bench/goals/scratch_folder.hpp"
#include "tools/bench/papers/paper_experiment.hpp"

namespace eyepoint::tools {

/// A database in a folder of its own, which goes when it goes.
class BuiltField {
  public:
    /// `eyepoint-terrain build` with these arguments; heights are above the ellipsoid. On failure: one
    /// sentence.
    [[nodiscard]] static tl::expected<BuiltField, std::string> build(
        const PaperSettings& settings, const std::vector<std::string>& arguments);

    [[nodiscard]] const std::shared_ptr<const terrain::Database>& database() const { return database_; }
    [[nodiscard]] std::filesystem::path folder() const { return database_->folder(); }

  private:
    BuiltField(ScratchFolder scratch, std::shared_ptr<const terrain::Database> database)
        : scratch_(std::move(scratch)), database_(std::move(database)) {}

    ScratchFolder scratch_;
    std::shared_ptr<const terrain::Database> database_;
};

}  // namespace eyepoint::tools
