// The raster pass: what shading needs, and no shading.
in vec3 relative;
in vec3 normal;
in float height;
in float water;
in vec2 tile_place;
flat in uint tile_slot;
layout(location = 0) out uvec4 words;

void main() {
    vec4 steps = vec4(dFdx(tile_place), dFdy(tile_place));
    vec2 larger = max(abs(steps.xy), abs(steps.zw));
    words = packed_surface(SurfacePoint(normalize(normal), water, tile_place, tile_slot, height, gl_FragCoord.z,
                                        max(larger.x, larger.y)));
}
