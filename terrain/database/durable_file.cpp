#include "terrain/database/durable_file.hpp"

#include <cerrno>
#include <cstring>
#include <utility>

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

namespace eyepoint::terrain {

namespace {

std::string cannot_write(const std::filesystem::path& path) {
    return fmt::format("{}: cannot be written ({}); check the folder's rights and the space left",
                       path.string(), std::strerror(errno));
}

bool write_all(const OpenFile& file, std::span<const std::uint8_t> bytes) {
    while (!bytes.empty()) {
        const ssize_t written = ::write(file.descriptor(), bytes.data(), bytes.size());
        if (written < 0 && errno == EINTR) continue;
        if (written <= 0) return false;
        bytes = bytes.subspan(static_cast<std::size_t>(written));
    }
    return true;
}

}  // namespace

OpenFile::OpenFile(const std::filesystem::path& path, int flags, unsigned mode)
    : descriptor_(::open(path.c_str(), flags | O_CLOEXEC, mode)) {}

OpenFile::~OpenFile() {
    if (is_open()) ::close(descriptor_);
}

OpenFile::OpenFile(OpenFile&& other) noexcept : descriptor_(std::exchange(other.descriptor_, -1)) {}

OpenFile& OpenFile::operator=(OpenFile&& other) noexcept {
    std::swap(descriptor_, other.descriptor_);
    return *this;
}

tl::expected<std::vector<std::uint8_t>, std::string> read_range(const OpenFile& file, std::uint64_t offset,
                                                                std::size_t size) {
    std::vector<std::uint8_t> bytes(size);
    std::size_t have = 0;
    while (have < size) {
        const ssize_t got =
            ::pread(file.descriptor(), bytes.data() + have, size - have, static_cast<off_t>(offset + have));
        if (got < 0 && errno == EINTR) continue;
        if (got < 0) return tl::unexpected(fmt::format("cannot be read ({})", std::strerror(errno)));
        if (got == 0) return tl::unexpected(std::string{"ends too early"});
        have += static_cast<std::size_t>(got);
    }
    return bytes;
}

tl::expected<void, std::string> write_durably(const std::filesystem::path& path,
                                              std::initializer_list<std::span<const std::uint8_t>> parts) {
    const OpenFile file{path, O_WRONLY | O_CREAT | O_EXCL, 0666};
    if (!file.is_open()) return tl::unexpected(cannot_write(path));
    for (const auto part : parts) {
        if (!write_all(file, part)) return tl::unexpected(cannot_write(path));
    }
    if (::fsync(file.descriptor()) != 0) return tl::unexpected(cannot_write(path));
    return {};
}

tl::expected<void, std::string> sync_folder(const std::filesystem::path& folder) {
    const OpenFile file{folder.empty() ? std::filesystem::path{"."} : folder, O_RDONLY | O_DIRECTORY};
    if (!file.is_open() || ::fsync(file.descriptor()) != 0) return tl::unexpected(cannot_write(folder));
    return {};
}

}  // namespace eyepoint::terrain
