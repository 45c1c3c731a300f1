/// A bare ellipsoid with one raised feature of known corners.
#pragma once

#include <filesystem>
#include <memory>

#include "terrain/database/database.hpp"
#include "tests/picture/reference_camera.hpp"

namespace eyepoint::testing {

/// A pyramid on the posts of one depth of the tiling: its apex on a post, falling to height 0 so many rows of
/// posts north and south of it and columns east and west, with straight sides between those four corners.
/// With its apex on a pole it is a cone.
struct Spike {
    Place apex;          ///< latitude and longitude on a post: see on_post()
    unsigned depth = 9;  ///< of the tiles around it; posts are 180 / 2^depth / 32 degrees apart
    int half_height_rows = 1;
    int half_width_columns = 1;
};

/// The place itself where it is on a post of the depth (the equator, the antimeridian, a pole), else the
/// nearest post that is well inside its tile.
[[nodiscard]] Place on_post(const Place& place, unsigned depth);

/// Its outline in a picture from outside: the apex, and where the two sides that leave it end on the ground.
struct Outline {
    glm::dvec2 apex, one_end, other_end;
};
[[nodiscard]] Outline outline(const Spike& spike, const ReferenceCamera& camera);

/// Compiles it into a folder, which must not exist; sea level everywhere else. Throws std::runtime_error.
[[nodiscard]] std::shared_ptr<const terrain::Database> make_spike_database(
    const Spike& spike, const std::filesystem::path& folder);

}  // namespace eyepoint::testing
