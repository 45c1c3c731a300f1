// Single elevation files: decoding, georeference, voids, refusals.
#include <cmath>
#include <fstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <ogr_spatialref.h>

#include "tests/tools/terrain_ingest/raster_files.hpp"
#include "tools/terrain/gdal_elevation.hpp"
#include "tools/terrain/gdal_inputs.hpp"

namespace eyepoint::tools {
namespace {

using ::testing::HasSubstr;
using testing::Pixel;
using testing::RasterFile;
using testing::TemporaryFolder;

ElevationInput plain(const std::string& file) {
    ElevationInput input;
    input.file = file;
    return input;
}

RasterFile degree_grid(Pixel pixel) {
    return {.columns = 5,
            .rows = 4,
            .bands = 1,
            .pixel = pixel,
            .geotransform = testing::posts_from(8.0, 47.0, 0.25),
            .epsg = 4326,
            .nodata = std::nullopt,
            .driver = "GTiff"};
}

double slope(int, int column, int row) { return 100.0 + 10.0 * column + row; }

TEST(ElevationFile, PixelCentresAreThePosts) {
    const TemporaryFolder folder;
    testing::write_raster(folder.path("a.tif"), degree_grid(Pixel::Int16), slope);
    const auto grid = read_elevation(plain(folder.path("a.tif")));
    ASSERT_TRUE(grid) << grid.error();
    EXPECT_EQ(grid->heights_m[grid->index(3, 2)], 132.0F);
    const GridPosition post = grid->mapping.to_grid(LatLon{46.5, 8.75});
    EXPECT_EQ(post.column, 3.0);
    EXPECT_EQ(post.row, 2.0);
    EXPECT_NEAR(grid->spacing_deg, 0.25, 1e-12);
}

TEST(ElevationFile, ReadsSrtmHgtInsideAZip) {
    // An SRTM tile is 1201 x 1201 big-endian int16 from the north-west; named after its south-west corner.
    const TemporaryFolder folder;
    const std::string hgt = folder.path("S01E179.hgt");
    std::ofstream out{hgt, std::ios::binary};
    for (int row = 0; row < 1201; ++row) {
        for (int column = 0; column < 1201; ++column) {
            const int height = column == 1200 && row == 0 ? 0x0102 : 7;
            out.put(static_cast<char>(height >> 8)).put(static_cast<char>(height & 0xff));
        }
    }
    out.close();
    ASSERT_EQ(std::system(("cd " + folder.path("") + " && python3 -m zipfile -c t.zip S01E179.hgt").c_str()),
              0);
    const auto grid = read_elevation(plain(folder.path("t.zip")));
    ASSERT_TRUE(grid) << grid.error();
    EXPECT_EQ(grid->heights_m[1200], 258.0F);
    const LatLon corner = grid->mapping.to_place({1200, 0});
    EXPECT_NEAR(corner.latitude_deg, 0.0, 1e-9);
    EXPECT_NEAR(corner.longitude_deg, 180.0, 1e-9);
}

TEST(ElevationFile, UtmPostsLieWhereGdalsTransformPutsThem) {
    const TemporaryFolder folder;
    RasterFile file = degree_grid(Pixel::Float32);
    file.columns = 40;
    file.rows = 30;
    file.geotransform = {677920.0, 30.0, 0.0, 5152760.0, 0.0, -30.0};
    file.epsg = 32632;
    testing::write_raster(folder.path("utm.tif"), file, slope);
    const auto grid = read_elevation(plain(folder.path("utm.tif")));
    ASSERT_TRUE(grid) << grid.error();
    OGRSpatialReference utm;
    OGRSpatialReference wgs84;
    utm.importFromEPSG(32632);
    wgs84.importFromEPSG(4326);
    utm.SetAxisMappingStrategy(OAMS_TRADITIONAL_GIS_ORDER);
    wgs84.SetAxisMappingStrategy(OAMS_TRADITIONAL_GIS_ORDER);
    const std::unique_ptr<OGRCoordinateTransformation> transform{
        OGRCreateCoordinateTransformation(&utm, &wgs84)};
    double x = 677920.0 + 30.0 * 17.5;
    double y = 5152760.0 - 30.0 * 11.5;
    ASSERT_TRUE(transform->Transform(1, &x, &y));
    const GridPosition post = grid->mapping.to_grid(LatLon{y, x});
    EXPECT_EQ(post.column, 17.0);
    EXPECT_EQ(post.row, 11.0);
    EXPECT_NEAR(grid->spacing_deg, 30.0 / 111'150.0, 1e-6);
}

TEST(ElevationFile, TerrainRgbDecodesByMapboxFormula) {
    const TemporaryFolder folder;
    RasterFile file = degree_grid(Pixel::Byte);
    file.bands = 3;
    file.geotransform.reset();
    file.epsg = 0;
    file.driver = "PNG";
    // 1, 134, 160: -10000 + (65536 + 34304 + 160) * 0.1 = 0 m.
    testing::write_raster(folder.path("rgb.png"), file, [](int band, int column, int) {
        return band == 0 ? 1.0 : band == 1 ? 134.0 : 160.0 + column;
    });
    ElevationInput input = plain(folder.path("rgb.png"));
    input.encoding = HeightEncoding::TerrainRgb;
    input.placement = MercatorTile{1, 1, 0};
    const auto grid = read_elevation(input);
    ASSERT_TRUE(grid) << grid.error();
    EXPECT_NEAR(grid->heights_m[0], 0.0F, 1e-3);
    EXPECT_NEAR(grid->heights_m[4], 0.4F, 1e-3);
    // Tile 1/1/0 is the north-east quarter: from 0 E to 180 E, from the equator to 85.0511 N.
    EXPECT_NEAR(grid->mapping.to_place({-0.5, -0.5}).latitude_deg, 85.0511287798, 1e-8);
    EXPECT_NEAR(grid->mapping.to_place({-0.5, 3.5}).latitude_deg, 0.0, 1e-8);
    EXPECT_NEAR(grid->mapping.to_place({4.5, 3.5}).longitude_deg, 180.0, 1e-8);
}

TEST(ElevationFile, NodataNanAndUntaggedFillAreVoids) {
    const TemporaryFolder folder;
    RasterFile tagged = degree_grid(Pixel::Int16);
    tagged.nodata = -32767.0;
    testing::write_raster(folder.path("tagged.tif"), tagged,
                          [](int, int column, int row) { return column == row ? -32767.0 : 5.0; });
    const auto from_tag = read_elevation(plain(folder.path("tagged.tif")));
    ASSERT_TRUE(from_tag) << from_tag.error();
    EXPECT_EQ(from_tag->files.front().voids, 4U);
    EXPECT_TRUE(from_tag->files.front().notes.empty());

    testing::write_raster(folder.path("nan.tif"), degree_grid(Pixel::Float32),
                          [](int, int column, int) { return column == 0 ? std::nan("") : 5.0; });
    EXPECT_EQ(read_elevation(plain(folder.path("nan.tif")))->files.front().voids, 4U);

    testing::write_raster(folder.path("untagged.tif"), degree_grid(Pixel::Int16),
                          [](int, int column, int) { return column == 1 ? -32768.0 : 5.0; });
    const auto guessed = read_elevation(plain(folder.path("untagged.tif")));
    ASSERT_TRUE(guessed) << guessed.error();
    EXPECT_EQ(guessed->files.front().voids, 4U);
    ASSERT_EQ(guessed->files.front().notes.size(), 1U);
    EXPECT_THAT(guessed->files.front().notes.front(), HasSubstr("usual fill value"));

    ElevationInput override = plain(folder.path("tagged.tif"));
    override.nodata = 5.0;
    EXPECT_FALSE(read_elevation(override)) << "only the fill -32767 is left, which is no height";
}

TEST(ElevationFile, RefusesWhatIsNoElevationAndSaysWhatToDo) {
    const TemporaryFolder folder;
    const auto refusal = [](const ElevationInput& input) {
        const auto grid = read_elevation(input);
        return grid ? std::string{"accepted"} : grid.error();
    };
    EXPECT_THAT(refusal(plain(folder.path("absent.tif"))), HasSubstr("cannot be read as a raster"));

    RasterFile nowhere = degree_grid(Pixel::Float32);
    nowhere.geotransform.reset();
    nowhere.epsg = 0;
    testing::write_raster(folder.path("nowhere.tif"), nowhere, slope);
    EXPECT_THAT(refusal(plain(folder.path("nowhere.tif"))),
                HasSubstr("has no georeference; give its edges with --extent"));

    RasterFile colour = degree_grid(Pixel::Byte);
    colour.bands = 3;
    testing::write_raster(folder.path("colour.tif"), colour, slope);
    EXPECT_THAT(refusal(plain(folder.path("colour.tif"))), HasSubstr("colour picture"));

    RasterFile many = degree_grid(Pixel::Float32);
    many.bands = 3;
    testing::write_raster(folder.path("many.tif"), many, slope);
    EXPECT_THAT(refusal(plain(folder.path("many.tif"))), HasSubstr("has 3 bands"));
    ElevationInput second = plain(folder.path("many.tif"));
    second.band = 2;
    EXPECT_EQ(refusal(second), "accepted");

    testing::write_raster(folder.path("counts.tif"), degree_grid(Pixel::Float32),
                          [](int, int, int) { return 60'000.0; });
    EXPECT_THAT(refusal(plain(folder.path("counts.tif"))), HasSubstr("no heights in metres on Earth"));

    std::ofstream{folder.path("text.tif")} << "no raster";
    EXPECT_THAT(refusal(plain(folder.path("text.tif"))), HasSubstr("cannot be read as a raster"));
}

TEST(ElevationFile, ATruncatedFileIsRefused) {
    const TemporaryFolder folder;
    RasterFile file = degree_grid(Pixel::Float32);
    file.columns = file.rows = 300;
    testing::write_raster(folder.path("whole.tif"), file, slope);
    std::filesystem::resize_file(folder.path("whole.tif"),
                                 std::filesystem::file_size(folder.path("whole.tif")) / 2);
    const auto grid = read_elevation(plain(folder.path("whole.tif")));
    ASSERT_FALSE(grid);
    EXPECT_EQ(grid.error().find('\n'), std::string::npos);
}

TEST(ElevationInputs, SettingsFollowTheFileName) {
    const TemporaryFolder folder;
    const std::string file = folder.path("a@b.tif");
    testing::write_raster(file, degree_grid(Pixel::Float32), slope);
    const auto inputs = elevation_inputs({file + "@vertical=ellipsoid@nodata=-5"}, {});
    ASSERT_TRUE(inputs) << inputs.error();
    EXPECT_EQ(inputs->front().file, file);
    EXPECT_EQ(inputs->front().datum, VerticalDatum::Ellipsoid);
    EXPECT_EQ(inputs->front().nodata, -5.0);
    EXPECT_THAT(elevation_inputs({file + "@vertical=moon"}, {}).error(), HasSubstr("egm96 and ellipsoid"));
}

TEST(ElevationInputs, APlacementGoesToTheOneFileWithoutGeoreference) {
    const TemporaryFolder folder;
    testing::write_raster(folder.path("placed.tif"), degree_grid(Pixel::Float32), slope);
    RasterFile nowhere = degree_grid(Pixel::Float32);
    nowhere.geotransform.reset();
    nowhere.epsg = 0;
    testing::write_raster(folder.path("nowhere.tif"), nowhere, slope);
    ElevationDefaults defaults;
    defaults.placement = terrain::GeographicExtent{10, 20, 11, 21};
    const auto inputs = elevation_inputs({folder.path("placed.tif"), folder.path("nowhere.tif")}, defaults);
    ASSERT_TRUE(inputs) << inputs.error();
    EXPECT_EQ((*inputs)[0].placement.index(), 0U);
    EXPECT_EQ((*inputs)[1].placement.index(), 1U);
    EXPECT_THAT(elevation_inputs({folder.path("nowhere.tif"), folder.path("nowhere.tif")}, defaults).error(),
                HasSubstr("both have no georeference"));
    EXPECT_THAT(elevation_inputs({folder.path("placed.tif")}, defaults).error(),
                HasSubstr("nothing to place"));
}

}  // namespace
}  // namespace eyepoint::tools
