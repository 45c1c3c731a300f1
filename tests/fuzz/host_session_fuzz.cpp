// One input: datagrams, each behind a 16-bit length, to one host session; and the input as a captured frame.
// Whatever comes, nothing is read outside, and the state in force is finite and in range.
#include <cmath>
#include <cstdlib>
#include <memory>

#include "net/host_session.hpp"
#include "net/udp_datagram.hpp"
#include "net/wire/fgnetfdm.hpp"

namespace {

using namespace eyepoint::net;

void require(bool holds) {
    if (!holds) std::abort();
}

void check(const HostState* state) {
    if (state == nullptr) return;
    for (const auto& [id, entity] : state->entities) {
        require(std::abs(entity.latitude_deg) <= 90.0 && std::abs(entity.longitude_deg) <= 180.0);
        require(entity.altitude_m >= wire::kLowestAltitudeM && entity.altitude_m <= wire::kHighestAltitudeM);
        require(entity.attitude.yaw_deg >= 0.0 && entity.attitude.yaw_deg < 360.0);
        require(std::abs(entity.attitude.pitch_deg) <= 90.0 && std::abs(entity.attitude.roll_deg) <= 180.0);
    }
    for (const auto& [id, view] : state->views) {
        for (const double offset : view.offset_m) require(std::isfinite(offset));
        require(!view.left_deg || !view.right_deg || *view.left_deg < *view.right_deg);
        require(!view.bottom_deg || !view.top_deg || *view.bottom_deg < *view.top_deg);
    }
}

// Every datagram in an allocation of exactly its size.
void receive(HostSession& session, const std::uint8_t* bytes, std::size_t size) {
    const auto copy = std::make_unique<std::byte[]>(size);
    for (std::size_t i = 0; i < size; ++i) copy[i] = std::byte{bytes[i]};
    const auto reception = session.receive({copy.get(), size}, {});
    require(reception.applied || reception.dropped.has_value());
    check(session.state());
    require(session.start_of_frame({}).size() >= 16);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    HostSession session;
    std::size_t at = 0;
    while (at + 2 <= size) {
        const std::size_t stated = data[at] | static_cast<std::size_t>(data[at + 1]) << 8U;
        at += 2;
        const std::size_t length = stated < size - at ? stated : size - at;
        receive(session, data + at, length);
        at += length;
    }
    const std::span bytes(reinterpret_cast<const std::byte*>(data), size);
    for (const auto layer : {LinkLayer::Ethernet, LinkLayer::RawIp, LinkLayer::LinuxCooked}) {
        static_cast<void>(look_into_frame(bytes, layer));
    }
    return 0;
}
