/// A UDP address and port, IPv4 or IPv6.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>

#include <sys/socket.h>

#include <tl/expected.hpp>

namespace eyepoint::net {

/// A socket address as the kernel takes it. A plain value.
struct Endpoint {
    sockaddr_storage address{};
    socklen_t length = 0;

    [[nodiscard]] std::uint16_t port() const;
    /// "192.0.2.1:5560" or "[2001:db8::1]:5560".
    [[nodiscard]] std::string text() const;
    /// In the order they are written; 0.0.0.0 for IPv6.
    [[nodiscard]] std::array<std::uint8_t, 4> ipv4_bytes() const;
};

/// Looks up "HOST:PORT" (a name, an IPv4 address or an IPv6 address in brackets). `family` is AF_INET,
/// AF_INET6 or AF_UNSPEC; may ask the resolver and so block. On failure: one sentence that names the text.
[[nodiscard]] tl::expected<Endpoint, std::string> resolve_endpoint(std::string_view host_and_port,
                                                                   int family = AF_UNSPEC);

/// Looks up a local address (a numeric one; "" or "0.0.0.0" means every IPv4 interface) for binding.
[[nodiscard]] tl::expected<Endpoint, std::string> local_endpoint(const std::string& address,
                                                                 std::uint16_t port);

}  // namespace eyepoint::net
