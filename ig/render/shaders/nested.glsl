// Where a vertex of a nested mesh is drawn: terrain/lod/nested_motion.hpp on the graphics card. Everything that decides
// a position is `precise` and made of operations that are rounded correctly everywhere, so that a vertex lands on the
// same bits from every block and in every program.
layout(binding = 2) uniform usamplerBuffer vertex_words;  // all blocks' vertices, four words and four

const int kLevels = 64;
const uint kStays = 127u;
const uint kNoSlot = 0u;

// log2 of a positive normal number, to 6e-8 + half a unit in the last place of the result: the exponent, and a
// polynomial of degree 9 through the Chebyshev nodes of sqrt(1/2)..sqrt(2).
float exact_log2(float x) {
    int bits = floatBitsToInt(x);
    int exponent = (bits >> 23) - 127;
    float mantissa = intBitsToFloat((bits & 0x7fffff) | 0x3f800000);
    if (mantissa > 1.41421354) {
        mantissa *= 0.5;
        exponent += 1;
    }
    precise float z = mantissa - 1.0;
    precise float sum = 0.123109683;
    sum = sum * z + -0.205861881;
    sum = sum * z + 0.216078222;
    sum = sum * z + -0.239169881;
    sum = sum * z + 0.287903249;
    sum = sum * z + -0.360693276;
    sum = sum * z + 0.480910748;
    sum = sum * z + -0.721347451;
    sum = sum * z + 1.44269502;
    precise float result = sum * z + float(exponent);
    return result;
}

// Levels of the floors of the edges that a place is on: west, east, south, north, two halves each. Most have none.
float floor_level(uvec4 tree, vec2 place) {
    if ((tree.y & 0x10000u) == 0u) return 0.0;
    uint highest = 0u;
    bvec4 on = equal(place.xxyy, vec4(0.0, 1.0, 0.0, 1.0));
    vec4 along = place.yyxx;
    for (int edge = 0; edge < 4; ++edge) {
        if (!on[edge] || along[edge] < 0.0 || along[edge] > 1.0) continue;
        uint halves = tree[2 + edge / 2] >> (16 * (edge & 1));
        if (along[edge] <= 0.5) highest = max(highest, halves & 0xffu);
        if (along[edge] >= 0.5) highest = max(highest, (halves >> 8) & 0xffu);
    }
    return float(highest);
}

// The level asked for at a vertex: 2 log2(distance * scale), without a square root.
float level_asked(vec3 from_eye, float lowest) {
    precise float squared = (from_eye.x * from_eye.x + from_eye.y * from_eye.y) + from_eye.z * from_eye.z;
    precise float ratio = max(squared * motion.x, 1e-18);
    float level = max(exact_log2(ratio), lowest);
    return motion.y != 0.0 ? level : floor(level);
}

uint next_of(uint rest) { return rest & 0x7ffu; }
uint gone_level(uint rest) { return (rest >> 11) & 0x7fu; }

// A vertex of the block in a slot, its place as that block has it.
Vertex fetch(int slot, uint index, out uint rest) {
    int at = (slot * kBlockVertices + int(index)) * 2;
    uvec4 a = texelFetch(vertex_words, at), b = texelFetch(vertex_words, at + 1);
    rest = b.w;
    return unpack(uintBitsToFloat(a.xyz), uintBitsToFloat(uvec3(a.w, b.xy)), b.zw);
}

// Sum of vertices by weight; its position's bits depend on the vertices and weights alone.
void accumulate(inout Vertex sum, Vertex vertex, float weight) {
    precise vec3 from_eye = sum.from_eye + weight * vertex.from_eye;
    sum.from_eye = from_eye;
    sum.place += weight * vertex.place;
    sum.height += weight * vertex.height;
}

// P(v): the vertex, its target, the target's target and so on, as far as each has set out.
Vertex walk(Vertex vertex, int slot, uint rest) {
    uvec4 drawn = blocks[slot].tree;
    uvec4 tree = drawn;
    vec2 scale = vec2(1.0), offset = vec2(0.0);  // from places in the block in hand to the drawn tile's
    Vertex sum = Vertex(vec3(0.0), vec2(0.0), 0.0);
    precise float left = 1.0;
    float lowest = 0.0;
    // Each target goes at a higher level than what slides to it.
    for (int step = 0; step < kLevels; ++step) {
        // A floor stays on the way: the chain runs along the edge's line.
        lowest = max(lowest, floor_level(drawn, vertex.place));
        float level = level_asked(vertex.from_eye, lowest);
        uint gone = gone_level(rest);
        // A vertex that stays goes later, if at all, and in an ancestor's block.
        while (gone == kStays && level > float(tree.y & 0xffu) && tree.x != kNoSlot) {
            offset -= scale * vec2((tree.y >> 8) & 1u, (tree.y >> 9) & 1u);
            scale *= 2.0;
            slot = int(tree.x) - 1;
            tree = blocks[slot].tree;
            rest = texelFetch(vertex_words, (slot * kBlockVertices + int(next_of(rest))) * 2 + 1).w;
            gone = gone_level(rest);
        }
        precise float t = gone == kStays ? 0.0 : clamp(level - (float(gone) - 1.0), 0.0, 1.0);
        precise float share = left * (1.0 - t);
        accumulate(sum, vertex, share);
        left = left * t;
        if (left == 0.0) return sum;
        vertex = fetch(slot, next_of(rest), rest);
        vertex.place = vertex.place * scale + offset;
    }
    return sum;
}
