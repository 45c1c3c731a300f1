#include "tools/bench/measure/triangle_bins.hpp"

#include <algorithm>
#include <cmath>

#include <glm/common.hpp>

namespace eyepoint::tools {

namespace {

struct Box {
    HalfTurns low{0.0}, high{0.0};
};

struct Pair {
    std::uint32_t tile = 0;
    std::uint32_t triangle = 0;
};

constexpr double kPi = 3.14159265358979323846;

/// A chord bends towards the pole when it is drawn on latitude and longitude: by at most this, half turns, at
/// a greatest latitude and over a difference of longitude. The vertex of the great circle: tan(bent) =
/// tan(latitude) / cos(half the difference).
double bend(double latitude_rad, double longitude_difference_rad) {
    const double cosine = std::cos(std::min(longitude_difference_rad, kPi) / 2.0);
    return std::max(std::atan2(std::sin(latitude_rad), cosine * std::cos(latitude_rad)) - latitude_rad, 0.0) /
           kPi;
}

Box around(const DrawnMesh& mesh, const MeshTriangle& triangle) {
    const HalfTurns &a = mesh.vertices[triangle.vertices[0]].place,
                    &b = mesh.vertices[triangle.vertices[1]].place,
                    &c = mesh.vertices[triangle.vertices[2]].place;
    Box box{glm::min(a, glm::min(b, c)), glm::max(a, glm::max(b, c))};
    const HalfTurns size = box.high - box.low;
    // Rounding of vertices and of the map: two metres, and a share of the triangle.
    constexpr double kTwoMetres = 1e-7, kShare = 0.01;
    HalfTurns margin = size * kShare + kTwoMetres;
    const double polemost_rad = std::max(std::abs(box.low.y - 0.5), std::abs(box.high.y - 0.5)) * kPi;
    constexpr double kSmall = 1e-4;  // bends by less than two metres
    if (size.x > kSmall) margin.y += bend(std::min(polemost_rad, kPi / 2.0), size.x * kPi);
    margin.x /= std::max(std::cos(polemost_rad), 1e-3);
    return {box.low - margin, box.high + margin};
}

class Binning {
  public:
    Binning(const FullSurface& surface, const DrawnMesh& mesh) : surface_(surface), mesh_(mesh) {}

    [[nodiscard]] std::vector<Pair> run() {
        for (const MeshPart& part : mesh_.parts) {
            const std::size_t node = surface_.node_of(part.tile);
            for (std::size_t i = part.first_triangle; i < part.end_triangle; ++i) {
                triangle_ = static_cast<std::uint32_t>(i);
                if (!is_empty(mesh_, mesh_.triangles[i])) add(around(mesh_, mesh_.triangles[i]), node);
            }
        }
        return std::move(pairs_);
    }

  private:
    void add(const Box& box, std::size_t node) {
        const auto nodes = surface_.nodes();
        while (nodes[node].parent >= 0 && !holds(nodes[node], box))
            node = static_cast<std::size_t>(nodes[node].parent);
        if (holds(nodes[node], box)) {
            descend(box, node);
            return;
        }
        for (const double turn : {-2.0, 0.0, 2.0}) {
            const HalfTurns shift{turn, 0.0};
            for (std::size_t root = 0; root < 2; ++root) descend({box.low + shift, box.high + shift}, root);
        }
    }

    [[nodiscard]] static Box extent_of(const FullSurface::Node& node) {
        const double side = 1.0 / static_cast<double>(std::uint64_t{1} << node.tile.depth);
        const HalfTurns corner = HalfTurns{node.tile.x, node.tile.y} * side;
        return {corner, corner + side};
    }
    [[nodiscard]] static bool holds(const FullSurface::Node& node, const Box& box) {
        const Box area = extent_of(node);
        return box.low.x >= area.low.x && box.low.y >= area.low.y && box.high.x <= area.high.x &&
               box.high.y <= area.high.y;
    }

    void descend(const Box& box, std::size_t index) {
        const FullSurface::Node& node = surface_.nodes()[index];
        if (!surface_.seen(node)) return;
        const Box area = extent_of(node);
        if (box.low.x > area.high.x || box.high.x < area.low.x || box.low.y > area.high.y ||
            box.high.y < area.low.y)
            return;
        if (node.first_child < 0) {
            pairs_.push_back({static_cast<std::uint32_t>(node.slot), triangle_});
            return;
        }
        for (std::size_t i = 0; i < 4; ++i) descend(box, static_cast<std::size_t>(node.first_child) + i);
    }

    const FullSurface& surface_;
    const DrawnMesh& mesh_;
    std::uint32_t triangle_ = 0;
    std::vector<Pair> pairs_;
};

}  // namespace

TriangleBins::TriangleBins(const FullSurface& surface, const DrawnMesh& mesh, std::size_t tiles)
    : first_(tiles + 1, 0) {
    const std::vector<Pair> pairs = Binning(surface, mesh).run();
    for (const Pair& pair : pairs) ++first_[pair.tile + 1];
    for (std::size_t i = 0; i < tiles; ++i) first_[i + 1] += first_[i];
    triangles_.resize(pairs.size());
    std::vector<std::size_t> next(first_.begin(), first_.end() - 1);
    for (const Pair& pair : pairs) triangles_[next[pair.tile]++] = pair.triangle;
}

}  // namespace eyepoint::tools
