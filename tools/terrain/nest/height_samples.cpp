#include "tools/terrain/nest/height_samples.hpp"

#include <algorithm>
#include <cmath>

namespace eyepoint::tools {

namespace {

/// Every second sample; what the left out ones deviate from the middle of their neighbours goes to those, or,
/// where it is more than `most_between_m`, they become lone ones.
HeightSamples thinned(const HeightSamples& fine, float most_between_m) {
    HeightSamples coarse;
    coarse.side = (fine.side + 1) / 2;
    coarse.heights_m.resize(static_cast<std::size_t>(coarse.side) * static_cast<std::size_t>(coarse.side));
    coarse.between_m.assign(coarse.heights_m.size(), 0.0F);
    for (int row = 0; row < fine.side; ++row) {
        for (int column = 0; column < fine.side; ++column) {
            const int odd_row = row & 1, odd_column = column & 1;
            const std::size_t low = coarse.at(row / 2, column / 2);
            const std::size_t high = coarse.at((row + 1) / 2, (column + 1) / 2);
            const float height_m = fine.heights_m[fine.at(row, column)];
            float apart_m = fine.between_m[fine.at(row, column)];
            if (odd_row == 0 && odd_column == 0) {
                coarse.heights_m[low] = height_m;
            } else {
                const float middle_m = (fine.heights_m[fine.at(row - odd_row, column - odd_column)] +
                                        fine.heights_m[fine.at(row + odd_row, column + odd_column)]) /
                                       2.0F;
                apart_m += std::abs(height_m - middle_m);
                if (apart_m > most_between_m) {
                    coarse.lone.push_back({column / 2.0, row / 2.0, height_m});
                    continue;
                }
            }
            coarse.between_m[low] = std::max(coarse.between_m[low], apart_m);
            coarse.between_m[high] = std::max(coarse.between_m[high], apart_m);
        }
    }
    for (const LoneSample& sample : fine.lone) {
        const LoneSample place{sample.x / 2.0, sample.y / 2.0, sample.height_m};
        const auto row = static_cast<int>(std::min(place.y, coarse.side - 2.0));
        const auto column = static_cast<int>(std::min(place.x, coarse.side - 2.0));
        const auto height_m = [&](int r, int c) { return coarse.heights_m[coarse.at(r, c)]; };
        const auto [low, high] = std::minmax({height_m(row, column), height_m(row, column + 1),
                                              height_m(row + 1, column), height_m(row + 1, column + 1)});
        const float apart_m = std::max(high - sample.height_m, sample.height_m - low);
        if (apart_m > most_between_m) {
            coarse.lone.push_back(place);
            continue;
        }
        for (const std::size_t at : {coarse.at(row, column), coarse.at(row, column + 1),
                                     coarse.at(row + 1, column), coarse.at(row + 1, column + 1)})
            coarse.between_m[at] = std::max(coarse.between_m[at], apart_m);
    }
    return coarse;
}

/// Every sample and, between two, their middle.
HeightSamples doubled(const HeightSamples& coarse) {
    HeightSamples fine;
    fine.side = coarse.side * 2 - 1;
    for (int row = 0; row < fine.side; ++row) {
        for (int column = 0; column < fine.side; ++column) {
            const std::size_t low = coarse.at(row / 2, column / 2);
            const std::size_t high = coarse.at((row + 1) / 2, (column + 1) / 2);
            fine.heights_m.push_back((coarse.heights_m[low] + coarse.heights_m[high]) / 2.0F);
            fine.between_m.push_back(std::max(coarse.between_m[low], coarse.between_m[high]));
        }
    }
    for (const LoneSample& sample : coarse.lone)
        fine.lone.push_back({sample.x * 2.0, sample.y * 2.0, sample.height_m});
    return fine;
}

}  // namespace

HeightSamples HeightSamples::join(const std::array<HeightSamples, 4>& children, float most_between_m) {
    int part_side = 0;
    for (const HeightSamples& child : children) part_side = std::max(part_side, child.side);
    HeightSamples whole;
    whole.side = part_side * 2 - 1;
    whole.heights_m.resize(static_cast<std::size_t>(whole.side) * static_cast<std::size_t>(whole.side));
    whole.between_m.assign(whole.heights_m.size(), 0.0F);
    for (int quadrant = 0; quadrant < 4; ++quadrant) {
        HeightSamples part = children[static_cast<std::size_t>(quadrant)];
        while (part.side < part_side) part = doubled(part);
        const int south = quadrant / 2 * (part_side - 1), west = quadrant % 2 * (part_side - 1);
        for (int row = 0; row < part_side; ++row) {
            for (int column = 0; column < part_side; ++column) {
                const std::size_t to = whole.at(south + row, west + column), from = part.at(row, column);
                whole.heights_m[to] = part.heights_m[from];
                whole.between_m[to] = std::max(whole.between_m[to], part.between_m[from]);
            }
        }
        for (const LoneSample& sample : part.lone)
            whole.lone.push_back({sample.x + west, sample.y + south, sample.height_m});
    }
    return whole.side > kMostSamples ? thinned(whole, most_between_m) : whole;
}

}  // namespace eyepoint::tools
