// What the raster pass leaves at a pixel for the shading after it, in four words.
struct SurfacePoint {
    vec2 place;    // in the tile, -0.5..1.5
    uint slot;     // of the block, below 65536
    float height;  // above the sea, metres
    float depth;   // of the depth buffer
    float octave;  // log2 of the larger of the place's changes to the next pixels
};

// Place 2 x 16 bits; height 16 (quarters of a metre above -1500), slot 16; depth; octave.
uvec4 packed_surface(SurfacePoint point) {
    uvec2 place = uvec2(clamp((point.place * 0.5 + 0.25) * 65535.0 + 0.5, 0.0, 65535.0));
    uint height = uint(clamp((point.height + 1500.0) * 4.0 + 0.5, 0.0, 65535.0));
    return uvec4(place.x | place.y << 16, height | point.slot << 16, floatBitsToUint(point.depth),
                 floatBitsToUint(point.octave));
}

SurfacePoint unpacked_surface(uvec4 words) {
    return SurfacePoint(vec2(words.x & 0xffffu, words.x >> 16) / 65535.0 * 2.0 - 0.5, words.y >> 16,
                        float(words.y & 0xffffu) * 0.25 - 1500.0, uintBitsToFloat(words.z), uintBitsToFloat(words.w));
}
