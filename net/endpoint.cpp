#include "net/endpoint.hpp"

#include <charconv>
#include <cstring>
#include <memory>

#include <arpa/inet.h>
#include <netinet/in.h>

#include <fmt/format.h>
#include <netdb.h>

namespace eyepoint::net {
namespace {

using AddressList = std::unique_ptr<addrinfo, decltype(&freeaddrinfo)>;

tl::expected<Endpoint, std::string> first_address(const std::string& host, const std::string& port,
                                                  int family, int flags) {
    addrinfo hints{};
    hints.ai_family = family;
    hints.ai_socktype = SOCK_DGRAM;
    hints.ai_flags = flags | AI_NUMERICSERV;
    addrinfo* list = nullptr;
    const int failure = getaddrinfo(host.empty() ? nullptr : host.c_str(), port.c_str(), &hints, &list);
    const AddressList owner(list, &freeaddrinfo);
    if (failure != 0) return tl::unexpected(std::string(gai_strerror(failure)));
    Endpoint endpoint;
    std::memcpy(&endpoint.address, list->ai_addr, list->ai_addrlen);
    endpoint.length = list->ai_addrlen;
    return endpoint;
}

struct HostAndPort {
    std::string host;
    std::string port;
};

tl::expected<HostAndPort, std::string> split(std::string_view text) {
    const auto refuse = [&] {
        return tl::unexpected(fmt::format(
            "'{}' is not HOST:PORT with a port of 1 to 65535 (for example 127.0.0.1:5560 or [::1]:5560)",
            text));
    };
    const std::size_t colon = text.rfind(':');
    if (colon == std::string_view::npos || colon == 0) return refuse();
    std::string_view host = text.substr(0, colon);
    const std::string_view port = text.substr(colon + 1);
    std::uint16_t number = 0;
    const auto [end, error] = std::from_chars(port.data(), port.data() + port.size(), number);
    if (error != std::errc() || end != port.data() + port.size() || number == 0) return refuse();
    if (host.front() == '[' && host.back() == ']') {
        host = host.substr(1, host.size() - 2);
    } else if (host.find(':') != std::string_view::npos) {
        return refuse();
    }
    if (host.empty()) return refuse();
    return HostAndPort{std::string(host), std::string(port)};
}

}  // namespace

std::uint16_t Endpoint::port() const {
    if (address.ss_family == AF_INET) return ntohs(reinterpret_cast<const sockaddr_in&>(address).sin_port);
    if (address.ss_family == AF_INET6) return ntohs(reinterpret_cast<const sockaddr_in6&>(address).sin6_port);
    return 0;
}

std::string Endpoint::text() const {
    std::array<char, INET6_ADDRSTRLEN> host{};
    if (address.ss_family == AF_INET) {
        const auto& ipv4 = reinterpret_cast<const sockaddr_in&>(address);
        inet_ntop(AF_INET, &ipv4.sin_addr, host.data(), host.size());
        return fmt::format("{}:{}", host.data(), port());
    }
    const auto& ipv6 = reinterpret_cast<const sockaddr_in6&>(address);
    inet_ntop(AF_INET6, &ipv6.sin6_addr, host.data(), host.size());
    return fmt::format("[{}]:{}", host.data(), port());
}

std::array<std::uint8_t, 4> Endpoint::ipv4_bytes() const {
    std::array<std::uint8_t, 4> bytes{};
    if (address.ss_family == AF_INET) {
        std::memcpy(bytes.data(), &reinterpret_cast<const sockaddr_in&>(address).sin_addr, bytes.size());
    }
    return bytes;
}

tl::expected<Endpoint, std::string> resolve_endpoint(std::string_view host_and_port, int family) {
    const auto parts = split(host_and_port);
    if (!parts) return tl::unexpected(parts.error());
    return first_address(parts->host, parts->port, family, 0).map_error([&](const std::string& cause) {
        return fmt::format("cannot find the host of '{}': {}", host_and_port, cause);
    });
}

tl::expected<Endpoint, std::string> local_endpoint(const std::string& address, std::uint16_t port) {
    const std::string host = address.empty() ? "0.0.0.0" : address;
    return first_address(host, std::to_string(port), AF_UNSPEC, AI_NUMERICHOST | AI_PASSIVE)
        .map_error([&](const std::string&) {
            return fmt::format(
                "'{}' is not a numeric address to listen on (0.0.0.0 is every IPv4 interface, :: "
                "every interface)",
                address);
        });
}

}  // namespace eyepoint::net
