// One triangle over the whole picture that gives the terrain's shader ground like that of a flight at its every pixel: a
// plain 500 m high from the eye to the horizon, of one block.
flat out int tile_slot;
out vec3 relative;
out float height;
out vec2 tile_place;

layout(location = 0) uniform int slot;

void main() {
    vec2 corner = vec2(gl_VertexID == 1 ? 2.0 : 0.0, gl_VertexID == 2 ? 2.0 : 0.0);
    relative = 5000.0 * (ray_corner.xyz + ray_right.xyz * corner.x + ray_up.xyz * corner.y);
    height = 500.0;
    tile_place = corner;
    tile_slot = slot;
    gl_Position = vec4(corner * 2.0 - 1.0, 0.0, 1.0);
}
