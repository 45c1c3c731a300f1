#include "tools/replay/info.hpp"

#include <iterator>

#include <fmt/format.h>

#include "net/pcap_file.hpp"
#include "tools/replay/flight_ports.hpp"

namespace eyepoint::tools {
namespace {

std::string_view protocol_name(const PortSummary& summary) {
    if (!summary.protocol) return "no protocol that is supported";
    return *summary.protocol == net::Protocol::Cigi ? "CIGI 3" : "FGNetFDM";
}

void describe_port(std::string& text, const PortSummary& summary) {
    const auto out = std::back_inserter(text);
    fmt::format_to(out, "port {}: {} datagrams, {}, {} applied, {:.1f} s\n", summary.port, summary.datagrams,
                   protocol_name(summary), summary.counters.applied, summary.duration_s);
    if (summary.datagrams > 1 && summary.median_spacing_s > 0.0) {
        fmt::format_to(out, "  rate {:.1f} a second; spacing median {:.2f} ms, {:.2f} to {:.2f} ms\n",
                       1.0 / summary.median_spacing_s, summary.median_spacing_s * 1.0e3,
                       summary.spacing_s.lowest * 1.0e3, summary.spacing_s.highest * 1.0e3);
    }
    if (summary.latitude_deg) {
        fmt::format_to(
            out,
            "  ownship latitude {:.5f} to {:.5f}, longitude {:.5f} to {:.5f}, altitude {:.1f} to {:.1f} m\n",
            summary.latitude_deg->lowest, summary.latitude_deg->highest, summary.longitude_deg->lowest,
            summary.longitude_deg->highest, summary.altitude_m->lowest, summary.altitude_m->highest);
    }
    for (std::size_t i = 0; i < summary.counters.dropped.size(); ++i) {
        if (summary.counters.dropped[i] == 0) continue;
        fmt::format_to(out, "  dropped, {}: {}\n", net::name(static_cast<net::DropReason>(i)),
                       summary.counters.dropped[i]);
    }
    if (!summary.first_drop.empty()) fmt::format_to(out, "  first drop: {}\n", summary.first_drop);
}

}  // namespace

tl::expected<std::string, std::string> describe_flight(const std::filesystem::path& file) {
    const auto recording = net::read_pcap(file);
    if (!recording) return tl::unexpected(recording.error());
    std::string text = fmt::format("{}: {} UDP datagrams\n", file.string(), recording->datagrams.size());
    const auto out = std::back_inserter(text);
    if (recording->truncated) fmt::format_to(out, "the file ends in the middle of a packet\n");
    if (recording->other_packets + recording->fragments + recording->cut_packets > 0) {
        fmt::format_to(out,
                       "not used: {} packets that are not UDP, {} fragments, {} cut short when captured\n",
                       recording->other_packets, recording->fragments, recording->cut_packets);
    }
    for (const PortSummary& summary : summarize_ports(*recording)) describe_port(text, summary);
    return text;
}

}  // namespace eyepoint::tools
