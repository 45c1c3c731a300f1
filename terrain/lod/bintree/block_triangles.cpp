#include "terrain/lod/bintree/block_triangles.hpp"

namespace eyepoint::terrain::bintree {

namespace {

std::uint16_t number(Post post) { return static_cast<std::uint16_t>(post.row * kBlockPosts + post.column); }

BlockTriangles make(Diagonal diagonal) {
    BlockTriangles triangles{};
    for (Code code = kRootA; code < kCodesEnd; ++code) {
        const Corners at = corners(code, diagonal, kBlockCells);
        triangles[code] = {number(at.apex), number(at.left), number(at.right), number(middle(at))};
    }
    return triangles;
}

}  // namespace

const BlockTriangles& block_triangles(Diagonal diagonal) {
    static const BlockTriangles rising = make(Diagonal::Rising), falling = make(Diagonal::Falling);
    return diagonal == Diagonal::Rising ? rising : falling;
}

}  // namespace eyepoint::terrain::bintree
