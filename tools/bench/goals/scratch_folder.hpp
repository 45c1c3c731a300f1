/// A folder for the length of a measurement.
#pragma once

#include <filesystem>
#include <string>
#include <utility>

#include <tl/expected.hpp>

namespace eyepoint::tools {

/// Goes with all that is in it when this goes.
class ScratchFolder {
  public:
    /// Beside the system's other temporary files. On failure: one sentence.
    [[nodiscard]] static tl::expected<ScratchFolder, std::string> create();
    ScratchFolder(ScratchFolder&& other) noexcept : path_(std::exchange(other.path_, {})) {}
    ScratchFolder& operator=(ScratchFolder&& other) noexcept;
    ~ScratchFolder();

    [[nodiscard]] const std::filesystem::path& path() const { return path_; }

  private:
    explicit ScratchFolder(std::filesystem::path path) : path_(std::move(path)) {}

    std::filesystem::path path_;
};

}  // namespace eyepoint::tools
