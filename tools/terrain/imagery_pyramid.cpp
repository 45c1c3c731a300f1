#include "tools/terrain/imagery_pyramid.hpp"

#include <algorithm>
#include <cmath>

namespace eyepoint::tools {

namespace {

/// The texels of a level that one texel of the next lies over, along one axis, and how much of each.
struct Span {
    int first = 0;
    std::vector<float> shares;
};

std::vector<Span> spans(int above, int below) {
    std::vector<Span> result;
    const double size = static_cast<double>(above) / below;
    for (int i = 0; i < below; ++i) {
        const double begin = i * size;
        const double end = (i + 1) * size;
        Span span{static_cast<int>(begin), {}};
        for (int texel = span.first; texel < above && texel < end - 1e-9; ++texel) {
            span.shares.push_back(
                static_cast<float>(std::min(end, texel + 1.0) - std::max(begin, double(texel))));
        }
        result.push_back(std::move(span));
    }
    return result;
}

std::uint8_t rounded(float value) {
    return static_cast<std::uint8_t>(std::lround(std::clamp(value, 0.0F, 255.0F)));
}

}  // namespace

ImagePyramid::ImagePyramid(int columns, int rows, std::vector<std::uint8_t> rgba, bool wraps)
    : wraps_(wraps) {
    levels_.push_back({columns, rows, std::move(rgba)});
    while (levels_.back().columns > 1 || levels_.back().rows > 1) levels_.push_back(halved(levels_.back()));
}

ImagePyramid::Level ImagePyramid::halved(const Level& above) {
    Level below{std::max(1, above.columns / 2), std::max(1, above.rows / 2), {}};
    const std::vector<Span> across = spans(above.columns, below.columns);
    const std::vector<Span> down = spans(above.rows, below.rows);
    below.rgba.reserve(static_cast<std::size_t>(below.columns) * static_cast<std::size_t>(below.rows) * 4);
    for (const Span& row : down) {
        for (const Span& column : across) {
            std::array<float, 4> sum{};
            float area = 0.0F;
            for (std::size_t y = 0; y < row.shares.size(); ++y) {
                for (std::size_t x = 0; x < column.shares.size(); ++x) {
                    const auto texel =
                        (static_cast<std::size_t>(row.first) + y) * static_cast<std::size_t>(above.columns) +
                        static_cast<std::size_t>(column.first) + x;
                    const float share = row.shares[y] * column.shares[x];
                    const float weight = share * above.rgba[texel * 4 + 3];
                    for (std::size_t c = 0; c < 3; ++c) sum[c] += weight * above.rgba[texel * 4 + c];
                    sum[3] += weight;
                    area += share;
                }
            }
            for (std::size_t c = 0; c < 3; ++c)
                below.rgba.push_back(sum[3] > 0.0F ? rounded(sum[c] / sum[3]) : 0);
            below.rgba.push_back(rounded(sum[3] / area));
        }
    }
    return below;
}

Colour ImagePyramid::at(int level, double u, double v) const {
    const Level& picture = levels_[static_cast<std::size_t>(std::clamp(level, 0, levels() - 1))];
    const double x = u * picture.columns - 0.5;
    const double y = std::clamp(v * picture.rows - 0.5, 0.0, picture.rows - 1.0);
    const auto column = [&](int at) {
        if (wraps_) return ((at % picture.columns) + picture.columns) % picture.columns;
        return std::clamp(at, 0, picture.columns - 1);
    };
    const int left = static_cast<int>(std::floor(x));
    const int top = static_cast<int>(y);
    const auto dx = static_cast<float>(x - left);
    const auto dy = static_cast<float>(y - top);
    Colour result;
    for (int corner = 0; corner < 4; ++corner) {
        const int row = std::min(top + (corner >> 1), picture.rows - 1);
        const auto texel = static_cast<std::size_t>(row) * static_cast<std::size_t>(picture.columns) +
                           static_cast<std::size_t>(column(left + (corner & 1)));
        const std::uint8_t* rgba = &picture.rgba[texel * 4];
        const float weight = ((corner & 1) != 0 ? dx : 1.0F - dx) * ((corner & 2) != 0 ? dy : 1.0F - dy) *
                             static_cast<float>(rgba[3]) * (1.0F / 255.0F);
        for (std::size_t c = 0; c < 3; ++c) result.rgb[c] += weight * rgba[c];
        result.alpha += weight;
    }
    if (result.alpha <= 0.0F) return {};
    for (float& channel : result.rgb) channel /= result.alpha;
    return result;
}

}  // namespace eyepoint::tools
