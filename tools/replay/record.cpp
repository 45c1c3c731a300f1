#include "tools/replay/record.hpp"

#include <chrono>
#include <vector>

#include <fmt/format.h>

#include "net/pcap_file.hpp"
#include "net/udp_socket.hpp"

namespace eyepoint::tools {
namespace {

constexpr std::size_t kBufferBytes = 65536;
constexpr std::chrono::milliseconds kWait{50};

// Where datagrams went to: the address listened on, or this machine when that is every address.
std::array<std::uint8_t, 4> destination_of(const RecordRequest& request) {
    constexpr std::array<std::uint8_t, 4> kAny{}, kThisMachine{127, 0, 0, 1};
    const auto local = net::local_endpoint(request.address, request.port);
    const auto address = local ? local->ipv4_bytes() : kAny;
    return address == kAny ? kThisMachine : address;
}

struct Batch {
    std::uint64_t packets = 0;
    std::int64_t first_ns = 0;
    std::int64_t last_ns = 0;
};

// Writes everything that waits.
tl::expected<Batch, std::string> drain(const net::UdpSocket& socket, net::PcapWriter& writer,
                                       net::CapturedDatagram& datagram, std::vector<std::byte>& buffer) {
    Batch batch;
    while (true) {
        const auto received = socket.receive(buffer);
        if (!received) return tl::unexpected(received.error());
        if (!*received) return batch;
        datagram.time_ns = (*received)->arrival.realtime_ns;
        datagram.source_address = (*received)->sender.ipv4_bytes();
        datagram.source_port = (*received)->sender.port();
        datagram.payload.assign(buffer.begin(),
                                buffer.begin() + static_cast<std::ptrdiff_t>((*received)->size));
        if (auto written = writer.write(datagram); !written)
            return tl::unexpected(std::move(written.error()));
        if (batch.packets++ == 0) batch.first_ns = datagram.time_ns;
        batch.last_ns = datagram.time_ns;
    }
}

}  // namespace

tl::expected<RecordReport, std::string> record(const RecordRequest& request, const StopSignal& stop) {
    const auto socket = net::UdpSocket::bind(request.address, request.port);
    if (!socket) return tl::unexpected(socket.error());
    auto writer = net::PcapWriter::create(request.file);
    if (!writer) return tl::unexpected(writer.error());

    RecordReport report;
    net::CapturedDatagram datagram;
    datagram.destination_address = destination_of(request);
    datagram.destination_port = request.port;
    std::vector<std::byte> buffer(kBufferBytes);
    std::int64_t first_ns = 0;
    const auto start = std::chrono::steady_clock::now();
    const auto over = [&] {
        return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count() >=
               request.for_s;
    };
    bool last_round = false;
    while (!last_round) {
        last_round = stop.came() || over();
        if (!last_round) static_cast<void>(socket->wait_readable(kWait));
        const auto batch = drain(*socket, *writer, datagram, buffer);
        if (!batch) return tl::unexpected(batch.error());
        if (batch->packets == 0) continue;
        if (report.packets == 0) first_ns = batch->first_ns;
        report.packets += batch->packets;
        report.seconds = static_cast<double>(batch->last_ns - first_ns) * 1.0e-9;
    }
    if (report.packets == 0) {
        return tl::unexpected(
            fmt::format("nothing came to UDP port {} on {}: check where the host sends to, and the "
                        "firewall",
                        request.port, request.address));
    }
    return writer->finish().map([&] { return report; });
}

}  // namespace eyepoint::tools
