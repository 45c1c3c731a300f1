#include "net/udp_socket.hpp"

#include <array>
#include <cerrno>
#include <cstring>
#include <utility>

#include <sys/socket.h>

#include <fmt/format.h>
#include <poll.h>
#include <time.h>
#include <unistd.h>

#include "net/nanoseconds.hpp"

namespace eyepoint::net {
namespace {

std::string why_not_bound(const std::string& address, std::uint16_t port, int error) {
    switch (error) {
        case EADDRINUSE:
            return fmt::format(
                "UDP port {} on {} is in use by another program: end it (ss -ulpn shows it) or choose "
                "another port",
                port, address);
        case EADDRNOTAVAIL:
            return fmt::format(
                "{} is not an address of this machine: listen on 0.0.0.0, or on one that 'ip address' "
                "shows",
                address);
        case EACCES:
            return fmt::format("UDP port {} may not be used by this user: choose one of 1024 or more", port);
        default:
            return fmt::format("cannot listen on UDP {} port {}: {}", address, port, std::strerror(error));
    }
}

// The kernel's arrival time among the control messages; the time of reading where it gave none.
ArrivalTime arrival_of(msghdr& message) {
    timespec stamp{};
    bool found = false;
    for (cmsghdr* header = CMSG_FIRSTHDR(&message); header != nullptr;
         header = CMSG_NXTHDR(&message, header)) {
        if (header->cmsg_level != SOL_SOCKET || header->cmsg_type != SCM_TIMESTAMPNS) continue;
        std::memcpy(&stamp, CMSG_DATA(header), sizeof(stamp));
        found = true;
    }
    if (!found) clock_gettime(CLOCK_REALTIME, &stamp);
    return {stamp.tv_sec * kNanosecondsPerSecond + stamp.tv_nsec};
}

}  // namespace

tl::expected<UdpSocket, std::string> UdpSocket::bind(const std::string& address, std::uint16_t port,
                                                     int receive_buffer_bytes) {
    const auto local = local_endpoint(address, port);
    if (!local) return tl::unexpected(local.error());
    const int family = local->address.ss_family;
    const int descriptor = ::socket(family, SOCK_DGRAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0);
    if (descriptor < 0)
        return tl::unexpected(fmt::format("cannot open a UDP socket: {}", std::strerror(errno)));
    UdpSocket socket(descriptor, family);
    const int on = 1;
    if (::setsockopt(descriptor, SOL_SOCKET, SO_TIMESTAMPNS, &on, sizeof(on)) != 0) {
        return tl::unexpected(
            fmt::format("the kernel gives no arrival times (SO_TIMESTAMPNS): {}", std::strerror(errno)));
    }
    // A smaller buffer than asked for is still a working socket.
    static_cast<void>(
        ::setsockopt(descriptor, SOL_SOCKET, SO_RCVBUF, &receive_buffer_bytes, sizeof(receive_buffer_bytes)));
    if (::bind(descriptor, reinterpret_cast<const sockaddr*>(&local->address), local->length) != 0) {
        return tl::unexpected(why_not_bound(address, port, errno));
    }
    return socket;
}

UdpSocket::UdpSocket(UdpSocket&& other) noexcept
    : descriptor_(std::exchange(other.descriptor_, -1)), family_(other.family_) {}

UdpSocket& UdpSocket::operator=(UdpSocket&& other) noexcept {
    std::swap(descriptor_, other.descriptor_);
    std::swap(family_, other.family_);
    return *this;
}

UdpSocket::~UdpSocket() {
    if (descriptor_ >= 0) ::close(descriptor_);
}

tl::expected<std::optional<ReceivedDatagram>, std::string> UdpSocket::receive(
    std::span<std::byte> buffer) const {
    ReceivedDatagram datagram;
    iovec place{buffer.data(), buffer.size()};
    alignas(cmsghdr) std::array<char, CMSG_SPACE(sizeof(timespec))> control{};
    msghdr message{};
    message.msg_name = &datagram.sender.address;
    message.msg_namelen = sizeof(datagram.sender.address);
    message.msg_iov = &place;
    message.msg_iovlen = 1;
    message.msg_control = control.data();
    message.msg_controllen = control.size();
    ssize_t size = 0;
    do {
        size = ::recvmsg(descriptor_, &message, 0);
    } while (size < 0 && (errno == EINTR || errno == ECONNREFUSED));
    if (size < 0) {
        if (errno == EAGAIN || errno == EWOULDBLOCK) return std::nullopt;
        return tl::unexpected(
            fmt::format("cannot receive on UDP port {}: {}", local_port(), std::strerror(errno)));
    }
    datagram.size = static_cast<std::size_t>(size);
    datagram.truncated = (message.msg_flags & MSG_TRUNC) != 0;
    datagram.sender.length = message.msg_namelen;
    datagram.arrival = arrival_of(message);
    return datagram;
}

bool UdpSocket::wait_readable(std::chrono::nanoseconds timeout) const {
    pollfd wanted{descriptor_, POLLIN, 0};
    const timespec wait{timeout.count() / kNanosecondsPerSecond, timeout.count() % kNanosecondsPerSecond};
    return ::ppoll(&wanted, 1, timeout.count() < 0 ? nullptr : &wait, nullptr) > 0;
}

tl::expected<void, std::string> UdpSocket::send_to(std::span<const std::byte> bytes,
                                                   const Endpoint& to) const {
    ssize_t sent = 0;
    do {
        sent = ::sendto(descriptor_, bytes.data(), bytes.size(), 0,
                        reinterpret_cast<const sockaddr*>(&to.address), to.length);
    } while (sent < 0 && errno == EINTR);
    if (sent >= 0) return {};
    return tl::unexpected(
        fmt::format("cannot send {} bytes to {}: {}", bytes.size(), to.text(), std::strerror(errno)));
}

std::uint16_t UdpSocket::local_port() const {
    Endpoint local;
    local.length = sizeof(local.address);
    if (::getsockname(descriptor_, reinterpret_cast<sockaddr*>(&local.address), &local.length) != 0) return 0;
    return local.port();
}

}  // namespace eyepoint::net
