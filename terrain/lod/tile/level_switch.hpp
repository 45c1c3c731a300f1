/// How tiles go from level to level: the clock that slides run by, and the queue that switches wait in.
/// Source: Larsen & Christensen, sections 2.3 (the three ways to time a morph) and 3 (the queue).
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "terrain/lod/lod_method.hpp"
#include "terrain/lod/tile/tile_options.hpp"
#include "terrain/lod/tile/tiled_block.hpp"

namespace eyepoint::terrain::tiles {

/// A slide is as long as the eye's way is this share of its distance from the tile. So what is drawn errs by
/// at most 1 / (1 - share) of the tolerance while a tile becomes finer, that the queue does not hold back.
inline constexpr double kSlideShare = 1.0 / 16.0;
/// By time: what Hoppe's geomorphs take, the paper says.
inline constexpr double kSlideSeconds = 1.0;
inline constexpr double kSlideFrames = 30.0;

/// What has passed between two views. A change of the tolerance or the field of view counts as the way that
/// would change errors in pixels as much.
class SlideClock {
  public:
    explicit SlideClock(MorphClock clock) : clock_(clock) {}

    void tick(const LodView& view);
    /// Of a slide, at this distance from the eye.
    [[nodiscard]] double progress(double distance_m) const;
    /// Whether the eye has jumped: a slide by distance would be over at once, and another may be due.
    [[nodiscard]] bool leapt(double distance_m) const { return way(distance_m) >= 1.0; }

  private:
    [[nodiscard]] double way(double distance_m) const;

    MorphClock clock_;
    LodView now_;
    bool ticking_ = false;
    double eye_m_ = 0.0, scale_ = 0.0, seconds_ = 0.0, frames_ = 0.0;
};

/// Moves every slide on: towards the finer level where that or a still finer one is wanted, else the coarser.
void slide_on(std::span<Tile* const> tiles, const SlideClock& clock);

/// Which tiles change to another level's mesh. They do where it looks the same: to the finer one slid all the
/// way, from the finer one when it has slid all the way. What becomes finer goes first, by its error; and no
/// tile goes before its neighbours are as fine as it is, or as coarse.
class SwitchQueue {
  public:
    /// Tiles change, `most` of them; those that stand still in time do not. Returns how many did.
    std::uint32_t run(std::span<Tile* const> tiles, const SlideClock& clock, std::uint32_t most);

  private:
    std::vector<Tile*> waiting_;
};

}  // namespace eyepoint::terrain::tiles
