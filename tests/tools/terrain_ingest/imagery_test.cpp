// Pictures: reading, averaging, blending.
#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/tools/terrain_ingest/raster_files.hpp"
#include "tools/terrain/gdal_imagery.hpp"
#include "tools/terrain/imagery_mosaic.hpp"

namespace eyepoint::tools {
namespace {

using ::testing::HasSubstr;
using testing::Pixel;
using testing::RasterFile;
using testing::TemporaryFolder;

RasterFile picture(int columns, int rows, int bands) {
    return {.columns = columns,
            .rows = rows,
            .bands = bands,
            .pixel = Pixel::Byte,
            .geotransform = std::nullopt,
            .epsg = 0,
            .nodata = std::nullopt,
            .driver = "GTiff"};
}

std::array<int, 3> colour_at(const ImageMosaic& mosaic, double latitude_deg, double longitude_deg,
                             double step_deg) {
    std::array<std::uint8_t, 3> rgb{};
    mosaic.sample({latitude_deg, longitude_deg, step_deg, 1, 1}, rgb);
    return {rgb[0], rgb[1], rgb[2]};
}

ColourGrid flat(int columns, int rows, const terrain::GeographicExtent& extent,
                std::array<std::uint8_t, 3> rgb) {
    const double spacing = (extent.north_deg - extent.south_deg) / rows;
    ColourGrid grid{columns, rows, {}, GridMapping::spread(extent, columns, rows), spacing, {}};
    for (int i = 0; i < columns * rows; ++i) {
        grid.rgba.insert(grid.rgba.end(), rgb.begin(), rgb.end());
        grid.rgba.push_back(255);
    }
    return grid;
}

TEST(Imagery, APlainTwoToOnePictureIsThePlanet) {
    const TemporaryFolder folder;
    testing::write_raster(
        folder.path("world.png"),
        [] {
            RasterFile file = picture(64, 32, 3);
            file.driver = "PNG";
            return file;
        }(),
        [](int band, int column, int row) { return band == 0   ? column
                                                   : band == 1 ? row
                                                               : 7.0; });
    auto grid = read_imagery({folder.path("world.png"), std::nullopt, std::nullopt});
    ASSERT_TRUE(grid) << grid.error();
    EXPECT_THAT(grid->facts.notes.front(), HasSubstr("whole planet"));
    std::vector<ColourGrid> grids;
    grids.push_back(std::move(*grid));
    const ImageMosaic mosaic{std::move(grids)};
    EXPECT_TRUE(mosaic.is_global());
    // Pixel (40, 10) has its centre at 180 * (10.5 / 32) south of the north pole, 360 * (40.5 / 64) east of
    // 180 W.
    EXPECT_EQ(colour_at(mosaic, 90.0 - 180.0 * 10.5 / 32.0, -180.0 + 360.0 * 40.5 / 64.0, 1.0),
              (std::array{40, 10, 7}));
}

TEST(Imagery, OtherPicturesWithoutGeoreferenceAreRefused) {
    const TemporaryFolder folder;
    testing::write_raster(folder.path("photo.tif"), picture(30, 20, 3), [](int, int, int) { return 9.0; });
    const auto grid = read_imagery({folder.path("photo.tif"), std::nullopt, std::nullopt});
    ASSERT_FALSE(grid);
    EXPECT_THAT(grid.error(), HasSubstr("has no georeference"));
    EXPECT_TRUE(
        read_imagery({folder.path("photo.tif"), terrain::GeographicExtent{8, 46, 9, 47}, std::nullopt}));
    RasterFile heights = picture(30, 20, 1);
    heights.pixel = Pixel::Float32;
    testing::write_raster(folder.path("heights.tif"), heights, [](int, int, int) { return 9.0; });
    EXPECT_THAT(read_imagery({folder.path("heights.tif"), std::nullopt, std::nullopt}).error(),
                HasSubstr("no 8-bit picture"));
}

TEST(Imagery, NodataPixelsAreTransparent) {
    const TemporaryFolder folder;
    RasterFile file = picture(8, 4, 3);
    file.nodata = 0.0;
    testing::write_raster(folder.path("a.tif"), file, [](int band, int column, int) {
        return column < 4 ? 0.0 : band == 1 ? 0.0 : 200.0;
    });
    const auto grid = read_imagery({folder.path("a.tif"), std::nullopt, std::nullopt});
    ASSERT_TRUE(grid) << grid.error();
    EXPECT_EQ(grid->rgba[3], 0);
    EXPECT_EQ(grid->rgba[4 * 4 + 3], 255) << "one band at the nodata value does not void a pixel";
}

TEST(Imagery, AFillThatTheFileDoesNotNameCanBeNamed) {
    const TemporaryFolder folder;
    testing::write_raster(folder.path("a.tif"), picture(8, 4, 3), [](int band, int column, int) {
        return column < 4 ? 0.0 : band == 1 ? 0.0 : 200.0;
    });
    const auto grid = read_imagery({folder.path("a.tif"), std::nullopt, 0});
    ASSERT_TRUE(grid) << grid.error();
    EXPECT_EQ(grid->rgba[3], 0);
    EXPECT_EQ(grid->rgba[4 * 4 + 3], 255);
}

TEST(Imagery, CoarseTexelsAreAreaAverages) {
    // A chequerboard of 0 and 200: points would give either, areas give 100.
    ColourGrid board = flat(256, 128, {-180, -90, 180, 90}, {0, 0, 0});
    for (int row = 0; row < 128; ++row) {
        for (int column = 0; column < 256; ++column) {
            if ((row + column) % 2 == 0) board.rgba[static_cast<std::size_t>(row * 256 + column) * 4] = 200;
        }
    }
    std::vector<ColourGrid> grids;
    grids.push_back(std::move(board));
    const ImageMosaic mosaic{std::move(grids)};
    for (const double longitude : {-180.0, -91.3, 10.0, 179.9}) {
        EXPECT_NEAR(colour_at(mosaic, 12.0, longitude, 8.0 * 180.0 / 128.0)[0], 100, 2) << longitude;
    }
}

TEST(Imagery, FinerLiesOverCoarserAndFadesIntoIt) {
    std::vector<ColourGrid> grids;
    grids.push_back(flat(360, 180, {-180, -90, 180, 90}, {10, 10, 10}));
    grids.push_back(flat(200, 200, {8, 46, 9, 47}, {210, 210, 210}));
    const ImageMosaic mosaic{std::move(grids)};
    EXPECT_EQ(colour_at(mosaic, 46.5, 8.5, 0.001)[0], 210);
    EXPECT_EQ(colour_at(mosaic, 46.5, 7.5, 0.001)[0], 10);
    int before = 10;
    for (double longitude = 7.99; longitude < 8.06; longitude += 0.001) {
        const int here = colour_at(mosaic, 46.5, longitude, 0.001)[0];
        EXPECT_GE(here, before - 1);
        EXPECT_LT(here - before, 16) << longitude;
        before = here;
    }
    EXPECT_EQ(before, 210);
}

TEST(Imagery, TheAntimeridianAndThePolesHaveNoSeam) {
    ColourGrid world = flat(64, 32, {-180, -90, 180, 90}, {0, 90, 0});
    for (int row = 0; row < 32; ++row) {
        for (int column = 0; column < 64; ++column) {
            const double turn = 2.0 * 3.14159265 * (column + 0.5) / 64.0;
            world.rgba[static_cast<std::size_t>(row * 64 + column) * 4] =
                static_cast<std::uint8_t>(128.0 + 100.0 * std::sin(turn));
        }
    }
    std::vector<ColourGrid> grids;
    grids.push_back(std::move(world));
    const ImageMosaic mosaic{std::move(grids)};
    EXPECT_EQ(colour_at(mosaic, 20.0, 180.0, 0.1), colour_at(mosaic, 20.0, -180.0, 0.1));
    EXPECT_NEAR(colour_at(mosaic, 20.0, 179.99, 0.1)[0], colour_at(mosaic, 20.0, -179.99, 0.1)[0], 2);
    EXPECT_EQ(colour_at(mosaic, 90.0, 50.0, 0.1), colour_at(mosaic, 90.0, -120.0, 0.1));
}

TEST(Imagery, IsAsDeepAsItsPixelsAreFine) {
    std::vector<ColourGrid> grids;
    grids.push_back(flat(720, 360, {-180, -90, 180, 90}, {1, 2, 3}));
    grids.push_back(flat(100, 100, {8, 46, 9, 47}, {4, 5, 6}));
    const ImageMosaic mosaic{std::move(grids)};
    // Texels are 180 / 2^d / 127 degrees apart: 0.71 at depth 1, 0.35 at 2; pixels of 0.5 degrees end at
    // depth 2.
    EXPECT_TRUE(mosaic.has_detail(terrain::tile_at(0.1, 0.1, 2)));
    EXPECT_FALSE(mosaic.has_detail(terrain::tile_at(0.1, 0.1, 3)));
    // 0.0138 at depth 6 is just finer than 1.3 * 0.01 needs: the picture's tiles reach depth 7.
    EXPECT_TRUE(mosaic.has_detail(terrain::tile_at(46.5, 8.5, 7)));
    EXPECT_FALSE(mosaic.has_detail(terrain::tile_at(46.5, 8.5, 8)));
}

}  // namespace
}  // namespace eyepoint::tools
