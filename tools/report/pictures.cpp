#include "tools/report/pictures.hpp"

#include <algorithm>
#include <array>
#include <memory>
#include <string_view>
#include <system_error>

#include <OpenImageIO/imagebuf.h>
#include <OpenImageIO/imagebufalgo.h>
#include <fmt/format.h>
#include <turbojpeg.h>

namespace eyepoint::tools {
namespace {

constexpr std::array<std::string_view, 3> kExtensions = {".png", ".jpg", ".jpeg"};

bool is_picture(const std::filesystem::directory_entry& entry) {
    const auto extension = entry.path().extension().string();
    return entry.is_regular_file() && std::ranges::find(kExtensions, extension) != kExtensions.end();
}

}  // namespace

tl::expected<std::vector<std::filesystem::path>, std::string> choose_pictures(
    const std::filesystem::path& folder, std::size_t count) {
    std::error_code error;
    std::vector<std::filesystem::path> all;
    for (const auto& entry : std::filesystem::directory_iterator(folder, error)) {
        if (is_picture(entry)) all.push_back(entry.path());
    }
    if (error)
        return tl::unexpected(
            fmt::format("{}: pictures cannot be listed: {}", folder.string(), error.message()));
    if (all.empty()) return tl::unexpected(fmt::format("{}: holds no picture (.png, .jpg)", folder.string()));
    std::ranges::sort(all);
    if (all.size() <= count) return all;
    std::vector<std::filesystem::path> chosen;
    for (std::size_t i = 0; i < count; ++i) {
        chosen.push_back(all[count == 1 ? 0 : i * (all.size() - 1) / (count - 1)]);
    }
    return chosen;
}

tl::expected<SmallPicture, std::string> read_small(const std::filesystem::path& file, int width_px) {
    OIIO::ImageBuf whole(file.string());
    if (!whole.read(0, 0, true, OIIO::TypeDesc::UINT8) || whole.nchannels() < 3) {
        const auto reason = whole.has_error() ? whole.geterror() : "it has fewer than three colours";
        return tl::unexpected(fmt::format("{}: picture cannot be read: {}", file.string(), reason));
    }
    const auto& spec = whole.spec();
    SmallPicture picture{.name = file.stem().string(), .width_px = width_px};
    picture.height_px = std::max(1, (spec.height * width_px + spec.width / 2) / spec.width);
    const auto small =
        OIIO::ImageBufAlgo::resize(OIIO::ImageBufAlgo::channels(whole, 3, {}), "", 0.0F,
                                   OIIO::ROI(0, picture.width_px, 0, picture.height_px, 0, 1, 0, 3));
    picture.rgb.resize(static_cast<std::size_t>(picture.width_px) *
                       static_cast<std::size_t>(picture.height_px) * 3);
    const OIIO::ROI all(0, picture.width_px, 0, picture.height_px, 0, 1, 0, 3);
    if (small.has_error() || !small.get_pixels(all, OIIO::TypeDesc::UINT8, picture.rgb.data())) {
        return tl::unexpected(
            fmt::format("{}: picture cannot be resized: {}", file.string(), small.geterror()));
    }
    return picture;
}

tl::expected<std::string, std::string> jpeg(const SmallPicture& picture, int quality) {
    const std::unique_ptr<void, int (*)(tjhandle)> compressor(tjInitCompress(), tjDestroy);
    unsigned char* bytes = nullptr;
    unsigned long size = 0;
    const int failed = tjCompress2(compressor.get(), picture.rgb.data(), picture.width_px, 0,
                                   picture.height_px, TJPF_RGB, &bytes, &size, TJSAMP_420, quality, 0);
    const std::unique_ptr<unsigned char, void (*)(unsigned char*)> owner(bytes, tjFree);
    if (failed != 0) {
        return tl::unexpected(
            fmt::format("{}: cannot be written as JPEG: {}", picture.name, tjGetErrorStr2(compressor.get())));
    }
    return std::string(reinterpret_cast<const char*>(bytes), size);
}

}  // namespace eyepoint::tools
