#include "tools/terrain/info_command.hpp"

#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <map>
#include <memory>
#include <string>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "terrain/database/database.hpp"
#include "tools/terrain/command_failure.hpp"

namespace eyepoint::tools {

namespace {

using terrain::Database;

struct Account {
    std::map<std::uint32_t, std::uint64_t> tiles_at_depth;
    std::uint64_t bytes = 0;
    std::uint64_t files = 0;
    double bits_per_post = 0.0;
    std::uint64_t mesh_bytes = 0;
    double mesh_bits_per_post = 0.0;
    float height_min_m = 0.0F;
    float height_max_m = 0.0F;
};

Account account_of(const Database& database) {
    Account account;
    const auto tiles = database.tiles();
    for (const auto tile : tiles) ++account.tiles_at_depth[tile.depth];
    for (const auto& entry : std::filesystem::recursive_directory_iterator{database.folder()}) {
        if (!entry.is_regular_file()) continue;
        ++account.files;
        account.bytes += entry.file_size();
    }
    const double posts =
        double{terrain::kBlockPosts} * terrain::kBlockPosts * static_cast<double>(tiles.size());
    account.bits_per_post = 8.0 * static_cast<double>(account.bytes) / posts;
    account.mesh_bytes = database.stored_bytes().meshes;
    account.mesh_bits_per_post = 8.0 * static_cast<double>(account.mesh_bytes) / posts;
    const auto* west = database.find({0, 0, 0});
    const auto* east = database.find({0, 1, 0});
    account.height_min_m = std::min(west->height_min_m, east->height_min_m);
    account.height_max_m = std::max(west->height_max_m, east->height_max_m);
    return account;
}

void print_text(const Database& database, const Account& account) {
    const auto& manifest = database.manifest();
    const auto& detail = manifest.detail_extent;
    fmt::print("{}\n  made by       {}\n  format        {}\n", manifest.name, manifest.created_by,
               terrain::Manifest::kFormatVersion);
    fmt::print("  detail        {:.4f} {:.4f} to {:.4f} {:.4f} (west south east north, degrees)\n",
               detail.west_deg, detail.south_deg, detail.east_deg, detail.north_deg);
    fmt::print("  post spacing  {:.1f} m north to south at depth {}\n",
               terrain::post_spacing_deg(manifest.max_depth) * 111'319.49, manifest.max_depth);
    fmt::print("  heights       {:.1f} to {:.1f} m above the WGS84 ellipsoid, in steps of {} m\n",
               account.height_min_m, account.height_max_m, manifest.height_step_m);
    fmt::print("  tiles         {}, {} with an image\n", manifest.tiles, manifest.image_tiles);
    for (const auto& [depth, tiles] : account.tiles_at_depth)
        fmt::print("    depth {:2}    {}\n", depth, tiles);
    fmt::print("  on disk       {:.1f} MB in {} files, {:.2f} bits a post, all included\n",
               static_cast<double>(account.bytes) / 1e6, account.files, account.bits_per_post);
    fmt::print("  meshes        {:.1f} MB, {:.2f} bits a post\n",
               static_cast<double>(account.mesh_bytes) / 1e6, account.mesh_bits_per_post);
    fmt::print("  voids filled  {}\n  sources\n", manifest.voids_filled);
    for (const auto& source : manifest.sources) {
        fmt::print("    {}: {}{}{}, spacing {:.8g} degrees, {} voids\n", source.file, source.kind,
                   source.vertical_datum.empty() ? "" : ", heights on ", source.vertical_datum,
                   source.spacing_deg, source.voids);
    }
}

void print_json(const Database& database, const Account& account) {
    using nlohmann::ordered_json;
    const auto& manifest = database.manifest();
    const auto& detail = manifest.detail_extent;
    ordered_json depths = ordered_json::object();
    for (const auto& [depth, tiles] : account.tiles_at_depth) depths[std::to_string(depth)] = tiles;
    ordered_json sources = ordered_json::array();
    for (const auto& source : manifest.sources) {
        sources.push_back({{"file", source.file},
                           {"kind", source.kind},
                           {"vertical_datum", source.vertical_datum},
                           {"spacing_deg", source.spacing_deg},
                           {"voids", source.voids}});
    }
    const ordered_json json = {
        {"name", manifest.name},
        {"created_by", manifest.created_by},
        {"format_version", terrain::Manifest::kFormatVersion},
        {"detail_extent_deg", {detail.west_deg, detail.south_deg, detail.east_deg, detail.north_deg}},
        {"height_step_m", manifest.height_step_m},
        {"height_min_m", account.height_min_m},
        {"height_max_m", account.height_max_m},
        {"max_depth", manifest.max_depth},
        {"tiles", manifest.tiles},
        {"image_tiles", manifest.image_tiles},
        {"tiles_at_depth", depths},
        {"bytes", account.bytes},
        {"files", account.files},
        {"bits_per_post", account.bits_per_post},
        {"mesh_bytes", account.mesh_bytes},
        {"mesh_bits_per_post", account.mesh_bits_per_post},
        {"voids_filled", manifest.voids_filled},
        {"sources", sources}};
    fmt::print("{}\n", json.dump(4, ' ', false, ordered_json::error_handler_t::replace));
}

}  // namespace

void add_info_command(CLI::App& application) {
    struct Options {
        std::string database;
        bool json = false;
    };
    auto options = std::make_shared<Options>();
    auto* command = application.add_subcommand("info", "Says what a terrain database holds");
    command->add_option("database", options->database, "Folder of the database")->required();
    command->add_flag("--json", options->json, "As JSON, for programs");
    command->callback([options] {
        const auto database = Database::open(options->database);
        if (!database) fail("info", database.error());
        const Account account = account_of(*database);
        if (options->json) {
            print_json(*database, account);
        } else {
            print_text(*database, account);
        }
    });
}

}  // namespace eyepoint::tools
