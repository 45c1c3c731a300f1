/// A settings file that exists as long as its test.
#pragma once

#include <filesystem>
#include <fstream>
#include <string>

#include <unistd.h>

namespace eyepoint::config::test {

class SettingsFile {
  public:
    explicit SettingsFile(const std::string& content)
        : folder_(std::filesystem::temp_directory_path() / ("eyepoint-config-" + std::to_string(getpid()))) {
        std::filesystem::create_directories(folder_);
        std::ofstream(path(), std::ios::binary) << content;
    }
    ~SettingsFile() { std::filesystem::remove_all(folder_); }
    SettingsFile(const SettingsFile&) = delete;
    SettingsFile& operator=(const SettingsFile&) = delete;

    [[nodiscard]] std::filesystem::path path() const { return folder_ / "eyepoint.toml"; }

  private:
    std::filesystem::path folder_;
};

}  // namespace eyepoint::config::test
