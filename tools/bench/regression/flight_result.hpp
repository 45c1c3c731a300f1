/// What a bench's flight came to, as a file that another run can be compared with (docs/regression.md).
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include <tl/expected.hpp>

#include "ig/gl_identity.hpp"
#include "ig/picture.hpp"

namespace eyepoint::tools {

/// What was flown, how, and on what.
struct FlightIdentity {
    std::string program;  ///< version
    std::string machine;  ///< processor and number of cores
    ig::GlIdentity gl;
    std::string flight;       ///< name of the recording's file
    std::string flight_hash;  ///< XXH3 of its bytes
    std::string terrain;      ///< name of the database
    ig::PictureSize size;
    double rate_hz = 0.0;
    double vertical_fov_deg = 0.0;
    double tau_px = 0.0;
    std::string lod_method;
    std::string shading;
    bool streaming = false;  ///< frames did not wait for loads: counts and pictures depend on the machine
};

struct FlightResult {
    FlightIdentity identity;
    std::size_t frames = 0;
    /// By key (docs/regression.md), `frames` long; NaN where a frame does not say.
    std::map<std::string, std::vector<double>> columns;
    std::vector<std::string> picture_hashes;  ///< one a frame, 16 hexadecimal digits; or empty
    /// Of the run as a whole: figures with one value.
    std::map<std::string, double> figures;

    /// nullptr where there is no such column.
    [[nodiscard]] const std::vector<double>* find(const std::string& key) const;
};

/// Columns that are the same in every run of the same program: counts and places. The others are times.
[[nodiscard]] bool is_timing(const std::string& key);

/// The result without what differs from run to run or from machine to machine: times, and the bits of
/// pictures, which llvmpipe's code for another processor rounds otherwise.
[[nodiscard]] FlightResult counts_of(FlightResult result);

/// A line a column.
[[nodiscard]] std::string to_json_text(const FlightResult& result);
/// On failure (not JSON, not a flight result, of another version, columns of different lengths): one
/// sentence.
[[nodiscard]] tl::expected<FlightResult, std::string> parse_flight_result(const std::string& text);
/// The same of a file; sentences name it.
[[nodiscard]] tl::expected<FlightResult, std::string> read_flight_result(const std::filesystem::path& file);

}  // namespace eyepoint::tools
