/// Files on a POSIX system: whole reads of a range, writes that are on disk when they return.
#pragma once

#include <cstdint>
#include <filesystem>
#include <initializer_list>
#include <span>
#include <string>
#include <vector>

#include <tl/expected.hpp>

namespace eyepoint::terrain {

/// An open file; closed when it goes. May be moved, not copied.
class OpenFile {
  public:
    OpenFile() = default;
    /// As open(2); on failure is_open() is false and errno tells why.
    OpenFile(const std::filesystem::path& path, int flags, unsigned mode = 0);
    ~OpenFile();
    OpenFile(OpenFile&& other) noexcept;
    OpenFile& operator=(OpenFile&& other) noexcept;

    [[nodiscard]] bool is_open() const { return descriptor_ >= 0; }
    [[nodiscard]] int descriptor() const { return descriptor_; }

  private:
    int descriptor_ = -1;
};

/// Exactly size bytes from offset (pread). On failure: the fault, without naming the file.
[[nodiscard]] tl::expected<std::vector<std::uint8_t>, std::string> read_range(const OpenFile& file,
                                                                              std::uint64_t offset,
                                                                              std::size_t size);

/// Makes a new file of these parts, one after the other, and waits until it is on disk.
/// On failure: one sentence naming the file.
[[nodiscard]] tl::expected<void, std::string> write_durably(
    const std::filesystem::path& path, std::initializer_list<std::span<const std::uint8_t>> parts);

/// Waits until the folder's entries are on disk. On failure: one sentence naming the folder.
[[nodiscard]] tl::expected<void, std::string> sync_folder(const std::filesystem::path& folder);

}  // namespace eyepoint::terrain
