#include "tools/terrain/mosaic_distance.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace eyepoint::tools {

namespace {

/// Larger than any squared distance in a grid, small enough to be added to.
constexpr float kFar = 1e12F;

/// One pass of the transform along a line: the lower envelope of parabolas rooted at the samples.
class Envelope {
  public:
    explicit Envelope(std::size_t longest) : root_(longest), from_(longest + 1) {}

    /// squared[i] becomes the least of (i - j)^2 + squared[j].
    void apply(std::vector<float>& squared) {
        const int count = static_cast<int>(squared.size());
        int last = -1;
        for (int at = 0; at < count; ++at) {
            const double value = squared[static_cast<std::size_t>(at)];
            if (value >= kFar) continue;
            double start = -std::numeric_limits<double>::infinity();
            while (last >= 0) {
                const int root = root_[static_cast<std::size_t>(last)];
                const double root_value = squared[static_cast<std::size_t>(root)];
                start =
                    (value + static_cast<double>(at) * at - root_value - static_cast<double>(root) * root) /
                    (2.0 * (at - root));
                if (start > from_[static_cast<std::size_t>(last)]) break;
                --last;
                start = -std::numeric_limits<double>::infinity();
            }
            ++last;
            root_[static_cast<std::size_t>(last)] = at;
            from_[static_cast<std::size_t>(last)] = start;
        }
        if (last < 0) return;
        from_[static_cast<std::size_t>(last) + 1] = std::numeric_limits<double>::infinity();
        source_ = squared;
        for (int at = 0, parabola = 0; at < count; ++at) {
            while (from_[static_cast<std::size_t>(parabola) + 1] < at) ++parabola;
            const int root = root_[static_cast<std::size_t>(parabola)];
            const auto away = static_cast<float>(at - root);
            squared[static_cast<std::size_t>(at)] = away * away + source_[static_cast<std::size_t>(root)];
        }
    }

  private:
    std::vector<int> root_;
    std::vector<double> from_;
    std::vector<float> source_;
};

}  // namespace

std::vector<float> distance_to_sites(std::span<const std::uint8_t> sites, int columns, int rows) {
    const auto width = static_cast<std::size_t>(columns);
    const auto height = static_cast<std::size_t>(rows);
    std::vector<float> distance(sites.size());
    std::transform(sites.begin(), sites.end(), distance.begin(),
                   [](std::uint8_t site) { return site ? 0.0F : kFar; });
    Envelope envelope{std::max(width, height)};
    std::vector<float> line(height);
    for (std::size_t column = 0; column < width; ++column) {
        for (std::size_t row = 0; row < height; ++row) line[row] = distance[row * width + column];
        envelope.apply(line);
        for (std::size_t row = 0; row < height; ++row) distance[row * width + column] = line[row];
    }
    line.resize(width);
    for (std::size_t row = 0; row < height; ++row) {
        const auto begin = distance.begin() + static_cast<std::ptrdiff_t>(row * width);
        std::copy_n(begin, width, line.begin());
        envelope.apply(line);
        std::copy(line.begin(), line.end(), begin);
    }
    for (float& squared : distance) squared = std::sqrt(squared);
    return distance;
}

EdgeWeights::EdgeWeights(int columns, int rows, int margin, const std::function<bool(int, int)>& covered) {
    const int pad = margin + 2;
    const int padded_columns = columns + 2 * pad;
    const int padded_rows = rows + 2 * pad;
    std::vector<std::uint8_t> bare(static_cast<std::size_t>(padded_columns) *
                                   static_cast<std::size_t>(padded_rows));
    std::size_t post = 0;
    for (int row = -pad; row < rows + pad; ++row) {
        for (int column = -pad; column < columns + pad; ++column) bare[post++] = covered(column, row) ? 0 : 1;
    }
    if (std::find(bare.begin(), bare.end(), std::uint8_t{1}) == bare.end()) return;
    const std::vector<float> distance = distance_to_sites(bare, padded_columns, padded_rows);
    weights_.reserve(static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows));
    for (int row = 0; row < rows; ++row) {
        for (int column = 0; column < columns; ++column) {
            const std::size_t padded =
                static_cast<std::size_t>(row + pad) * static_cast<std::size_t>(padded_columns) +
                static_cast<std::size_t>(column + pad);
            const float inside =
                std::clamp((distance[padded] - 1.0F) / static_cast<float>(margin), 0.0F, 1.0F);
            const float weight = inside * inside * (3.0F - 2.0F * inside);
            weights_.push_back(static_cast<std::uint16_t>(std::lround(weight * 65535.0F)));
        }
    }
}

}  // namespace eyepoint::tools
