// Where textures are looked up at a place in a tile.

// The noise's second look-up is turned by a whole-number matrix, so that it repeats with the first and shows no seams;
// it repeats often, so only its fine part is used, which fades to nothing before the eye could see the pattern.
const mat2 kNearNoise = mat2(29.0, 11.0, -11.0, 29.0);
const float kNearNoiseOctaves = 4.954946;  // log2 of how it stretches lengths

// Coordinates in a tile's picture (z: layer) of a place in the tile; `image` is BlockRecord's (block.glsl).
vec3 image_coordinates(vec2 place, vec4 image) {
    return vec3(((place * image.y + image.zw) * 127.0 + 0.5) / 128.0, image.x);
}
