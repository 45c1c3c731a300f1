#include "ig/recorded_flight.hpp"

#include <algorithm>
#include <map>

#include <fmt/format.h>

#include "net/host_session.hpp"

namespace eyepoint::ig {

std::optional<std::uint16_t> busiest_port(const net::PcapRecording& recording) {
    std::map<std::uint16_t, std::size_t> datagrams;
    for (const net::CapturedDatagram& datagram : recording.datagrams) ++datagrams[datagram.destination_port];
    const auto busiest = std::max_element(datagrams.begin(), datagrams.end(),
                                          [](const auto& a, const auto& b) { return a.second < b.second; });
    return busiest == datagrams.end() ? std::nullopt : std::optional{busiest->first};
}

tl::expected<std::vector<FlightEye>, std::string> fly(const net::PcapRecording& recording, std::uint16_t port,
                                                      const EyepointReading& reading, PictureSize size,
                                                      double rate_hz) {
    std::vector<const net::CapturedDatagram*> flight;
    for (const net::CapturedDatagram& datagram : recording.datagrams) {
        if (datagram.destination_port == port) flight.push_back(&datagram);
    }
    net::HostSession session;
    std::vector<FlightEye> eyes;
    std::size_t next = 0;
    for (std::int64_t frame = 0; next < flight.size(); ++frame) {
        const double time_s = static_cast<double>(frame) / rate_hz;
        const std::int64_t now_ns = flight.front()->time_ns + static_cast<std::int64_t>(time_s * 1e9);
        for (; next < flight.size() && flight[next]->time_ns <= now_ns; ++next) {
            session.receive(flight[next]->payload, {flight[next]->time_ns});
        }
        const net::HostState* state = session.state();
        const auto eyepoint = state != nullptr ? eyepoint_of(*state, reading, size) : std::nullopt;
        if (eyepoint) eyes.push_back({time_s, state->host_frame, *eyepoint});
    }
    if (eyes.empty())
        return tl::unexpected(fmt::format("port {} of the recording holds no valid eyepoint", port));
    return eyes;
}

}  // namespace eyepoint::ig
