#include "ig/output/picture_folder.hpp"

#include <cerrno>
#include <cstring>
#include <system_error>

#include <OpenImageIO/imageio.h>
#include <fmt/format.h>
#include <unistd.h>

namespace eyepoint::ig {

namespace {

constexpr int kChannelsWritten = 3;
// Zlib level 1 is about four times as fast as the default 6, for files a tenth larger.
constexpr int kPngCompression = 1;

std::string oiio_write(const Picture& picture, const std::string& file) {
    const auto writer = OIIO::ImageOutput::create("png");
    if (writer == nullptr) return OIIO::geterror();
    OIIO::ImageSpec spec(picture.size.width_px, picture.size.height_px, kChannelsWritten,
                         OIIO::TypeDesc::UINT8);
    spec.attribute("png:compressionLevel", kPngCompression);
    spec.attribute("oiio:ColorSpace", "sRGB");
    const bool written =
        writer->open(file, spec) &&
        writer->write_image(OIIO::TypeDesc::UINT8, picture.rgba.data(), Picture::kBytesPerPixel) &&
        writer->close();
    return written ? std::string{} : writer->geterror();
}

}  // namespace

tl::expected<void, std::string> write_png(const Picture& picture, const std::filesystem::path& file) {
    std::filesystem::path partial = file;
    partial += fmt::format(".partial-{}", getpid());
    std::error_code ignored;
    if (const std::string fault = oiio_write(picture, partial.string()); !fault.empty()) {
        std::filesystem::remove(partial, ignored);
        return tl::unexpected(
            fmt::format("{}: the picture cannot be written ({}); check free space and permissions",
                        file.string(), fault));
    }
    std::error_code fault;
    std::filesystem::rename(partial, file, fault);
    if (!fault) return {};
    std::filesystem::remove(partial, ignored);
    return tl::unexpected(
        fmt::format("{}: the picture cannot be put in its place ({})", file.string(), fault.message()));
}

tl::expected<PictureFolder, std::string> PictureFolder::open(const std::filesystem::path& folder) {
    std::error_code fault;
    std::filesystem::create_directories(folder, fault);
    if (!fault && !std::filesystem::is_directory(folder))
        fault = std::make_error_code(std::errc::not_a_directory);
    if (!fault && access(folder.c_str(), W_OK | X_OK) != 0) fault = {errno, std::generic_category()};
    if (fault) {
        return tl::unexpected(
            fmt::format("{}: pictures cannot be written there ({}); give --output a folder that you "
                        "may write to",
                        folder.string(), fault.message()));
    }
    return PictureFolder{folder};
}

tl::expected<void, std::string> PictureFolder::write(const Picture& picture, std::uint64_t number) const {
    return write_png(picture, folder_ / fmt::format("frame-{:06}.png", number));
}

}  // namespace eyepoint::ig
