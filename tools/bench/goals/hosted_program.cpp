#include "tools/bench/goals/hosted_program.hpp"

#include <chrono>
#include <cmath>
#include <csignal>
#include <ctime>
#include <thread>

#include <fmt/format.h>

#include "net/wire/fgnetfdm.hpp"

namespace eyepoint::tools {

namespace {

constexpr const char* kHere = "127.0.0.1";
constexpr std::chrono::seconds kHostPatience{120};

tl::expected<void, std::string> place(const net::UdpSocket& host, const net::Endpoint& to,
                                      const terrain::Geodetic& at) {
    net::wire::FgNetFdm fdm;
    fdm.latitude_deg = at.latitude_deg;
    fdm.longitude_deg = at.longitude_deg;
    fdm.altitude_m = at.height.metres();
    return host.send_to(net::wire::encode_fgnetfdm24(fdm), to);
}

}  // namespace

tl::expected<HostedProgram, std::string> HostedProgram::start(const std::filesystem::path& program,
                                                              const std::filesystem::path& terrain,
                                                              std::vector<std::string> arguments) {
    auto host = net::UdpSocket::bind(kHere, 0);
    if (!host) return tl::unexpected(host.error());
    // A port that was free a moment ago: the program binds it again.
    const auto free_port = net::UdpSocket::bind(kHere, 0).map([](const auto& s) { return s.local_port(); });
    if (!free_port) return tl::unexpected(free_port.error());
    const std::string port = std::to_string(*free_port);
    const auto to = net::resolve_endpoint(fmt::format("{}:{}", kHere, port));
    if (!to) return tl::unexpected(to.error());
    const std::vector<std::string> needed{program.string(), "--terrain",
                                          terrain.string(), "--headless",
                                          "--listen",       kHere,
                                          "--port",         port,
                                          "--set",          "host.altitude_datum=ellipsoid"};
    arguments.insert(arguments.begin(), needed.begin(), needed.end());
    auto process = ChildProcess::start(std::move(arguments));
    if (!process) return tl::unexpected(process.error());
    if (!process->wait_for_error_text(fmt::format("ready: listening on {} port {}", kHere, port),
                                      kHostPatience))
        return tl::unexpected("eyepoint did not start: " +
                              process->wait(std::chrono::seconds(0)).standard_error);
    return HostedProgram{*std::move(process), *std::move(host), *to};
}

tl::expected<void, std::string> HostedProgram::fly(const std::vector<terrain::Geodetic>& places,
                                                   double rate_hz) const {
    const auto begin = std::chrono::steady_clock::now();
    for (std::size_t i = 0; i < places.size(); ++i) {
        const auto due_ns = std::llround(static_cast<double>(i) / rate_hz * 1e9);
        std::this_thread::sleep_until(begin + std::chrono::nanoseconds(due_ns));
        if (auto sent = place(host_, to_, places[i]); !sent) return sent;
    }
    return {};
}

double HostedProgram::cpu_s() const {
    clockid_t clock{};
    timespec used{};
    if (clock_getcpuclockid(process_.id(), &clock) != 0 || clock_gettime(clock, &used) != 0) return 0.0;
    return static_cast<double>(used.tv_sec) + static_cast<double>(used.tv_nsec) * 1e-9;
}

tl::expected<void, std::string> HostedProgram::end() {
    process_.send_signal(SIGINT);
    const Ending ending = process_.wait(kHostPatience);
    if (ending.exit_code != 0) return tl::unexpected("eyepoint ended badly: " + ending.standard_error);
    return {};
}

}  // namespace eyepoint::tools
