/// The rasters below a folder.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace eyepoint::tools {

enum class FolderContent { Elevation, Imagery };

/// Files with a raster's ending, sorted by path. In a CDB (OGC 15-113r6, dataset folders 001_Elevation and
/// 004_Imagery) only those of the dataset asked for, and of the coarse levels LC10..LC01 only the finest, or
/// none where a geocell has level L00.
[[nodiscard]] std::vector<std::string> rasters_below(const std::filesystem::path& folder,
                                                     FolderContent content);

}  // namespace eyepoint::tools
