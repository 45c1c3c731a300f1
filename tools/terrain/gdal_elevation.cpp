#include "tools/terrain/gdal_elevation.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include <fmt/format.h>
#include <gdal_priv.h>
#include <ogr_spatialref.h>

#include "tools/terrain/gdal_georeference.hpp"

namespace eyepoint::tools {

namespace {

/// No height on Earth lies outside (Challenger Deep -10,935 m, Everest 8,849 m), with room for datums and
/// noise.
constexpr float kLowestM = -12000.0F;
constexpr float kHighestM = 9500.0F;
constexpr double kFootM = 0.3048;
constexpr double kUsSurveyFootM = 1200.0 / 3937.0;

bool is_colour(GDALRasterBand& band) {
    const GDALColorInterp meaning = band.GetColorInterpretation();
    return meaning == GCI_RedBand || meaning == GCI_PaletteIndex || band.GetRasterDataType() == GDT_Byte;
}

tl::expected<void, std::string> check_bands(GDALDataset& dataset, const ElevationInput& input) {
    const int bands = dataset.GetRasterCount();
    GDALRasterBand& first = *dataset.GetRasterBand(1);
    if (input.encoding == HeightEncoding::TerrainRgb) {
        if (bands >= 3 && first.GetRasterDataType() == GDT_Byte) return {};
        return tl::unexpected(gdal_refusal(input.file,
                                           "is not terrain-RGB, which has three 8-bit bands; leave out "
                                           "--encoding terrain-rgb for this file"));
    }
    if (input.band && (*input.band < 1 || *input.band > bands)) {
        return tl::unexpected(
            gdal_refusal(input.file, fmt::format("has no band {}, only {}", *input.band, bands)));
    }
    GDALRasterBand& chosen = *dataset.GetRasterBand(input.band.value_or(1));
    if (GDALDataTypeIsComplex(chosen.GetRasterDataType()) != FALSE) {
        return tl::unexpected(gdal_refusal(input.file, "holds complex numbers, not heights"));
    }
    if (input.band) return {};
    if (is_colour(first)) {
        return tl::unexpected(gdal_refusal(
            input.file, bands >= 3
                            ? "is a colour picture, not heights; read it with @encoding=terrain-rgb if its "
                              "colours encode heights, or name it on --imagery"
                            : "is an 8-bit picture, not heights; if its numbers are metres, say @band=1"));
    }
    if (bands > 1) {
        return tl::unexpected(gdal_refusal(
            input.file,
            fmt::format("has {} bands, and which one holds heights is unknown; say @band=N", bands)));
    }
    return {};
}

double metres_per_unit(GDALRasterBand& band) {
    const std::string unit = band.GetUnitType();
    if (unit == "ft" || unit == "foot" || unit == "feet") return kFootM;
    if (unit == "US survey foot" || unit == "us-ft" || unit == "ftUS") return kUsSurveyFootM;
    return 1.0;
}

bool read_rows(GDALRasterBand& band, int row, int count, std::span<float> out) {
    return band.RasterIO(GF_Read, 0, row, band.GetXSize(), count, out.data(), band.GetXSize(), count,
                         GDT_Float32, 0, 0, nullptr) == CE_None;
}

/// Values as the file has them, a strip of rows at a time.
tl::expected<std::vector<float>, std::string> read_values(GDALDataset& dataset, const ElevationInput& input,
                                                          const ReadProgress& progress) {
    constexpr int kStripRows = 256;
    const int columns = dataset.GetRasterXSize();
    const int rows = dataset.GetRasterYSize();
    const bool rgb = input.encoding == HeightEncoding::TerrainRgb;
    const GdalMessages messages;
    std::vector<float> values(static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows));
    std::array<std::vector<float>, 2> channels;
    for (int row = 0; row < rows; row += kStripRows) {
        const int count = std::min(kStripRows, rows - row);
        const std::size_t posts = static_cast<std::size_t>(columns) * static_cast<std::size_t>(count);
        const std::span strip{
            values.data() + static_cast<std::size_t>(columns) * static_cast<std::size_t>(row), posts};
        bool whole = read_rows(*dataset.GetRasterBand(rgb ? 1 : input.band.value_or(1)), row, count, strip);
        for (int channel = 0; rgb && whole && channel < 2; ++channel) {
            channels[static_cast<std::size_t>(channel)].resize(posts);
            whole = read_rows(*dataset.GetRasterBand(channel + 2), row, count,
                              channels[static_cast<std::size_t>(channel)]);
        }
        if (!whole) {
            return tl::unexpected(gdal_refusal(
                input.file,
                fmt::format("cannot be read whole, it fails near line {} ({})", row, messages.last())));
        }
        for (std::size_t i = 0; rgb && i < posts; ++i) {
            const double code = strip[i] * 65536.0 + channels[0][i] * 256.0 + channels[1][i];
            strip[i] = static_cast<float>(-10000.0 + code * 0.1);
        }
        if (progress && !progress(static_cast<double>(row + count) / rows)) {
            return tl::unexpected(gdal_refusal(input.file, "reading was stopped"));
        }
    }
    return values;
}

/// Values that stand for "no data" in files that do not say so.
bool is_usual_fill(float value) {
    return value == -32768.0F || value == -32767.0F || value == -9999.0F || value <= -1e30F || value >= 1e30F;
}

void mark_voids(GDALDataset& dataset, const ElevationInput& input, HeightGrid& grid) {
    FileFacts& facts = grid.files.front();
    GDALRasterBand& band = *dataset.GetRasterBand(input.band.value_or(1));
    int tagged = 0;
    const double tag = band.GetNoDataValue(&tagged);
    const bool rgb = input.encoding == HeightEncoding::TerrainRgb;
    const bool known = input.nodata || (tagged != 0 && !rgb);
    const auto fill = static_cast<float>(input.nodata.value_or(tag));
    std::uint64_t guessed = 0;
    for (float& height : grid.heights_m) {
        const bool by_value = known && height == fill;
        const bool by_habit = !known && !rgb && is_usual_fill(height);
        // All-zero pixels, -10,000 m, are what terrain-RGB tiles leave where there is nothing.
        const bool unpainted = rgb && height <= -10000.0F;
        if (by_value || by_habit || unpainted || !std::isfinite(height)) {
            guessed += by_habit ? 1 : 0;
            height = kVoid;
            ++facts.voids;
        }
    }
    if (guessed > 0) {
        facts.notes.push_back(
            fmt::format("{} posts hold a usual fill value (-32768, -32767, -9999) though the file "
                        "names none; taken as voids (--nodata V overrides)",
                        guessed));
    }
}

tl::expected<void, std::string> check_heights(const HeightGrid& grid) {
    const FileFacts& facts = grid.files.front();
    float lowest = std::numeric_limits<float>::max();
    float highest = std::numeric_limits<float>::lowest();
    for (const float height : grid.heights_m) {
        if (is_void(height)) continue;
        lowest = std::min(lowest, height);
        highest = std::max(highest, height);
    }
    if (lowest > highest)
        return tl::unexpected(gdal_refusal(facts.file, "holds no height at all, only voids"));
    if (lowest < kLowestM || highest > kHighestM) {
        return tl::unexpected(gdal_refusal(
            facts.file,
            fmt::format("holds values from {} to {}, which are no heights in metres on Earth; name its "
                        "fill value with --nodata, or its encoding with --encoding",
                        lowest, highest)));
    }
    return {};
}

void apply_scale(GDALRasterBand& band, std::vector<float>& values) {
    const double unit = metres_per_unit(band);
    const double scale = band.GetScale() * unit;
    const double offset = band.GetOffset() * unit;
    if (scale == 1.0 && offset == 0.0) return;
    for (float& value : values) value = static_cast<float>(value * scale + offset);
}

}  // namespace

tl::expected<Dataset, std::string> open_elevation(const ElevationInput& input) {
    auto dataset = open_raster(input.file);
    if (!dataset) return dataset;
    if (const auto fit = check_bands(**dataset, input); !fit) return tl::unexpected(fit.error());
    return dataset;
}

tl::expected<HeightGrid, std::string> read_elevation(const ElevationInput& input,
                                                     const ReadProgress& progress) {
    const auto dataset = open_elevation(input);
    if (!dataset) return tl::unexpected(dataset.error());
    auto mapping = georeference_of(**dataset, input);
    if (!mapping) return tl::unexpected(gdal_refusal(input.file, mapping.error()));
    const int columns = (*dataset)->GetRasterXSize();
    const int rows = (*dataset)->GetRasterYSize();
    if (static_cast<std::uint64_t>(columns) * static_cast<std::uint64_t>(rows) > kMaxPosts) {
        return tl::unexpected(gdal_refusal(
            input.file,
            fmt::format("{} x {} posts are more than the {} million that are read at once; cut it with "
                        "gdal_translate -projwin",
                        columns, rows, kMaxPosts / 1'000'000)));
    }
    auto values = read_values(**dataset, input, progress);
    if (!values) return tl::unexpected(values.error());
    const double spacing = spacing_at_middle_deg(*mapping, columns, rows);
    HeightGrid grid{.columns = columns,
                    .rows = rows,
                    .heights_m = std::move(*values),
                    .mapping = std::move(*mapping),
                    .spacing_deg = spacing,
                    .files = {{input.file, input.datum, columns, rows, spacing, 0, {}}},
                    .order = 0};
    mark_voids(**dataset, input, grid);
    if (input.encoding == HeightEncoding::Metres) {
        apply_scale(*(*dataset)->GetRasterBand(input.band.value_or(1)), grid.heights_m);
    }
    if (const auto fit = check_heights(grid); !fit) return tl::unexpected(fit.error());
    return grid;
}

}  // namespace eyepoint::tools
