#include "tools/replay/flight_ports.hpp"

#include <algorithm>
#include <map>
#include <tuple>

#include <fmt/format.h>

namespace eyepoint::tools {
namespace {

void widen(std::optional<Range>& range, double value) {
    if (!range) range = Range{value, value};
    range->lowest = std::min(range->lowest, value);
    range->highest = std::max(range->highest, value);
}

// Gathers one port's datagrams, in the order of the capture.
class PortGatherer {
  public:
    void take(const net::CapturedDatagram& datagram) {
        times_ns_.push_back(datagram.time_ns);
        const auto reception = session_.receive(datagram.payload, {datagram.time_ns});
        if (reception.dropped && summary_.first_drop.empty()) summary_.first_drop = reception.detail;
        const net::HostState* state = session_.state();
        const net::EntityState* ownship = reception.applied && state != nullptr ? state->ownship() : nullptr;
        if (ownship == nullptr) return;
        widen(summary_.latitude_deg, ownship->latitude_deg);
        widen(summary_.longitude_deg, ownship->longitude_deg);
        widen(summary_.altitude_m, ownship->altitude_m);
    }

    [[nodiscard]] PortSummary summary(std::uint16_t port) && {
        summary_.port = port;
        summary_.datagrams = times_ns_.size();
        summary_.counters = session_.counters();
        if (session_.state() != nullptr) summary_.protocol = session_.state()->protocol;
        summary_.duration_s = static_cast<double>(times_ns_.back() - times_ns_.front()) * 1.0e-9;
        summarize_spacing();
        return std::move(summary_);
    }

  private:
    void summarize_spacing() {
        std::vector<double> spacings;
        for (std::size_t i = 1; i < times_ns_.size(); ++i) {
            spacings.push_back(static_cast<double>(times_ns_[i] - times_ns_[i - 1]) * 1.0e-9);
        }
        if (spacings.empty()) return;
        std::sort(spacings.begin(), spacings.end());
        summary_.median_spacing_s = spacings[spacings.size() / 2];
        summary_.spacing_s = {spacings.front(), spacings.back()};
    }

    net::HostSession session_;
    PortSummary summary_;
    std::vector<std::int64_t> times_ns_;
};

}  // namespace

std::vector<PortSummary> summarize_ports(const net::PcapRecording& recording) {
    std::map<std::uint16_t, PortGatherer> gatherers;
    for (const auto& datagram : recording.datagrams) gatherers[datagram.destination_port].take(datagram);
    std::vector<PortSummary> summaries;
    for (auto& [port, gatherer] : gatherers) summaries.push_back(std::move(gatherer).summary(port));
    std::stable_sort(summaries.begin(), summaries.end(), [](const PortSummary& a, const PortSummary& b) {
        return std::tie(a.counters.applied, a.datagrams) > std::tie(b.counters.applied, b.datagrams);
    });
    return summaries;
}

tl::expected<std::uint16_t, std::string> choose_port(const net::PcapRecording& recording,
                                                     std::optional<std::uint16_t> wanted) {
    const auto summaries = summarize_ports(recording);
    if (summaries.empty()) return tl::unexpected(std::string("it holds no whole UDP datagram"));
    if (!wanted) return summaries.front().port;
    std::string ports;
    for (const PortSummary& summary : summaries) {
        if (summary.port == *wanted) return *wanted;
        ports += fmt::format("{}{} ({})", ports.empty() ? "" : ", ", summary.port, summary.datagrams);
    }
    return tl::unexpected(fmt::format("it holds no datagram to port {}, but to {}", *wanted, ports));
}

}  // namespace eyepoint::tools
