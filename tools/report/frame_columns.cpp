#include "tools/report/frame_columns.hpp"

#include <cerrno>
#include <cstring>
#include <fstream>
#include <limits>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace eyepoint::tools {
namespace {

using Json = nlohmann::ordered_json;

constexpr double kAbsent = std::numeric_limits<double>::quiet_NaN();

bool is_frame(const Json& line) {
    const auto frame = line.find("frame");
    return frame != line.end() && frame->is_number();
}

RecordHeader header_of(const Json& line) {
    RecordHeader header;
    for (const auto& [key, value] : line.items()) {
        header.emplace_back(key, value.is_string() ? value.get<std::string>() : value.dump());
    }
    return header;
}

void append(FrameColumns& record, const Json& line) {
    const auto put = [&](const std::string& key, const Json& value) {
        if (!value.is_number()) return;
        auto& column = record.columns[key];
        column.resize(record.frames, kAbsent);
        column.push_back(value.get<double>());
    };
    for (const auto& [key, value] : line.items()) put(key, value);
    const auto delay = line.find("arrival_to_complete_ms");
    const auto new_packet = line.find("new_packet");
    const bool drawn_before = new_packet != line.end() && *new_packet == false;
    if (delay != line.end() && !drawn_before) put("transport_delay_ms", *delay);
    ++record.frames;
}

}  // namespace

const std::vector<double>* FrameColumns::find(const std::string& key) const {
    const auto found = columns.find(key);
    return found == columns.end() ? nullptr : &found->second;
}

tl::expected<FrameColumns, std::string> read_frame_columns(const std::filesystem::path& file) {
    std::ifstream stream(file, std::ios::binary);
    if (!stream || std::filesystem::is_directory(file)) {
        const char* reason = stream ? "it is a folder" : std::strerror(errno);
        return tl::unexpected(fmt::format("{}: frame record cannot be read: {}", file.string(), reason));
    }
    FrameColumns record;
    std::string text;
    for (std::size_t number = 1; std::getline(stream, text); ++number) {
        const auto line = Json::parse(text, nullptr, false);
        if (line.is_object() && number == 1 && !is_frame(line)) {
            record.header = header_of(line);
        } else if (line.is_object() && is_frame(line)) {
            append(record, line);
        } else if (line.is_discarded() && stream.eof() && record.frames > 0) {
            record.cut_off = true;
        } else {
            return tl::unexpected(fmt::format(
                "{}:{}: not a line of a frame record; expected a JSON object with the number \"frame\"",
                file.string(), number));
        }
    }
    if (record.frames == 0) {
        return tl::unexpected(
            fmt::format("{}: holds no frame; was eyepoint ended before its first frame?", file.string()));
    }
    for (auto& [key, column] : record.columns) column.resize(record.frames, kAbsent);
    return record;
}

}  // namespace eyepoint::tools
