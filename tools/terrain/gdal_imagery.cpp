#include "tools/terrain/gdal_imagery.hpp"

#include <algorithm>
#include <array>

#include <fmt/format.h>
#include <gdal_priv.h>

#include "tools/terrain/gdal_georeference.hpp"

namespace eyepoint::tools {

namespace {

tl::expected<void, std::string> check_bands(GDALDataset& dataset, const std::string& file) {
    for (int band = 1; band <= std::min(dataset.GetRasterCount(), 3); ++band) {
        if (dataset.GetRasterBand(band)->GetRasterDataType() == GDT_Byte) continue;
        return tl::unexpected(
            gdal_refusal(file,
                         "is no 8-bit picture; make one with gdal_translate -ot Byte -scale, or "
                         "name it on --dem if it holds heights"));
    }
    return {};
}

/// The bands of red, green and blue: as the file marks them, else the first three, else grey.
std::array<int, 3> colour_bands(GDALDataset& dataset) {
    const int bands = dataset.GetRasterCount();
    std::array<int, 3> chosen = bands >= 3 ? std::array{1, 2, 3} : std::array{1, 1, 1};
    for (int band = 1; bands >= 3 && band <= bands; ++band) {
        const GDALColorInterp meaning = dataset.GetRasterBand(band)->GetColorInterpretation();
        if (meaning == GCI_RedBand) chosen[0] = band;
        if (meaning == GCI_GreenBand) chosen[1] = band;
        if (meaning == GCI_BlueBand) chosen[2] = band;
    }
    return chosen;
}

/// One channel of a strip of rows into every fourth byte.
bool read_channel(GDALRasterBand& band, int row, int count, std::uint8_t* out) {
    return band.RasterIO(GF_Read, 0, row, band.GetXSize(), count, out, band.GetXSize(), count, GDT_Byte, 4,
                         static_cast<GSpacing>(band.GetXSize()) * 4, nullptr) == CE_None;
}

void apply_palette(GDALRasterBand& band, std::span<std::uint8_t> rgba) {
    const GDALColorTable* table = band.GetColorTable();
    if (table == nullptr) return;
    for (std::size_t at = 0; at < rgba.size(); at += 4) {
        const GDALColorEntry* entry = table->GetColorEntry(rgba[at]);
        if (entry == nullptr) continue;
        const std::array channels{entry->c1, entry->c2, entry->c3};
        for (std::size_t c = 0; c < 3; ++c) rgba[at + c] = static_cast<std::uint8_t>(channels[c]);
        if (entry->c4 == 0) rgba[at + 3] = 0;
    }
}

/// Alpha of a strip: the file's alpha or mask; where each band has its own nodata value, a pixel is missing
/// when all its bands are.
bool read_alpha(GDALDataset& dataset, const std::array<int, 3>& bands, int row, int count,
                std::span<std::uint8_t> rgba) {
    std::vector<std::uint8_t> strip(rgba.size() / 4);
    for (std::size_t at = 3; at < rgba.size(); at += 4) rgba[at] = 0;
    for (const int number : bands) {
        GDALRasterBand& mask = *dataset.GetRasterBand(number)->GetMaskBand();
        if (mask.RasterIO(GF_Read, 0, row, mask.GetXSize(), count, strip.data(), mask.GetXSize(), count,
                          GDT_Byte, 0, 0, nullptr) != CE_None) {
            return false;
        }
        for (std::size_t i = 0; i < strip.size(); ++i) rgba[i * 4 + 3] = std::max(rgba[i * 4 + 3], strip[i]);
    }
    return true;
}

tl::expected<std::vector<std::uint8_t>, std::string> read_colours(GDALDataset& dataset,
                                                                  const std::string& file,
                                                                  const ReadProgress& progress) {
    constexpr int kStripRows = 256;
    const auto columns = static_cast<std::size_t>(dataset.GetRasterXSize());
    const int rows = dataset.GetRasterYSize();
    const std::array<int, 3> bands = colour_bands(dataset);
    const GdalMessages messages;
    std::vector<std::uint8_t> rgba(columns * static_cast<std::size_t>(rows) * 4);
    for (int row = 0; row < rows; row += kStripRows) {
        const int count = std::min(kStripRows, rows - row);
        const std::span strip = std::span{rgba}.subspan(columns * static_cast<std::size_t>(row) * 4,
                                                        columns * static_cast<std::size_t>(count) * 4);
        bool whole = true;
        for (std::size_t c = 0; c < 3 && whole; ++c) {
            whole = read_channel(*dataset.GetRasterBand(bands[c]), row, count, strip.data() + c);
        }
        whole = whole && read_alpha(dataset, bands, row, count, strip);
        if (!whole) {
            return tl::unexpected(gdal_refusal(
                file, fmt::format("cannot be read whole, it fails near line {} ({})", row, messages.last())));
        }
        if (dataset.GetRasterCount() < 3) apply_palette(*dataset.GetRasterBand(1), strip);
        if (progress && !progress(static_cast<double>(row + count) / rows)) {
            return tl::unexpected(gdal_refusal(file, "reading was stopped"));
        }
    }
    return rgba;
}

void void_pixels_of(int value, std::span<std::uint8_t> rgba) {
    for (std::size_t at = 0; at < rgba.size(); at += 4) {
        if (rgba[at] == value && rgba[at + 1] == value && rgba[at + 2] == value) rgba[at + 3] = 0;
    }
}

tl::expected<GridMapping, std::string> place(GDALDataset& dataset, const ImageryInput& input,
                                             FileFacts& facts) {
    if (input.extent) return GridMapping::spread(*input.extent, facts.columns, facts.rows);
    auto own = own_georeference(dataset);
    if (own || facts.columns != 2 * facts.rows) return own;
    facts.notes.emplace_back(
        "has no georeference; twice as wide as high, so it is taken as the whole planet");
    return GridMapping::spread({-180.0, -90.0, 180.0, 90.0}, facts.columns, facts.rows);
}

}  // namespace

tl::expected<ColourGrid, std::string> read_imagery(const ImageryInput& input, const ReadProgress& progress) {
    const auto dataset = open_raster(input.file);
    if (!dataset) return tl::unexpected(dataset.error());
    if (const auto fit = check_bands(**dataset, input.file); !fit) return tl::unexpected(fit.error());
    FileFacts facts{.file = input.file,
                    .datum = {},
                    .columns = (*dataset)->GetRasterXSize(),
                    .rows = (*dataset)->GetRasterYSize(),
                    .spacing_deg = 0.0,
                    .voids = 0,
                    .notes = {}};
    auto mapping = place(**dataset, input, facts);
    if (!mapping) return tl::unexpected(gdal_refusal(input.file, mapping.error()));
    if (static_cast<std::uint64_t>(facts.columns) * static_cast<std::uint64_t>(facts.rows) > kMaxPixels) {
        return tl::unexpected(gdal_refusal(
            input.file,
            fmt::format("{} x {} pixels are more than the {} million that are read at once; cut it with "
                        "gdal_translate -projwin",
                        facts.columns, facts.rows, kMaxPixels / 1'000'000)));
    }
    auto rgba = read_colours(**dataset, input.file, progress);
    if (!rgba) return tl::unexpected(rgba.error());
    if (input.nodata) void_pixels_of(*input.nodata, *rgba);
    facts.spacing_deg = spacing_at_middle_deg(*mapping, facts.columns, facts.rows);
    return ColourGrid{facts.columns,       facts.rows,        std::move(*rgba),
                      std::move(*mapping), facts.spacing_deg, std::move(facts)};
}

}  // namespace eyepoint::tools
