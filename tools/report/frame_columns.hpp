/// A frame record read back (format: docs/frame-record.md): its header, and one column of numbers a key.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include <tl/expected.hpp>

namespace eyepoint::tools {

/// Keys and their values as text, in the order of the file.
using RecordHeader = std::vector<std::pair<std::string, std::string>>;

struct FrameColumns {
    RecordHeader header;  ///< the first line; empty where the record has none
    std::size_t frames = 0;
    /// By key, `frames` long; NaN where a frame does not say. Only numbers are kept, and one column is made:
    /// transport_delay_ms is arrival_to_complete_ms of the frames that drew a packet first (new_packet).
    std::map<std::string, std::vector<double>> columns;
    bool cut_off =
        false;  ///< the last line ends in its middle: the run did not end cleanly; that line is left out

    /// nullptr where no frame has the key.
    [[nodiscard]] const std::vector<double>* find(const std::string& key) const;
};

/// Reads a whole record. On failure (unreadable, no frame, a line that is not a frame): one sentence with
/// file and line.
[[nodiscard]] tl::expected<FrameColumns, std::string> read_frame_columns(const std::filesystem::path& file);

}  // namespace eyepoint::tools
