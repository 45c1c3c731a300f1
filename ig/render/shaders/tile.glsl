// Coordinates in a tile's picture (z: layer) of a place in the tile; `image` is BlockRecord's (block.glsl).
vec3 image_coordinates(vec2 place, vec4 image) {
    return vec3(((place * image.y + image.zw) * 127.0 + 0.5) / 128.0, image.x);
}
