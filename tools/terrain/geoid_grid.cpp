/// Rewrites the EGM96 grid of Debian's proj-data (GTX: big-endian floats, rows from south, columns from 180
/// W) in the PGM form that GeographicLib reads (16-bit, big-endian, rows from north, columns from 0 E; height
/// = offset + scale * sample). Run while Eyepoint is built: geoid-grid egm96_15.gtx egm96-15.pgm
#include <bit>
#include <cmath>
#include <cstdint>
#include <fstream>
#include <iostream>
#include <iterator>
#include <optional>
#include <string>
#include <vector>

namespace {

constexpr double kOffsetM = -108.0;
constexpr double kScaleM = 0.003;
constexpr std::size_t kRows = 721;
constexpr std::size_t kColumns = 1440;
constexpr std::size_t kHeaderBytes = 40;

std::uint32_t big_endian(const std::vector<char>& bytes, std::size_t offset) {
    std::uint32_t number = 0;
    for (std::size_t i = 0; i < 4; ++i) number = (number << 8) | static_cast<std::uint8_t>(bytes[offset + i]);
    return number;
}

std::optional<std::vector<char>> read_gtx(const std::string& path) {
    std::ifstream file{path, std::ios::binary};
    std::vector<char> bytes{std::istreambuf_iterator<char>{file}, {}};
    const bool whole = bytes.size() == kHeaderBytes + kRows * kColumns * 4 &&
                       big_endian(bytes, 32) == kRows && big_endian(bytes, 36) == kColumns;
    if (whole) return bytes;
    return std::nullopt;
}

std::string to_pgm(const std::vector<char>& gtx) {
    std::string pgm =
        "P5\n# Geoid file in PGM format for the GeographicLib::Geoid class\n# Description WGS84 EGM96, "
        "15-minute grid\n"
        "# Provenance egm96_15.gtx of Debian's proj-data, in steps of 0.003 m\n# Offset -108\n# Scale 0.003\n"
        "# Origin 90N 0E\n# AREA_OR_POINT Point\n# Vertical_Datum WGS84\n1440    721\n65535\n";
    for (std::size_t row = 0; row < kRows; ++row) {
        for (std::size_t column = 0; column < kColumns; ++column) {
            const std::size_t post = (kRows - 1 - row) * kColumns + (column + kColumns / 2) % kColumns;
            const auto height_m = std::bit_cast<float>(big_endian(gtx, kHeaderBytes + 4 * post));
            const auto sample = static_cast<std::uint16_t>(std::lrint((height_m - kOffsetM) / kScaleM));
            pgm.push_back(static_cast<char>(sample >> 8));
            pgm.push_back(static_cast<char>(sample & 0xFF));
        }
    }
    return pgm;
}

}  // namespace

int main(int argc, char** argv) {
    if (argc != 3) {
        std::cerr << "usage: geoid-grid egm96_15.gtx egm96-15.pgm\n";
        return 1;
    }
    const auto gtx = read_gtx(argv[1]);
    if (!gtx) {
        std::cerr << argv[1] << ": is not the 15-minute EGM96 grid; install Debian's proj-data\n";
        return 1;
    }
    const std::string pgm = to_pgm(*gtx);
    std::ofstream file{argv[2], std::ios::binary};
    file.write(pgm.data(), static_cast<std::streamsize>(pgm.size()));
    if (!file.flush()) {
        std::cerr << argv[2] << ": cannot be written\n";
        return 1;
    }
    return 0;
}
