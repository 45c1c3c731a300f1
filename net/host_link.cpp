#include "net/host_link.hpp"

#include <utility>

#include <fmt/format.h>

namespace eyepoint::net {
namespace {
// One more than the longest UDP payload, so that nothing is ever cut.
constexpr std::size_t kBufferBytes = 65536;
}  // namespace

HostLink::HostLink(UdpSocket socket, std::optional<Endpoint> answer_to)
    : socket_(std::move(socket)), answer_to_(answer_to), buffer_(kBufferBytes) {}

tl::expected<HostLink, std::string> HostLink::open(const HostLinkSettings& settings) {
    auto socket = UdpSocket::bind(settings.address, settings.port);
    if (!socket) return tl::unexpected(std::move(socket.error()));
    std::optional<Endpoint> answer_to;
    if (!settings.answer_to.empty()) {
        auto resolved = resolve_endpoint(settings.answer_to, socket->family());
        if (!resolved) return tl::unexpected(std::move(resolved.error()));
        answer_to = *resolved;
    }
    return HostLink(std::move(*socket), answer_to);
}

void HostLink::take(const ReceivedDatagram& datagram, PollResult& result) {
    ++result.datagrams;
    const Reception reception = session_.receive(std::span(buffer_).first(datagram.size), datagram.arrival);
    if (reception.applied) {
        ++result.applied;
        if (session_.state()->protocol == Protocol::Cigi) speaker_ = datagram.sender;
    }
    if (!reception.dropped) return;
    ++result.dropped;
    if (result.details.size() < kDetailsPerPoll) {
        result.details.push_back(fmt::format("from {}: {}", datagram.sender.text(), reception.detail));
    }
}

PollResult HostLink::poll() {
    PollResult result;
    while (result.datagrams < kDatagramsPerPoll) {
        const auto datagram = socket_.receive(buffer_);
        if (!datagram) {
            result.details.push_back(datagram.error());
            break;
        }
        if (!*datagram) break;
        take(**datagram, result);
    }
    return result;
}

PollResult HostLink::wait_and_poll(std::chrono::nanoseconds timeout) {
    static_cast<void>(socket_.wait_readable(timeout));
    return poll();
}

tl::expected<bool, std::string> HostLink::answer(const IgStatus& status) {
    const HostState* state = session_.state();
    if (state != nullptr && state->protocol == Protocol::FgNetFdm) return false;
    const std::optional<Endpoint>& peer = answer_to_ ? answer_to_ : speaker_;
    if (!peer) return false;
    return socket_.send_to(session_.start_of_frame(status), *peer).map([] { return true; });
}

}  // namespace eyepoint::net
