#include "tools/report/contact_sheet.hpp"

#include <algorithm>
#include <memory>
#include <system_error>

#include <OpenImageIO/imageio.h>
#include <fmt/format.h>

namespace eyepoint::tools {
namespace {

constexpr int kGapPx = 6;
constexpr std::uint8_t kPaper = 24;  ///< grey level of the gaps

}  // namespace

SmallPicture lay_out(std::span<const SmallPicture> pictures, int columns) {
    const int count = static_cast<int>(pictures.size());
    const int across = std::min(columns, std::max(count, 1));
    const int down = (count + across - 1) / across;
    int cell_width = 0, cell_height = 0;
    for (const SmallPicture& picture : pictures) {
        cell_width = std::max(cell_width, picture.width_px);
        cell_height = std::max(cell_height, picture.height_px);
    }
    SmallPicture sheet{.name = "contact-sheet",
                       .width_px = across * (cell_width + kGapPx) + kGapPx,
                       .height_px = down * (cell_height + kGapPx) + kGapPx};
    const auto row_bytes = static_cast<std::ptrdiff_t>(sheet.width_px) * 3;
    sheet.rgb.assign(static_cast<std::size_t>(row_bytes * sheet.height_px), kPaper);
    for (int i = 0; i < count; ++i) {
        const SmallPicture& picture = pictures[static_cast<std::size_t>(i)];
        const std::ptrdiff_t left = kGapPx + (i % across) * (cell_width + kGapPx);
        const std::ptrdiff_t top = kGapPx + (i / across) * (cell_height + kGapPx);
        const std::ptrdiff_t picture_row = static_cast<std::ptrdiff_t>(picture.width_px) * 3;
        for (std::ptrdiff_t row = 0; row < picture.height_px; ++row) {
            std::copy_n(picture.rgb.begin() + row * picture_row, picture_row,
                        sheet.rgb.begin() + (top + row) * row_bytes + left * 3);
        }
    }
    return sheet;
}

tl::expected<void, std::string> write_picture(const std::filesystem::path& file,
                                              const SmallPicture& picture) {
    // The extension chooses the format, so it stays last in the name that the picture is written under.
    const auto partial = file.parent_path() / (file.stem().string() + ".partial" + file.extension().string());
    const auto failed = [&](const std::string& reason) {
        std::error_code ignored;
        std::filesystem::remove(partial, ignored);
        return tl::unexpected(fmt::format("{}: picture cannot be written: {}", file.string(), reason));
    };
    const auto output = OIIO::ImageOutput::create(file.string());
    if (!output) return failed(OIIO::geterror());
    const OIIO::ImageSpec spec(picture.width_px, picture.height_px, 3, OIIO::TypeDesc::UINT8);
    const bool written = output->open(partial.string(), spec) &&
                         output->write_image(OIIO::TypeDesc::UINT8, picture.rgb.data()) && output->close();
    if (!written) return failed(output->geterror());
    std::error_code error;
    std::filesystem::rename(partial, file, error);
    if (error) return failed(error.message());
    return {};
}

}  // namespace eyepoint::tools
