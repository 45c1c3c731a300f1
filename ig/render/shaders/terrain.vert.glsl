out vec3 relative;
out vec3 normal;
out float height;
out float water;
#ifdef SURFACE
out vec2 tile_place;
flat out uint tile_slot;
#else
out vec3 image_at;  // z: layer
out vec2 noise_at;
flat out float texel_metres;
#endif

invariant gl_Position;

void main() {
    int slot = gl_VertexID / kBlockVertices;
    Vertex vertex = unpack(high, low, packed_rest.xyz);
#ifdef NESTED
    vertex = walk(vertex, slot, packed_rest.w);
#endif
    relative = vertex.from_eye;
    gl_Position = clip_from_relative * vec4(vertex.from_eye, 1.0);
    normal = vertex.normal;
    height = vertex.height;
    water = vertex.water;
#ifdef SURFACE
    tile_place = vertex.place;
    tile_slot = uint(slot);
#else
    image_at = image_coordinates(vertex.place, blocks[slot].image);
    noise_at = vertex.place * blocks[slot].noise.x + blocks[slot].noise.yz;
    texel_metres = blocks[slot].noise.w;
#endif
}
