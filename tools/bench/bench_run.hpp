/// Drawing a row of eyes in virtual time and saying what it took.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include <tl/expected.hpp>

#include "ig/frame_record.hpp"
#include "ig/picture.hpp"
#include "ig/recorded_flight.hpp"
#include "ig/scene.hpp"

namespace eyepoint::tools {

struct BenchOptions {
    std::filesystem::path terrain;
    ig::PictureSize size{1280, 720};
    ig::SceneOptions scene;
    /// Load everything a frame asks for before it is drawn (not timed): the same pictures on every machine.
    bool complete = true;
    std::optional<std::filesystem::path> pictures;  ///< folder; none: no pictures
    std::uint64_t picture_every = 1;                ///< frames
    std::optional<std::filesystem::path> record;    ///< frame record; none: no record
};

struct BenchResult {
    std::string gl_renderer;
    std::string gl_version;
    std::vector<ig::FrameEntry> frames;
    double wall_s = 0.0;  ///< of drawing alone, loads and pictures left out
    std::uint64_t peak_resident_bytes = 0;
};

/// Draws every eye once, each frame waited for by a fence. On failure: one sentence.
[[nodiscard]] tl::expected<BenchResult, std::string> run_bench(const BenchOptions& options,
                                                               const std::vector<ig::FlightEye>& eyes);

/// The figures as a table for people.
[[nodiscard]] std::string describe(const BenchResult& result);

}  // namespace eyepoint::tools
