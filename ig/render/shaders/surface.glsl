// What the raster pass leaves at a pixel for the shading after it, in four words.
struct SurfacePoint {
    vec3 normal;  // of unit length
    float water;
    vec2 place;   // in the tile, -0.5..1.5
    uint slot;    // of the block, below 65536
    float height;      // above the sea, metres
    float depth;       // of the depth buffer
    float octave;      // log2 of the larger of the place's changes to the next pixels
};

// A direction as a point of the square that an octahedron unfolds to. After Cigolla et al., "A Survey of Efficient
// Representations for Independent Unit Vectors", JCGT 3(2), 2014.
vec2 octahedral(vec3 n) {
    vec2 p = n.xy / (abs(n.x) + abs(n.y) + abs(n.z));
    vec2 folded = (1.0 - abs(p.yx)) * mix(vec2(-1.0), vec2(1.0), greaterThanEqual(p, vec2(0.0)));
    return n.z < 0.0 ? folded : p;
}
vec3 from_octahedral(vec2 p) {
    vec3 n = vec3(p, 1.0 - abs(p.x) - abs(p.y));
    vec2 folded = (1.0 - abs(n.yx)) * mix(vec2(-1.0), vec2(1.0), greaterThanEqual(n.xy, vec2(0.0)));
    return normalize(n.z < 0.0 ? vec3(folded, n.z) : n);
}

// Bits: normal 2 x 12, water 8; place 2 x 16; height 16 (quarters of a metre above -1500), slot 16; depth the upper 17 of
// its float's (it is positive; a thousandth of the distance shades as well), octave 15 (1536ths below 1).
const int kDepthBits = 17;

uvec4 packed_surface(SurfacePoint point) {
    uvec2 normal = uvec2((octahedral(point.normal) * 0.5 + 0.5) * 4095.0 + 0.5);
    uvec2 place = uvec2(clamp((point.place * 0.5 + 0.25) * 65535.0 + 0.5, 0.0, 65535.0));
    uint height = uint(clamp((point.height + 1500.0) * 4.0 + 0.5, 0.0, 65535.0));
    uint octave = uint(clamp((1.0 - point.octave) * 1536.0 + 0.5, 0.0, 32767.0));
    uint depth = (floatBitsToUint(point.depth) + 0x2000u) >> 14;
    return uvec4(normal.x | normal.y << 12 | uint(point.water * 255.0 + 0.5) << 24, place.x | place.y << 16,
                 height | point.slot << 16, octave << kDepthBits | depth);
}

SurfacePoint unpacked_surface(uvec4 words) {
    vec2 normal = vec2(words.x & 0xfffu, (words.x >> 12) & 0xfffu) / 4095.0 * 2.0 - 1.0;
    return SurfacePoint(from_octahedral(normal), float(words.x >> 24) / 255.0,
                        vec2(words.y & 0xffffu, words.y >> 16) / 65535.0 * 2.0 - 0.5, words.z >> 16,
                        float(words.z & 0xffffu) * 0.25 - 1500.0, uintBitsToFloat((words.w & 0x1ffffu) << 14),
                        1.0 - float(words.w >> kDepthBits) / 1536.0);
}
