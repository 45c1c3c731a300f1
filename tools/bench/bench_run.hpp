/// Drawing a row of eyes in virtual time and saying what it took.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <tl/expected.hpp>

#include "ig/frame_record.hpp"
#include "ig/picture.hpp"
#include "ig/recorded_flight.hpp"
#include "ig/scene.hpp"
#include "terrain/lod/lod_method.hpp"
#include "tools/bench/readback.hpp"

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
    std::optional<std::filesystem::path> trace;     ///< of where the time goes; none: no trace
    /// Of every so-manieth frame the triangles are drawn as one static mesh too; 0: of none.
    std::uint64_t still_every = 0;
    bool hash_pictures = false;
    /// Heap allocations of the calling thread so far; nullptr: not counted.
    std::uint64_t (*allocations)() = nullptr;
    /// Where set, makes the method; the one that the scene's options name is not looked at. For tests.
    std::function<std::unique_ptr<terrain::LodMethod>()> method;
};

/// A frame's record and what the bench alone can say of it.
struct BenchFrame {
    ig::FrameEntry entry;
    /// Wall time of the frame's thread from the frame's start until all was asked of OpenGL, without the time
    /// inside OpenGL: selection, taking over loads, lists of draws.
    double outside_gl_ms = 0.0;
    std::uint64_t gl_calls = 0;
    std::uint64_t allocations = 0;       ///< on the heap, by the frame's thread, drivers in C not included
    std::uint64_t new_state_pairs = 0;   ///< programs linked and pairs of program and state first drawn with
    std::optional<double> still_cpu_ms;  ///< process CPU of the same triangles as one static mesh
    std::optional<std::uint64_t> picture_hash;  ///< XXH3 of the rows from the top, red, green, blue, 255
};

struct BenchResult {
    ig::GlIdentity gl;
    ig::Shading shading = ig::Shading::Automatic;  ///< that was drawn with
    std::string terrain_name;
    std::vector<BenchFrame> frames;
    double wall_s = 0.0;                    ///< of drawing alone, loads and pictures left out
    std::uint64_t bare_resident_bytes = 0;  ///< with an OpenGL context and a picture, before any terrain
    std::uint64_t peak_resident_bytes = 0;
    ReadbackTimes readback;  ///< of the last frame
};

/// Draws every eye once, each frame waited for by a fence. Where loads are complete and the shading is not
/// automatic, equal eyes give equal frames: pictures, counts, allocations. On failure: one sentence.
[[nodiscard]] tl::expected<BenchResult, std::string> run_bench(const BenchOptions& options,
                                                               const std::vector<ig::FlightEye>& eyes);

/// The figures as a table for people.
[[nodiscard]] std::string describe(const BenchResult& result);

}  // namespace eyepoint::tools
