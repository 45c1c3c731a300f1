// One triangle over the whole picture, at infinite distance (reverse Z: depth 0).
out vec3 ray;

void main() {
    vec2 corner = vec2(gl_VertexID == 1 ? 2.0 : 0.0, gl_VertexID == 2 ? 2.0 : 0.0);
    ray = ray_corner.xyz + ray_right.xyz * corner.x + ray_up.xyz * corner.y;
    gl_Position = vec4(corner * 2.0 - 1.0, 0.0, 1.0);
}
