out vec3 relative;
out float height;
out vec2 tile_place;
flat out int tile_slot;

invariant gl_Position;

void main() {
    tile_slot = gl_VertexID / kBlockVertices;
    Vertex vertex = unpack(high, low, packed_rest);
#ifdef NESTED
    vertex = walk(vertex, tile_slot, packed_rest.y);
#endif
#ifdef TILE_PARTS
    vertex = slide(vertex, tile_slot, gl_VertexID - tile_slot * kBlockVertices);
#endif
    relative = vertex.from_eye;
    gl_Position = clip_from_relative * vec4(vertex.from_eye, 1.0);
    height = vertex.height;
    tile_place = vertex.place;
}
