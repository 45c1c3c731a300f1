/// Scenes that draw the same eyes by turns, in one process, so that what one costs over another holds on any
/// machine.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <tl/expected.hpp>

#include "ig/recorded_flight.hpp"
#include "ig/scene.hpp"

namespace eyepoint::tools {

/// One eye, drawn by one scene. CPU is of all threads of the process, milliseconds, the least of the
/// turns: what other programs do beside, on shared cores and caches, only adds to it.
struct TurnFrame {
    double cpu_ms = 0.0;
    double selection_ms = 0.0;             ///< of it: selection, by the thread's clock
    std::optional<double> floor_cpu_ms{};  ///< of Scene::draw_floor(), right after
    std::uint64_t triangles = 0;
    std::uint64_t triangles_hidden = 0;
    std::uint64_t pixels_changed = 0;  ///< that differ from the first scene's picture
};

struct TurnOptions {
    std::size_t turns = 7;  ///< that each scene draws an eye, after once that does not count
    bool floor = false;     ///< of the first scene
    bool pictures = false;  ///< compare them
};

/// By scene, then by eye. Everything is loaded and on the card before a frame counts; scenes change places
/// from turn to turn. Makes its own OpenGL context. On failure: one sentence.
[[nodiscard]] tl::expected<std::vector<std::vector<TurnFrame>>, std::string> draw_by_turns(
    const std::shared_ptr<const terrain::Database>& database, std::span<const ig::SceneOptions> scenes,
    std::span<const ig::FlightEye> eyes, ig::PictureSize size, const TurnOptions& options);

}  // namespace eyepoint::tools
