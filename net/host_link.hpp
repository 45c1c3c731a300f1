/// The IG's end of the wire: socket and session together, used once a frame.
///
///     poll() at the start of a frame's drawing -> state() -> draw -> answer(status)
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <tl/expected.hpp>

#include "net/host_session.hpp"
#include "net/udp_socket.hpp"

namespace eyepoint::net {

struct HostLinkSettings {
    std::string address = "0.0.0.0";  ///< numeric local address to listen on
    std::uint16_t port = 5560;        ///< 0: the kernel chooses, see local_port
    /// "HOST:PORT" that Start Of Frame goes to, from the first frame on, unless the host speaks FGNetFDM.
    /// Empty: to whoever sent the last valid CIGI datagram; nobody until one has come.
    std::string answer_to;
};

/// What one poll found.
struct PollResult {
    unsigned datagrams = 0;  ///< taken from the socket, at most kDatagramsPerPoll
    unsigned applied = 0;
    unsigned dropped =
        0;  ///< datagrams with at least one drop; some of them may have been applied all the same
    /// For a rate-limited log: the first drops of this poll, at most kDetailsPerPoll, each with its sender.
    std::vector<std::string> details;
};

/// Owns the socket, the session and the receive buffer. Movable. Thread use: one thread at a time.
class HostLink {
  public:
    /// On failure: one sentence with the remedy (busy port, unknown host).
    [[nodiscard]] static tl::expected<HostLink, std::string> open(const HostLinkSettings& settings);

    /// Takes what waits, oldest first, so that the newest valid datagram is the one in force. Never blocks. A
    /// flood is met with kDatagramsPerPoll a call; the rest waits for the next one.
    PollResult poll();

    /// As poll, but first waits for a datagram at most `timeout`.
    PollResult wait_and_poll(std::chrono::nanoseconds timeout);
    /// True when a datagram waits, false when the time has passed or a signal came. Takes nothing.
    [[nodiscard]] bool wait_for_datagram(std::chrono::nanoseconds timeout) const {
        return socket_.wait_readable(timeout);
    }

    /// nullptr until a host has spoken validly. Points into the link; valid until the next poll or move.
    [[nodiscard]] const HostState* state() const { return session_.state(); }
    [[nodiscard]] const SessionCounters& counters() const { return session_.counters(); }

    /// Sends Start Of Frame to the host; false when there is nobody to send it to. A failed send is an error
    /// that the next frame may not meet again.
    tl::expected<bool, std::string> answer(const IgStatus& status);

    [[nodiscard]] std::uint16_t local_port() const { return socket_.local_port(); }

    static constexpr unsigned kDatagramsPerPoll = 256;
    static constexpr std::size_t kDetailsPerPoll = 4;

  private:
    HostLink(UdpSocket socket, std::optional<Endpoint> answer_to);
    void take(const ReceivedDatagram& datagram, PollResult& result);

    UdpSocket socket_;
    HostSession session_;
    std::optional<Endpoint> answer_to_;  ///< configured
    std::optional<Endpoint> speaker_;    ///< sender of the last valid CIGI datagram
    std::vector<std::byte> buffer_;
};

}  // namespace eyepoint::net
