/// Ways of drawing a frame that a scene can be told.
#pragma once

#include <cstdint>

namespace eyepoint::ig {

/// Where the terrain's shader runs.
enum class Shading : std::uint8_t {
    Forward,   ///< while triangles are drawn: at every pixel a triangle covers, hidden later or not
    Deferred,  ///< after them, once a pixel; a cheap pass draws the triangles
    Automatic  ///< the faster of the two on this machine, measured at the first view
};

/// What is shown.
enum class Show : std::uint8_t {
    Terrain,
    Wireframe,  ///< the triangles' edges, hidden ones left out
    Levels      ///< a colour for every mesh: hue by its level, brightness by its tile's depth
};

}  // namespace eyepoint::ig
