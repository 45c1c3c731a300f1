#include "ig/frame_record.hpp"

#include <cerrno>
#include <cstring>
#include <utility>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace eyepoint::ig {

namespace {

using Json = nlohmann::ordered_json;

constexpr int kRecordVersion = 1;

Json or_null(const std::optional<double>& value) { return value ? Json(*value) : Json(nullptr); }

std::string one_line(const Json& json) { return json.dump(-1, ' ', false, Json::error_handler_t::replace); }

}  // namespace

std::string to_json_line(const RecordHeader& header) {
    return one_line(Json{{"eyepoint_record", kRecordVersion},
                         {"version", header.version},
                         {"gl_renderer", header.gl.renderer},
                         {"gl_version", header.gl.version},
                         {"width_px", header.size.width_px},
                         {"height_px", header.size.height_px},
                         {"rate_hz", header.rate_hz},
                         {"terrain", header.terrain_name},
                         {"lod_method", header.lod_method}});
}

std::string to_json_line(const FrameEntry& entry) {
    const FrameStatistics& drawn = entry.drawn;
    return one_line(Json{{"frame", entry.frame},
                         {"host_frame", entry.host_frame},
                         {"sim_time_s", or_null(entry.sim_time_s)},
                         {"time_s", entry.time_s},
                         {"arrival_to_complete_ms", entry.arrival_to_complete_ms},
                         {"new_packet", entry.new_packet},
                         {"extrapolated_ms", entry.extrapolated_ms},
                         {"cpu_ms", entry.cpu_ms},
                         {"frame_thread_cpu_ms", entry.frame_thread_cpu_ms},
                         {"gpu_ms", or_null(entry.gpu_ms)},
                         {"frame_ms", entry.frame_ms},
                         {"output_ms", entry.output_ms},
                         {"selection_ms", drawn.selection_cpu_ms},
                         {"triangles", drawn.triangles},
                         {"triangles_hidden", drawn.triangles_hidden},
                         {"draws", drawn.draws},
                         {"blocks_drawn", drawn.blocks_drawn},
                         {"blocks_tested", drawn.blocks_tested},
                         {"blocks_reused", drawn.blocks_reused},
                         {"loads_pending", drawn.loads_pending},
                         {"blocks_uploaded", drawn.blocks_uploaded},
                         {"bytes_uploaded", drawn.bytes_uploaded},
                         {"tau_px", drawn.tau_px},
                         {"control", entry.control},
                         {"unreachable_share", entry.unreachable_share},
                         {"missed_deadlines", entry.missed_deadlines},
                         {"latitude_deg", entry.eye.latitude_deg},
                         {"longitude_deg", entry.eye.longitude_deg},
                         {"ellipsoidal_height_m", entry.eye.height.metres()}});
}

tl::expected<FrameRecord, std::string> FrameRecord::create(const std::filesystem::path& file) {
    std::ofstream stream(file, std::ios::trunc);
    if (stream) return FrameRecord{file, std::move(stream)};
    return tl::unexpected(
        fmt::format("{}: the frame record cannot be written there ({}); give --record a file in a "
                    "folder that you may write to",
                    file.string(), std::strerror(errno)));
}

FrameRecord::FrameRecord(std::filesystem::path file, std::ofstream stream)
    : file_(std::move(file)), stream_(std::move(stream)) {}

tl::expected<void, std::string> FrameRecord::add(const std::string& line) {
    stream_ << (line + '\n') << std::flush;
    if (stream_) return {};
    return tl::unexpected(fmt::format("{}: the frame record cannot be written on ({}); free some space",
                                      file_.string(), std::strerror(errno)));
}

}  // namespace eyepoint::ig
