// Where a vertex of a tile of a grid is drawn while the tile goes from one level to the next:
// terrain/lod/tile/tile_slide.hpp on the graphics card. What decides a position is `precise`, so that a vertex on an
// edge lands on the same bits from both sides.
layout(binding = 2) uniform usamplerBuffer vertex_words;  // all blocks' vertices, four words and four
// TileSlide by slot and part: level, slid << 8, stitched << 16; border's slides, west and east, south and north.
layout(std430, binding = 1) readonly buffer Slides { uvec4 slides[]; };

const int kPosts = 33, kCells = 32, kTileCells = kCells / TILE_PARTS;
const float kSlideStep = 1.0 / 128.0;

// In a tile: its slide, its block's slot, its south-west post in the block.
struct TilePlace {
    uvec4 slide;
    int slot;
    ivec2 origin;
};

Vertex stored(TilePlace tile, ivec2 at) {
    int texel = (tile.slot * kBlockVertices + at.y * kPosts + at.x) * 2;
    uvec4 a = texelFetch(vertex_words, texel), b = texelFetch(vertex_words, texel + 1);
    return unpack(uintBitsToFloat(a.xyz), uintBitsToFloat(uvec3(a.w, b.xy)), b.zw);
}

// Table 3: to the mean of two. Places in the tile stay: a post lies half-way between the two.
Vertex slid(Vertex from, Vertex a, Vertex b, uint steps) {
    precise float share = float(steps) * kSlideStep;
    precise vec3 middle = 0.5 * (a.from_eye + b.from_eye);
    precise vec3 from_eye = (1.0 - share) * from.from_eye + share * middle;
    return Vertex(from_eye, from.place, mix(from.height, 0.5 * (a.height + b.height), share));
}

bool on_border(TilePlace tile, ivec2 at) {
    ivec2 within = at - tile.origin;
    return within.x == 0 || within.x == kTileCells || within.y == 0 || within.y == kTileCells;
}

Vertex on_edge(TilePlace tile, ivec2 at, Vertex from) {
    ivec2 within = at - tile.origin;
    bool upright = within.x == 0 || within.x == kTileCells;
    int along = upright ? within.y : within.x;
    int edge = upright ? (within.x == 0 ? 0 : 1) : (within.y == 0 ? 2 : 3);
    int side = 2 * edge + (2 * along < kTileCells ? 0 : 1);
    uint steps = (tile.slide[1 + side / 4] >> (8 * (side & 3))) & 0xffu;
    int step = 1 << ((tile.slide.x & 0xffu) + ((tile.slide.x >> (16 + side)) & 1u));
    if (steps == 0u || ((along / step) & 1) == 0) return from;
    ivec2 way = upright ? ivec2(0, step) : ivec2(step, 0);
    return slid(from, stored(tile, at - way), stored(tile, at + way), steps);
}

Vertex end_of(TilePlace tile, ivec2 at) {
    Vertex vertex = stored(tile, at);
    return on_border(tile, at) ? on_edge(tile, at, vertex) : vertex;
}

Vertex slide(Vertex vertex, int slot, int index) {
    ivec2 at = ivec2(index % kPosts, index / kPosts);
    ivec2 part = min(at / kTileCells, TILE_PARTS - 1);
    TilePlace tile = TilePlace(slides[(slot * TILE_PARTS + part.y) * TILE_PARTS + part.x], slot, part * kTileCells);
    uint steps = (tile.slide.x >> 8) & 0xffu;
    if ((steps | tile.slide.y | tile.slide.z) == 0u) return vertex;
    if (on_border(tile, at)) return on_edge(tile, at, vertex);
    int step = 1 << (tile.slide.x & 0xffu);
    ivec2 post = (at - tile.origin) / step, odd = post & 1, cell = post >> 1;
    if (steps == 0u || (odd.x | odd.y) == 0) return vertex;
    bool falling = odd.x + odd.y == 2 && ((cell.x + cell.y) & 1) != 0;
    ivec2 way = ivec2(odd.x, falling ? -odd.y : odd.y) * step;
    return slid(vertex, end_of(tile, at - way), end_of(tile, at + way), steps);
}
