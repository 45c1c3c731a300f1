#include "tools/report/page.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <string_view>
#include <system_error>
#include <utility>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "tools/report/page_parts.hpp"
#include "tools/report/page_texts.hpp"
#include "tools/report/summary.hpp"

namespace eyepoint::tools {
namespace {

/// Points a plot has at most: more than a screen has columns, and still quick on a phone.
constexpr std::size_t kMostPoints = 3000;
constexpr int kJpegQuality = 82;
constexpr std::string_view kBase64Digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";

struct SummaryRow {
    const char* key;
    const char* label;
    int decimals;
};
constexpr std::array kSummaryRows = {
    SummaryRow{"frame_ms", "Frame time, ms", 2},
    SummaryRow{"cpu_ms", "CPU of all threads, ms", 2},
    SummaryRow{"gpu_ms", "GPU, ms", 2},
    SummaryRow{"still_cpu_ms", "CPU of the same triangles as a static mesh, ms", 2},
    SummaryRow{"price_of_lod", "CPU over that of the static mesh", 3},
    SummaryRow{"selection_ms", "LOD selection, ms", 3},
    SummaryRow{"outside_gl_ms", "Frame thread outside GL, ms", 3},
    SummaryRow{"transport_delay_ms", "Transport delay, ms", 2},
    SummaryRow{"triangles", "Triangles", 0},
    SummaryRow{"draws", "Draw calls", 0},
    SummaryRow{"blocks_drawn", "Blocks drawn", 0},
    SummaryRow{"blocks_tested", "Blocks tested", 0},
    SummaryRow{"blocks_reused", "Blocks whose level was kept", 0},
    SummaryRow{"loads_pending", "Loads waiting", 0},
    SummaryRow{"blocks_uploaded", "Blocks uploaded", 0},
    SummaryRow{"bytes_uploaded", "Bytes uploaded", 0},
    SummaryRow{"allocations", "Heap allocations of the frame thread", 0},
    SummaryRow{"tau_px", "Tolerance, px", 2},
};

std::string base64(std::string_view bytes) {
    std::string result;
    for (std::size_t i = 0; i < bytes.size(); i += 3) {
        const auto at = [&](std::size_t j) -> unsigned {
            return j < bytes.size() ? static_cast<unsigned char>(bytes[j]) : 0U;
        };
        const unsigned group = at(i) << 16U | at(i + 1) << 8U | at(i + 2);
        const auto digit = [&](unsigned shift) { return kBase64Digits[group >> shift & 63U]; };
        result += {digit(18), digit(12), i + 1 < bytes.size() ? digit(6) : '=',
                   i + 2 < bytes.size() ? digit(0) : '='};
    }
    return result;
}

/// 1234567.8 as "1 234 567.80" with narrow no-break spaces.
std::string grouped(double value, int decimals) {
    std::string text = fmt::format("{:.{}f}", value, decimals);
    const auto point = text.find('.');
    for (auto end = static_cast<std::ptrdiff_t>(point == std::string::npos ? text.size() : point) - 3;
         end > (text.front() == '-' ? 1 : 0); end -= 3) {
        text.insert(static_cast<std::size_t>(end), "\u202F");
    }
    return text;
}

std::string fact(std::string_view name, std::string_view value) {
    return fmt::format("<div><dt>{}</dt><dd>{}</dd></div>\n", escaped(name), escaped(value));
}

/// The header's mark that it is one.
constexpr std::string_view kFormatKey = "eyepoint_record";

struct HeaderLabel {
    const char* key;
    const char* label;
};
constexpr std::array kHeaderLabels = {
    HeaderLabel{"gl_renderer", "GL renderer"},
    HeaderLabel{"gl_version", "GL version"},
    HeaderLabel{"version", "Eyepoint"},
    HeaderLabel{"terrain", "Terrain"},
    HeaderLabel{"lod_method", "LOD method"},
    HeaderLabel{"width_px", "Picture width, px"},
    HeaderLabel{"height_px", "Picture height, px"},
    HeaderLabel{"rate_hz", "Rate asked for, Hz"},
};

/// What the record's header says: the known keys first, under their labels, then the rest under their own
/// names.
std::string header_facts(const RecordHeader& header) {
    std::string facts;
    for (const HeaderLabel& known : kHeaderLabels) {
        const auto said = std::ranges::find(header, known.key, &RecordHeader::value_type::first);
        if (said != header.end()) facts += fact(known.label, said->second);
    }
    for (const auto& said : header) {
        const auto is_it = [&](const HeaderLabel& known) { return said.first == known.key; };
        if (said.first == kFormatKey || std::ranges::any_of(kHeaderLabels, is_it)) continue;
        facts += fact(said.first, said.second);
    }
    return facts;
}

std::string run_facts(const FrameColumns& record, const RecordHeader& figures) {
    std::string facts = fact("Frames", grouped(static_cast<double>(record.frames), 0));
    if (const auto* time = record.find("time_s")) {
        const double duration_s = time->back() - time->front();
        facts += fact("Duration", fmt::format("{:.1f} s", duration_s));
        if (duration_s > 0.0) {
            facts += fact("Frames a second",
                          fmt::format("{:.1f}", static_cast<double>(record.frames - 1) / duration_s));
        }
    }
    if (const auto* missed = record.find("missed_deadlines")) {
        double sum = 0.0;
        for (const double in_frame : *missed) sum += std::isnan(in_frame) ? 0.0 : in_frame;
        facts += fact("Missed deadlines", grouped(sum, 0));
    }
    for (const auto& [name, value] : figures) facts += fact(name, value);
    return facts;
}

std::string summary_rows(const FrameColumns& record) {
    std::string rows;
    for (const SummaryRow& row : kSummaryRows) {
        const auto* column = record.find(row.key);
        const auto found = column == nullptr ? std::nullopt : percentiles(*column);
        if (!found) continue;
        rows += fmt::format("<tr><th scope=\"row\">{}</th>", row.label);
        for (const double value : {found->p50, found->p95, found->p99, found->maximum}) {
            rows += fmt::format("<td>{}</td>", grouped(value, row.decimals));
        }
        rows += "</tr>\n";
    }
    return rows;
}

/// Columns that are kept to all digits and not taken the largest of.
constexpr std::array<std::string_view, 7> kTimeAndPlace = {
    "frame", "host_frame", "time_s", "sim_time_s", "latitude_deg", "longitude_deg", "ellipsoidal_height_m"};

bool is_of_time_or_place(const std::string& key) {
    return std::ranges::find(kTimeAndPlace, key) != kTimeAndPlace.end();
}

/// The columns for the page's script, thinned; numbers to six significant digits, places to all.
std::string plot_data(const FrameColumns& record, std::size_t step) {
    nlohmann::json columns = nlohmann::json::object();
    for (const auto& [key, values] : record.columns) {
        const bool exact = is_of_time_or_place(key);
        auto& column = columns[key] = nlohmann::json::array();
        for (const double value : thin(values, step, exact ? Thinning::First : Thinning::Largest)) {
            if (!std::isfinite(value)) {
                column.push_back(nullptr);
            } else {
                column.push_back(exact ? value : std::stod(fmt::format("{:.6g}", value)));
            }
        }
    }
    return script_text(columns);
}

tl::expected<std::string, std::string> picture_figures(std::span<const SmallPicture> pictures) {
    std::string figures;
    for (const SmallPicture& picture : pictures) {
        const auto bytes = jpeg(picture, kJpegQuality);
        if (!bytes) return tl::unexpected(bytes.error());
        figures += fmt::format(
            "<figure><img src=\"data:image/jpeg;base64,{}\" width=\"{}\" height=\"{}\" alt=\"Picture {}\">"
            "<figcaption>{}</figcaption></figure>\n",
            base64(*bytes), picture.width_px, picture.height_px, escaped(picture.name),
            escaped(picture.name));
    }
    return figures.empty()
               ? figures
               : "<section><h2>Pictures</h2><div class=\"pictures\">" + figures + "</div></section>";
}

std::string notes(const FrameColumns& record, std::size_t step) {
    std::string text;
    if (record.cut_off)
        text += "<p class=\"note\">The record ends in the middle of a line: the run did not end cleanly.</p>";
    if (step > 1)
        text += fmt::format("<p class=\"note\">A point of a plot is the largest of {} frames.</p>", step);
    return text;
}

}  // namespace

tl::expected<std::string, std::string> report_page(const std::string& title, const FrameColumns& record,
                                                   std::span<const SmallPicture> pictures,
                                                   const RecordHeader& figures) {
    const auto shown = picture_figures(pictures);
    if (!shown) return tl::unexpected(shown.error());
    const std::size_t step = (record.frames + kMostPoints - 1) / kMostPoints;
    const std::array<PagePart, 11> parts = {{
        {"title", escaped(title)},
        {"style", std::string(kPageCss)},
        {"run", run_facts(record, figures)},
        {"machine", header_facts(record.header)},
        {"notes", notes(record, step)},
        {"summary", summary_rows(record)},
        {"pictures", *shown},
        {"chart_library", std::string(kChartJs)},
        {"data", plot_data(record, step)},
        {"charts", std::string(kChartsJs)},
        {"script", std::string(kPageJs)},
    }};
    return fill(kPageHtml, parts);
}

tl::expected<void, std::string> write_whole(const std::filesystem::path& file, const std::string& text) {
    const auto partial = std::filesystem::path(file).concat(".partial");
    std::ofstream stream(partial, std::ios::binary);
    stream << text;
    stream.close();
    std::error_code error;
    if (stream) std::filesystem::rename(partial, file, error);
    if (stream && !error) return {};
    std::error_code ignored;
    std::filesystem::remove(partial, ignored);
    return tl::unexpected(
        fmt::format("{}: cannot be written; is its folder there, with room and permission?", file.string()));
}

}  // namespace eyepoint::tools
