/// The frame record: one JSON line a frame (format: docs/frame-record.md).
#pragma once

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <optional>
#include <string>
#include <string_view>

#include <tl/expected.hpp>

#include "ig/frame_statistics.hpp"
#include "ig/gl_identity.hpp"
#include "ig/picture.hpp"
#include "terrain/geodesy/position.hpp"

namespace eyepoint::ig {

/// What holds for the whole run; the record's first line.
struct RecordHeader {
    std::string version;
    GlIdentity gl;
    PictureSize size;
    double rate_hz = 0.0;
    std::string terrain_name;
    std::string lod_method;
};

/// One drawn frame.
struct FrameEntry {
    std::uint64_t frame = 0;           ///< drawn frames, counted from 1
    std::uint32_t host_frame = 0;      ///< of the packet that was drawn
    std::optional<double> sim_time_s;  ///< the host's own clock, where it sends one
    double time_s = 0.0;               ///< when the frame was to start, since the first
    double arrival_to_complete_ms =
        0.0;                           ///< from the kernel's receipt of the drawn packet to the whole picture
    double extrapolated_ms = 0.0;      ///< how far the vehicle was moved on from that packet
    bool new_packet = false;           ///< the first frame that draws this packet: its transport delay
    double cpu_ms = 0.0;               ///< CPU of all threads from the frame's start until it was whole
    double frame_thread_cpu_ms = 0.0;  ///< the same of the frame's thread alone
    std::optional<double> gpu_ms;      ///< wall time from the first draw to the fence, selection left out
    double frame_ms = 0.0;             ///< wall time from the frame's start until it was whole
    double output_ms = 0.0;            ///< wall time that the output took after that
    FrameStatistics drawn;
    std::uint64_t missed_deadlines = 0;  ///< passed over since the frame before
    std::string_view control = "off";    ///< what tolerance control made of this frame; static storage
    double unreachable_share = 0.0;      ///< how far above their target frames stay, where it cannot be met
    terrain::Geodetic eye;
};

/// One line of JSON each, without the line's end. The keys are documented in docs/frame-record.md; a number
/// that is not finite becomes null.
[[nodiscard]] std::string to_json_line(const RecordHeader& header);
[[nodiscard]] std::string to_json_line(const FrameEntry& entry);

/// A record file being written; lines stand in it as they are added, whole. Thread use: one thread.
class FrameRecord {
  public:
    /// Replaces a file of that name. On failure: one sentence with the remedy.
    [[nodiscard]] static tl::expected<FrameRecord, std::string> create(const std::filesystem::path& file);

    /// On failure (disk full): one sentence.
    [[nodiscard]] tl::expected<void, std::string> add(const std::string& line);

  private:
    FrameRecord(std::filesystem::path file, std::ofstream stream);
    std::filesystem::path file_;
    std::ofstream stream_;
};

}  // namespace eyepoint::ig
