#include "terrain/lod/tile/level_switch.hpp"

#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>

namespace eyepoint::terrain::tiles {

namespace {

bool refines(const Tile& tile) { return tile.wanted > tile.drawn.resolution && tile.slid == 0.0; }
bool coarsens(const Tile& tile) { return tile.wanted < tile.drawn.resolution && tile.slid == 1.0; }

bool neighbours_allow(const Tile& tile) {
    return std::all_of(tile.beside.begin(), tile.beside.end(), [&](const Tile* beside) {
        if (beside == nullptr) return true;
        return refines(tile) ? beside->drawn.resolution >= tile.drawn.resolution
                             : beside->drawn.resolution <= tile.drawn.resolution;
    });
}

void switch_level(Tile& tile) {
    if (refines(tile)) {
        tile.set(tile.drawn.resolution + 1, 1.0);
    } else {
        tile.set(tile.drawn.resolution - 1, 0.0);
    }
}

bool goes_before(const Tile* a, const Tile* b) {
    if (refines(*a) != refines(*b)) return refines(*a);
    return a->error_px > b->error_px;
}

}  // namespace

void SlideClock::tick(const LodView& view) {
    if (ticking_) {
        eye_m_ = glm::distance(view.eye, now_.eye);
        scale_ = std::abs(std::log(view.kappa_px / view.tau_px * now_.tau_px / now_.kappa_px));
        seconds_ = view.time_s - now_.time_s;
        frames_ = static_cast<double>(view.drawn_frame) - static_cast<double>(now_.drawn_frame);
    }
    ticking_ = true;
    now_ = view;
}

double SlideClock::way(double distance_m) const {
    return (eye_m_ / std::max(distance_m, now_.near_m) + scale_) / kSlideShare;
}

double SlideClock::progress(double distance_m) const {
    switch (clock_) {
        case MorphClock::Time:
            return std::max(seconds_ / kSlideSeconds, 0.0);
        case MorphClock::Frames:
            return std::max(frames_ / kSlideFrames, 0.0);
        case MorphClock::Distance:
            break;
    }
    return way(distance_m);
}

void slide_on(std::span<Tile* const> tiles, const SlideClock& clock) {
    for (Tile* tile : tiles) {
        const double progress = clock.progress(tile->distance_m);
        const double slid = tile->wanted >= tile->drawn.resolution ? std::max(tile->slid - progress, 0.0)
                                                                   : std::min(tile->slid + progress, 1.0);
        tile->set(tile->drawn.resolution, slid);
    }
}

std::uint32_t SwitchQueue::run(std::span<Tile* const> tiles, const SlideClock& clock, std::uint32_t most) {
    waiting_.clear();
    for (Tile* tile : tiles) {
        if ((refines(*tile) || coarsens(*tile)) && clock.progress(tile->distance_m) > 0.0)
            waiting_.push_back(tile);
    }
    std::sort(waiting_.begin(), waiting_.end(), goes_before);
    std::uint32_t switched = 0;
    for (Tile* tile : waiting_) {
        if (switched == most) break;
        if (!neighbours_allow(*tile)) continue;
        switch_level(*tile);
        ++switched;
    }
    return switched;
}

}  // namespace eyepoint::terrain::tiles
