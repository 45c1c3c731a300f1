/// The report page: one HTML file that opens offline and asks nothing of any server.
#pragma once

#include <filesystem>
#include <span>
#include <string>

#include <tl/expected.hpp>

#include "tools/report/frame_columns.hpp"
#include "tools/report/pictures.hpp"

namespace eyepoint::tools {

/// The page of a run: what it ran on, percentiles, plots over time, and pictures where given. figures: what
/// else the run came to, named, for the head of the page. On failure (a picture that cannot be compressed):
/// one sentence.
[[nodiscard]] tl::expected<std::string, std::string> report_page(const std::string& title,
                                                                 const FrameColumns& record,
                                                                 std::span<const SmallPicture> pictures,
                                                                 const RecordHeader& figures = {});

/// Writes text beside its place and renames it when whole. On failure: one sentence.
[[nodiscard]] tl::expected<void, std::string> write_whole(const std::filesystem::path& file,
                                                          const std::string& text);

}  // namespace eyepoint::tools
