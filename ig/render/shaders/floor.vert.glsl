// One triangle over the whole picture that gives the terrain's shader ground like that of a flight at its every pixel: a
// plain 500 m high from the eye to the horizon.
out vec3 relative;
out vec3 normal;
out float height;
out float water;
out vec3 image_at;
out vec2 noise_at;
flat out float texel_metres;

void main() {
    vec2 corner = vec2(gl_VertexID == 1 ? 2.0 : 0.0, gl_VertexID == 2 ? 2.0 : 0.0);
    relative = 5000.0 * (ray_corner.xyz + ray_right.xyz * corner.x + ray_up.xyz * corner.y);
    normal = eye_up.xyz;
    height = 500.0;
    water = 0.0;
    image_at = vec3(corner, 0.0);
    noise_at = corner;
    texel_metres = 20.0;
    gl_Position = vec4(corner * 2.0 - 1.0, 0.0, 1.0);
}
