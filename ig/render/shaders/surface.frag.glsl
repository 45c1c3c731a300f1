// The raster pass: what shading needs, and no shading.
in vec3 relative;
in float height;
in vec2 tile_place;
flat in int tile_slot;
layout(location = 0) out uvec4 words;

void main() {
    vec2 right = dFdx(tile_place), up = dFdy(tile_place);
    float squared = max(dot(right, right), dot(up, up));
    words = packed_surface(SurfacePoint(tile_place, uint(tile_slot), height, gl_FragCoord.z,
                                        0.5 * log2(max(squared, 1e-18))));
}
