#include "tools/replay/play.hpp"

#include <algorithm>
#include <cmath>
#include <ctime>
#include <vector>

#include <fmt/format.h>

#include "net/nanoseconds.hpp"
#include "net/pcap_file.hpp"
#include "net/udp_socket.hpp"
#include "tools/replay/flight_ports.hpp"

namespace eyepoint::tools {
namespace {

std::int64_t monotonic_ns() {
    timespec now{};
    clock_gettime(CLOCK_MONOTONIC, &now);
    return now.tv_sec * net::kNanosecondsPerSecond + now.tv_nsec;
}

// The chosen datagrams and when each is due after the start, at rate 1.
struct Program {
    std::vector<net::CapturedDatagram> datagrams;
    std::vector<std::int64_t> due_ns;
    std::int64_t period_ns = 0;  ///< of a loop: the duration and one usual spacing
};

tl::expected<Program, std::string> load(const PlayRequest& request) {
    auto recording = net::read_pcap(request.file);
    if (!recording) return tl::unexpected(std::move(recording.error()));
    const auto port = choose_port(*recording, request.port);
    if (!port) return tl::unexpected(fmt::format("{}: {}", request.file.string(), port.error()));
    Program program;
    std::optional<std::int64_t> first_ns;
    for (net::CapturedDatagram& datagram : recording->datagrams) {
        if (datagram.destination_port != *port) continue;
        if (!first_ns) first_ns = datagram.time_ns;
        const double at_s = static_cast<double>(datagram.time_ns - *first_ns) * 1.0e-9;
        if (at_s >= request.from_s && at_s <= request.until_s)
            program.datagrams.push_back(std::move(datagram));
    }
    if (program.datagrams.empty()) {
        return tl::unexpected(
            fmt::format("{}: nothing was sent to port {} between --from {} and --until {} seconds",
                        request.file.string(), *port, request.from_s, request.until_s));
    }
    for (const auto& datagram : program.datagrams) {
        program.due_ns.push_back(datagram.time_ns - program.datagrams.front().time_ns);
    }
    const std::int64_t duration = program.due_ns.back();
    const auto gaps = static_cast<std::int64_t>(std::max<std::size_t>(program.due_ns.size() - 1, 1));
    program.period_ns = std::max<std::int64_t>(duration + duration / gaps, 1'000'000);
    return program;
}

timespec at(std::int64_t time_ns) {
    return {time_ns / net::kNanosecondsPerSecond, time_ns % net::kNanosecondsPerSecond};
}

void send(const net::UdpSocket& socket, const net::Endpoint& to, const net::CapturedDatagram& datagram,
          std::int64_t deadline_ns, PlayReport& report) {
    if (socket.send_to(datagram.payload, to)) {
        ++report.packets;
    } else {
        ++report.send_errors;
    }
    const double late_ms = static_cast<double>(monotonic_ns() - deadline_ns) * 1.0e-6;
    report.latest_ms = std::max(report.latest_ms, late_ms);
}

}  // namespace

tl::expected<PlayReport, std::string> play(const PlayRequest& request, const StopSignal& stop) {
    const auto to = net::resolve_endpoint(request.to);
    if (!to) return tl::unexpected(to.error());
    const auto program = load(request);
    if (!program) return tl::unexpected(program.error());
    const auto socket = net::UdpSocket::bind(to->address.ss_family == AF_INET6 ? "::" : "0.0.0.0", 0);
    if (!socket) return tl::unexpected(socket.error());

    PlayReport report;
    std::int64_t start_ns = monotonic_ns();
    const std::int64_t first_ns = start_ns;
    do {
        for (std::size_t i = 0; i < program->datagrams.size(); ++i) {
            const auto due_ns = std::llround(static_cast<double>(program->due_ns[i]) / request.rate);
            report.stopped = stop.came_before(at(start_ns + due_ns));
            if (report.stopped) break;
            send(*socket, *to, program->datagrams[i], start_ns + due_ns, report);
            report.seconds = static_cast<double>(monotonic_ns() - first_ns) * 1.0e-9;
        }
        start_ns += std::llround(static_cast<double>(program->period_ns) / request.rate);
    } while (request.loop && !report.stopped);
    if (report.packets == 0 && !report.stopped) {
        return tl::unexpected(
            fmt::format("no datagram could be sent to {} ({} tried): is there a route to it?", to->text(),
                        report.send_errors));
    }
    return report;
}

}  // namespace eyepoint::tools
