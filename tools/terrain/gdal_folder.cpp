#include "tools/terrain/gdal_folder.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <map>
#include <string_view>

namespace eyepoint::tools {

namespace {

namespace fs = std::filesystem;

bool has_raster_ending(const fs::path& file, FolderContent content) {
    static constexpr std::array<std::string_view, 10> kHeights{".tif", ".tiff", ".hgt", ".zip", ".dt0",
                                                               ".dt1", ".dt2",  ".img", ".bil", ".asc"};
    static constexpr std::array<std::string_view, 4> kPictures{".tif", ".tiff", ".jp2", ".img"};
    std::string ending = file.extension().string();
    std::transform(ending.begin(), ending.end(), ending.begin(),
                   [](unsigned char c) { return std::tolower(c); });
    const auto is = [&](std::string_view known) { return known == ending; };
    return content == FolderContent::Elevation ? std::any_of(kHeights.begin(), kHeights.end(), is)
                                               : std::any_of(kPictures.begin(), kPictures.end(), is);
}

/// The CDB dataset folder that holds a file, such as .../N32/W118/001_Elevation; empty outside of a CDB.
fs::path dataset_folder(const fs::path& file, std::string_view dataset) {
    for (fs::path folder = file.parent_path(); folder.has_relative_path(); folder = folder.parent_path()) {
        if (folder.filename() == dataset) return folder;
    }
    return {};
}

bool is_coarse_level(const fs::path& file, const fs::path& dataset) {
    const fs::path below = file.lexically_relative(dataset);
    return !below.empty() && *below.begin() == "LC";
}

/// The number n of _LCnn_ in a CDB tile's name: the larger, the coarser.
std::string coarse_level(const fs::path& file) {
    const std::string name = file.filename().string();
    const std::size_t at = name.find("_LC");
    return at == std::string::npos ? "" : name.substr(at + 3, 2);
}

std::vector<fs::path> finest_of_cdb(const std::vector<fs::path>& files, std::string_view dataset) {
    std::map<fs::path, std::vector<fs::path>> by_folder;
    for (const fs::path& file : files) {
        const fs::path folder = dataset_folder(file, dataset);
        if (!folder.empty()) by_folder[folder].push_back(file);
    }
    std::vector<fs::path> kept;
    for (const auto& [folder, tiles] : by_folder) {
        const auto is_coarse = [&](const fs::path& tile) { return is_coarse_level(tile, folder); };
        if (std::all_of(tiles.begin(), tiles.end(), is_coarse)) {
            kept.push_back(*std::min_element(tiles.begin(), tiles.end(), [](const auto& a, const auto& b) {
                return coarse_level(a) < coarse_level(b);
            }));
        } else {
            std::remove_copy_if(tiles.begin(), tiles.end(), std::back_inserter(kept), is_coarse);
        }
    }
    return kept;
}

}  // namespace

std::vector<std::string> rasters_below(const fs::path& folder, FolderContent content) {
    std::vector<fs::path> files;
    std::error_code failure;
    for (auto at = fs::recursive_directory_iterator{folder, failure};
         at != fs::recursive_directory_iterator{}; at.increment(failure)) {
        if (failure) break;
        if (at->is_regular_file(failure) && has_raster_ending(at->path(), content))
            files.push_back(at->path());
    }
    const auto in_cdb = [](const fs::path& file) {
        return !dataset_folder(file, "001_Elevation").empty() || !dataset_folder(file, "004_Imagery").empty();
    };
    if (std::any_of(files.begin(), files.end(), in_cdb)) {
        files = finest_of_cdb(files, content == FolderContent::Elevation ? "001_Elevation" : "004_Imagery");
    }
    std::sort(files.begin(), files.end());
    std::vector<std::string> names;
    std::transform(files.begin(), files.end(), std::back_inserter(names),
                   [](const auto& file) { return file.string(); });
    return names;
}

}  // namespace eyepoint::tools
