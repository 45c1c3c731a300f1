#include "tools/bench/eyes.hpp"

#include "config/settings.hpp"
#include "net/pcap_file.hpp"
#include "terrain/geodesy/geoid.hpp"
#include "tools/bench/planar_path.hpp"

namespace eyepoint::tools {

namespace {

tl::expected<std::vector<ig::FlightEye>, std::string> read_flight(const EyesRequest& request) {
    const auto recording = net::read_pcap(request.file);
    if (!recording) return tl::unexpected(recording.error());
    const auto port = ig::busiest_port(*recording);
    if (!port) {
        return tl::unexpected(request.file.string() +
                              " holds no UDP datagram; record one with eyepoint-replay");
    }
    const auto geoid = terrain::Geoid::load(terrain::Geoid::default_grid());
    if (!geoid) return tl::unexpected(geoid.error());
    ig::EyepointReading reading;
    reading.view.vertical_fov_deg = request.vertical_fov_deg;
    reading.altitude_datum =
        request.ellipsoid ? config::VerticalDatum::Ellipsoid : config::VerticalDatum::Msl;
    reading.geoid = &*geoid;
    auto eyes = ig::fly(*recording, *port, reading, request.size, request.rate_hz);
    if (!eyes) return tl::unexpected(request.file.string() + ": " + eyes.error());
    std::erase_if(*eyes, [&](const ig::FlightEye& eye) {
        return eye.time_s < request.from_s || eye.time_s > request.until_s;
    });
    if (eyes->empty()) return tl::unexpected(std::string{"nothing is flown between --from and --until"});
    return eyes;
}

}  // namespace

tl::expected<std::vector<ig::FlightEye>, std::string> read_eyes(const EyesRequest& request) {
    if (request.file.extension() == ".csv")
        return read_planar_path(request.file, kRainierField, request.size, request.vertical_fov_deg);
    return read_flight(request);
}

}  // namespace eyepoint::tools
