#include "tools/terrain/preview_command.hpp"

#include <memory>
#include <string>
#include <vector>

#include <OpenImageIO/imageio.h>
#include <fmt/format.h>

#include "tools/terrain/command_failure.hpp"
#include "tools/terrain/preview.hpp"

namespace eyepoint::tools {

namespace {

struct PreviewOptions {
    std::string database;
    std::string output;
    std::vector<double> extent;
    int size_px = 1024;
};

void write_picture(const std::string& path, const ReliefPicture& picture) {
    const auto file = OIIO::ImageOutput::create(path);
    const OIIO::ImageSpec spec{picture.width, picture.height, 3, OIIO::TypeDesc::UINT8};
    if (!file || !file->open(path, spec) || !file->write_image(OIIO::TypeDesc::UINT8, picture.rgb.data()) ||
        !file->close()) {
        fail("preview", fmt::format("{}: the picture cannot be written ({})", path,
                                    file ? file->geterror() : OIIO::geterror()));
    }
}

terrain::GeographicExtent wanted_extent(const PreviewOptions& options, const terrain::Database& database) {
    if (options.extent.empty()) return database.manifest().detail_extent;
    const terrain::GeographicExtent extent{options.extent[0], options.extent[1], options.extent[2],
                                           options.extent[3]};
    if (extent.west_deg < -180.0 || extent.east_deg > 180.0 || !(extent.west_deg < extent.east_deg) ||
        extent.south_deg < -90.0 || extent.north_deg > 90.0 || !(extent.south_deg < extent.north_deg)) {
        fail("preview",
             "--extent wants W,S,E,N in degrees, west before east and south before north, such as "
             "7.9,46.2,8.6,46.7");
    }
    return extent;
}

}  // namespace

void add_preview_command(CLI::App& application) {
    auto options = std::make_shared<PreviewOptions>();
    auto* command = application.add_subcommand(
        "preview",
        "Writes a shaded relief picture. Example: preview DB -o relief.png --extent 7.9,46.2,8.6,46.7");
    command->add_option("database", options->database, "Folder of the database")->required();
    command->add_option("-o,--output", options->output, "PNG file to write")->required();
    command->add_option("--extent", options->extent, "W,S,E,N in degrees (the ground in full detail)")
        ->delimiter(',')
        ->expected(4);
    command->add_option("--size", options->size_px, "Pixels along the longer side")
        ->capture_default_str()
        ->check(CLI::Range(16, 8192));
    command->callback([options] {
        const auto database = terrain::Database::open(options->database);
        if (!database) fail("preview", database.error());
        const auto picture = draw_relief(*database, wanted_extent(*options, *database), options->size_px);
        if (!picture) fail("preview", picture.error());
        write_picture(options->output, *picture);
    });
}

}  // namespace eyepoint::tools
