// eyepoint-replay: play, record, convert and describe recorded flights.
#include <cstdio>
#include <map>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "tools/replay/convert.hpp"
#include "tools/replay/info.hpp"
#include "tools/replay/play.hpp"
#include "tools/replay/record.hpp"

namespace {

using namespace eyepoint::tools;

// A line to print, or an error: what every command comes to.
using Outcome = tl::expected<std::string, std::string>;

double rate_of(std::uint64_t packets, double seconds) {
    return seconds > 0.0 && packets > 1 ? static_cast<double>(packets - 1) / seconds : 0.0;
}

Outcome run_play(const PlayRequest& request) {
    const StopSignal stop;
    return play(request, stop).map([&](const PlayReport& report) {
        std::string line = fmt::format(
            "sent {} packets in {:.2f} s ({:.1f} a second) to {}, at most {:.1f} ms late", report.packets,
            report.seconds, rate_of(report.packets, report.seconds), request.to, report.latest_ms);
        if (report.send_errors > 0) line += fmt::format(", {} could not be sent", report.send_errors);
        return line + (report.stopped ? ", stopped\n" : "\n");
    });
}

Outcome run_record(const RecordRequest& request) {
    const StopSignal stop;
    return record(request, stop).map([&](const RecordReport& report) {
        return fmt::format("recorded {} packets in {:.2f} s ({:.1f} a second) from port {} to {}\n",
                           report.packets, report.seconds, rate_of(report.packets, report.seconds),
                           request.port, request.file.string());
    });
}

Outcome run_convert(const ConvertRequest& request) {
    return convert(request).map([&](const ConvertReport& report) {
        return fmt::format(
            "wrote {} packets, {:.1f} s at {} a second, from {} fixes ({} skipped), altitudes from {}, "
            "to {}\n",
            report.packets, report.seconds, request.sampling.rate_hz, report.fixes, report.skipped,
            report.altitude_source, request.output.string());
    });
}

void add_span(CLI::App& command, double& from_s, double& until_s, const std::string& origin) {
    command.add_option("--from", from_s, "Begin so many seconds after " + origin)
        ->check(CLI::NonNegativeNumber);
    command.add_option("--until", until_s, "End so many seconds after " + origin)
        ->check(CLI::NonNegativeNumber);
}

void add_play(CLI::App& app, PlayRequest& request) {
    auto* command =
        app.add_subcommand("play", "Send a recorded flight over UDP, at the times it was recorded at");
    command->add_option("flight", request.file, "pcap or pcapng file")->required();
    command->add_option("--to", request.to, "HOST:PORT to send to")->required();
    command->add_option("--rate", request.rate, "Speed: 2 is twice as fast")
        ->check(CLI::Range(0.001, 1000.0));
    command->add_option("--port", request.port,
                        "Send what was captured on its way to this port (default: the port with "
                        "the most datagrams of a host)");
    command->add_flag("--loop", request.loop, "Begin again at the end, until Ctrl-C");
    add_span(*command, request.from_s, request.until_s, "the first datagram");
}

void add_record(CLI::App& app, RecordRequest& request) {
    auto* command =
        app.add_subcommand("record", "Write what arrives at a UDP port into a pcap file, until Ctrl-C");
    command->add_option("--port", request.port, "UDP port to listen on")
        ->required()
        ->check(CLI::Range(1, 65535));
    command->add_option("--address", request.address, "Numeric IPv4 address to listen on")
        ->check(CLI::ValidIPV4);
    command->add_option("-o,--output", request.file, "pcap file to write")->required();
    command->add_option("--for", request.for_s, "End after so many seconds")->check(CLI::PositiveNumber);
}

void add_convert(CLI::App& app, ConvertRequest& request) {
    static const std::map<std::string, IgcAltitude> kAltitudes{
        {"auto", IgcAltitude::Automatic}, {"gnss", IgcAltitude::Gnss}, {"pressure", IgcAltitude::Pressure}};
    auto* command =
        app.add_subcommand("convert", "Turn a track log into a recorded flight (FGNetFDM version 24)");
    command
        ->add_option("track", request.track,
                     ".igc, .gpx or .csv (header: time_s,latitude_deg,longitude_deg,"
                     "altitude_m[,yaw_deg,pitch_deg,roll_deg])")
        ->required();
    command->add_option("-o,--output", request.output, "pcap file to write")->required();
    command->add_option("--rate", request.sampling.rate_hz, "Packets a second")
        ->check(CLI::Range(0.1, 1000.0));
    command
        ->add_option("--altitude", request.altitude, "Which altitude of an IGC log: auto, gnss or pressure")
        ->transform(CLI::CheckedTransformer(kAltitudes).description(""));
    command->add_option(
        "--altitude-offset", request.sampling.altitude_offset_m,
        "Metres added to every altitude. Altitudes are written as the log has them; where they are "
        "ellipsoidal and the image generator expects mean sea level, give minus the geoid's height "
        "there (about -51 in the Alps)");
    command->add_option("--port", request.port, "Destination port of the packets")
        ->check(CLI::Range(1, 65535));
    add_span(*command, request.sampling.from_s, request.sampling.until_s, "the first fix");
}

int report(const Outcome& outcome) {
    if (outcome) {
        fmt::print("{}", *outcome);
        return 0;
    }
    fmt::print(stderr, "eyepoint-replay: {}\n", outcome.error());
    return 1;
}

}  // namespace

int main(int argc, char** argv) {
    CLI::App app{
        "Play, record, convert and describe recorded flights: pcap files of the UDP packets of a flight "
        "simulator"};
    app.name("eyepoint-replay");
    app.require_subcommand(1);
    app.footer(
        "Examples:\n"
        "  eyepoint-replay info flight.pcap\n"
        "  eyepoint-replay play flight.pcap --to 127.0.0.1:5560 --from 10 --until 40\n"
        "  eyepoint-replay record --port 5560 -o flight.pcap --for 60\n"
        "  eyepoint-replay convert glider.igc -o glider.pcap --rate 60 --altitude-offset -51");
    PlayRequest play_request;
    RecordRequest record_request;
    ConvertRequest convert_request;
    std::filesystem::path info_file;
    add_play(app, play_request);
    add_record(app, record_request);
    add_convert(app, convert_request);
    auto* info =
        app.add_subcommand("info", "Describe a recorded flight: ports, protocol, rate, bounds, drops");
    info->add_option("flight", info_file, "pcap or pcapng file")->required();
    try {
        app.parse(argc, argv);
    } catch (const CLI::ParseError& error) {
        if (error.get_exit_code() == 0) return app.exit(error);
        return report(tl::unexpected(fmt::format("{} (see --help)", error.what())));
    }
    if (app.got_subcommand("play")) return report(run_play(play_request));
    if (app.got_subcommand("record")) return report(run_record(record_request));
    if (app.got_subcommand("convert")) return report(run_convert(convert_request));
    return report(describe_flight(info_file));
}
