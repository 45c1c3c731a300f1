/// A bound UDP socket: non-blocking receive with the kernel's arrival time, and send. POSIX.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>

#include <tl/expected.hpp>

#include "net/endpoint.hpp"
#include "net/host_state.hpp"

namespace eyepoint::net {

/// One datagram as it lies in the caller's buffer.
struct ReceivedDatagram {
    std::size_t size = 0;    ///< bytes in the buffer
    bool truncated = false;  ///< the datagram was longer than the buffer; its end is lost
    Endpoint sender;
    ArrivalTime arrival;  ///< when the kernel took it in, not when it was read
};

/// Owns one socket. Movable, not copyable. Thread use: one thread at a time.
class UdpSocket {
  public:
    /// Binds to a numeric local address and a port (0: the kernel chooses, see local_port). The receive
    /// buffer asked for is a wish: the kernel may give less. A busy port and an address that is not of this
    /// machine are told apart in the message, with the remedy.
    [[nodiscard]] static tl::expected<UdpSocket, std::string> bind(
        const std::string& address, std::uint16_t port, int receive_buffer_bytes = kReceiveBufferBytes);

    UdpSocket(UdpSocket&& other) noexcept;
    UdpSocket& operator=(UdpSocket&& other) noexcept;
    UdpSocket(const UdpSocket&) = delete;
    UdpSocket& operator=(const UdpSocket&) = delete;
    ~UdpSocket();

    /// The next waiting datagram, or nullopt when none waits. Never blocks.
    [[nodiscard]] tl::expected<std::optional<ReceivedDatagram>, std::string> receive(
        std::span<std::byte> buffer) const;

    /// True when a datagram waits, false when the time has passed or a signal came. Negative: without end.
    [[nodiscard]] bool wait_readable(std::chrono::nanoseconds timeout) const;

    /// Never blocks; a full send buffer is an error like any other.
    [[nodiscard]] tl::expected<void, std::string> send_to(std::span<const std::byte> bytes,
                                                          const Endpoint& to) const;

    [[nodiscard]] std::uint16_t local_port() const;
    /// AF_INET or AF_INET6: what a peer's address must be.
    [[nodiscard]] int family() const { return family_; }

    /// A second of 1,000 Hz datagrams of 1,472 bytes, and as much again for the kernel's book-keeping.
    static constexpr int kReceiveBufferBytes = 4 * 1024 * 1024;

  private:
    UdpSocket(int descriptor, int family) : descriptor_(descriptor), family_(family) {}
    int descriptor_ = -1;
    int family_ = AF_INET;
};

}  // namespace eyepoint::net
