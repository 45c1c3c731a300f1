#include "tools/replay/convert.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "net/pcap_file.hpp"

namespace eyepoint::tools {
namespace {

// A sample as a datagram; `origin_s` is the time of the first fix.
net::CapturedDatagram datagram_of(const FlightSample& sample, double origin_s, std::uint16_t port) {
    constexpr double kNanosecondsPerSecond = 1.0e9;
    net::CapturedDatagram datagram;
    const double whole_s = std::floor(origin_s);
    datagram.time_ns = static_cast<std::int64_t>(whole_s) * 1'000'000'000 +
                       std::llround((origin_s - whole_s + sample.time_s) * kNanosecondsPerSecond);
    datagram.source_port = port;
    datagram.destination_port = port;
    const auto bytes = net::wire::encode_fgnetfdm24(sample.fdm);
    datagram.payload.assign(bytes.begin(), bytes.end());
    return datagram;
}

// About a day at 30 a second, and 2 GB of memory on the way.
constexpr double kMostPackets = 3.0e6;

double packets_of(const Track& track, const FlightSampling& sampling) {
    const double duration_s = track.fixes.back().time_s - track.fixes.front().time_s;
    return (std::min(duration_s, sampling.until_s) - sampling.from_s) * sampling.rate_hz;
}

// Offsets that bring a flight out of every protocol's range would make packets that nobody takes.
bool within_reach(const std::vector<FlightSample>& samples) {
    return std::all_of(samples.begin(), samples.end(), [](const FlightSample& sample) {
        return sample.fdm.altitude_m >= net::wire::kLowestAltitudeM &&
               sample.fdm.altitude_m <= net::wire::kHighestAltitudeM;
    });
}

}  // namespace

tl::expected<ConvertReport, std::string> convert(const ConvertRequest& request) {
    const auto track = read_track(request.track, request.altitude);
    if (!track) return tl::unexpected(track.error());
    if (const double packets = packets_of(*track, request.sampling); packets > kMostPackets) {
        return tl::unexpected(
            fmt::format("{}: {:.0f} packets are more than {:.0f}: choose a part with --from and "
                        "--until, or a lower --rate",
                        request.track.string(), packets, kMostPackets));
    }
    const auto samples = sample_flight(*track, request.sampling);
    if (samples.empty()) {
        return tl::unexpected(fmt::format("{}: nothing lies between --from {} and --until {} seconds",
                                          request.track.string(), request.sampling.from_s,
                                          request.sampling.until_s));
    }
    if (!within_reach(samples)) {
        return tl::unexpected(fmt::format("{}: altitudes with --altitude-offset {} leave {} to {} m",
                                          request.track.string(), request.sampling.altitude_offset_m,
                                          net::wire::kLowestAltitudeM, net::wire::kHighestAltitudeM));
    }
    auto writer = net::PcapWriter::create(request.output);
    if (!writer) return tl::unexpected(writer.error());
    const double origin_s =
        track->start_utc_s ? static_cast<double>(*track->start_utc_s) + track->fixes.front().time_s : 0.0;
    for (const FlightSample& sample : samples) {
        if (auto written = writer->write(datagram_of(sample, origin_s, request.port)); !written) {
            return tl::unexpected(std::move(written.error()));
        }
    }
    return writer->finish().map([&] {
        return ConvertReport{track->fixes.size(), track->skipped, samples.size(),
                             samples.back().time_s - samples.front().time_s, track->altitude_source};
    });
}

}  // namespace eyepoint::tools
