#include "tests/picture/flights.hpp"

#include <cstdlib>
#include <stdexcept>

#include "net/pcap_file.hpp"
#include "terrain/geodesy/geoid.hpp"
#include "tests/picture/value_or_throw.hpp"

namespace eyepoint::testing {

namespace {}  // namespace

std::filesystem::path sample_flight() { return EYEPOINT_SOURCE_DIR "/tools/flights/goms-c172-60s-30hz.pcap"; }

std::shared_ptr<const terrain::Database> open_database(const std::filesystem::path& folder) {
    return std::make_shared<const terrain::Database>(value_or_throw(terrain::Database::open(folder)));
}

std::shared_ptr<const terrain::Database> open_synthetic_terrain() {
    return open_database(EYEPOINT_SYNTHETIC_TERRAIN);
}

std::optional<std::filesystem::path> real_data() {
    const char* folder = std::getenv("EYEPOINT_REAL_DATA");
    if (folder == nullptr || *folder == '\0') return std::nullopt;
    return folder;
}

std::vector<ig::FlightEye> eyes_of(const std::filesystem::path& flight, ig::PictureSize size,
                                   double rate_hz) {
    const auto geoid = value_or_throw(terrain::Geoid::load(terrain::Geoid::default_grid()));
    const auto recording = value_or_throw(net::read_pcap(flight));
    const auto port = ig::busiest_port(recording);
    if (!port) throw std::runtime_error(flight.string() + " holds no datagram");
    return value_or_throw(ig::fly(recording, *port, {{}, config::VerticalDatum::Msl, &geoid}, size, rate_hz));
}

}  // namespace eyepoint::testing
