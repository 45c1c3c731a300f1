/// `eyepoint`, started headless with its host's socket in this process.
#pragma once

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include <tl/expected.hpp>

#include "net/endpoint.hpp"
#include "net/udp_socket.hpp"
#include "terrain/geodesy/position.hpp"
#include "tools/process/child_process.hpp"

namespace eyepoint::tools {

/// Thread use: one thread.
class HostedProgram {
  public:
    /// Ready to hear the host when this returns. `arguments` are added. On failure: one sentence.
    [[nodiscard]] static tl::expected<HostedProgram, std::string> start(const std::filesystem::path& program,
                                                                        const std::filesystem::path& terrain,
                                                                        std::vector<std::string> arguments);

    /// Places the vehicle, level and looking north, at times that are exact on a grid of `rate_hz`. On
    /// failure: one sentence.
    [[nodiscard]] tl::expected<void, std::string> fly(const std::vector<terrain::Geodetic>& places,
                                                      double rate_hz) const;
    /// CPU of all its threads so far, seconds.
    [[nodiscard]] double cpu_s() const;
    /// Asks it to end and waits. On failure (a bad exit code): one sentence.
    [[nodiscard]] tl::expected<void, std::string> end();

  private:
    HostedProgram(ChildProcess process, net::UdpSocket host, net::Endpoint to)
        : process_(std::move(process)), host_(std::move(host)), to_(to) {}

    ChildProcess process_;
    net::UdpSocket host_;
    net::Endpoint to_;
};

}  // namespace eyepoint::tools
