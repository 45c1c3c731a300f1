// A block's vertices as the vertex shader gets them (terrain/block/block.hpp), and what is known of the block in a slot
// (ig/render/draw_list.cpp).
layout(location = 0) in vec3 high;
layout(location = 1) in vec3 low;
layout(location = 2) in uvec2 packed_rest;  // place, rest

struct BlockRecord {
    vec4 image;  // layer (negative: none), scale and offset of the picture's coordinates
    vec4 noise;  // scale and offset of the noise's coordinates; w: metres a texel of the picture
    vec4 relief; // slot of the block whose relief is painted, scale and offset of places in it (relief.glsl)
    // Parent's slot + 1, 0: none; last level, quadrant << 8, floors << 16, level at which its relief has become the
    // parent's << 24 (relief.glsl); the floors of the edges' halves, a byte each. All zeros has no parent: llvmpipe reads
    // zeros here in the lanes that fill up a vector of vertices.
    uvec4 tree;
};
layout(std430, binding = 0) readonly buffer Blocks { BlockRecord blocks[]; };

const int kBlockVertices = 33 * 33;
const float kPlaceUnits = 32768.0;

// What a vertex is: position relative to the eye, ECEF axes, metres; place in the drawn tile, 0..1.
struct Vertex {
    vec3 from_eye;
    vec2 place;
    float height;  // above the sea, metres
};

// The eye is subtracted part by part, so that what is left is small and exact; `precise` keeps the order, so that a
// post shared by two blocks lands on the same bits from both.
Vertex unpack(vec3 high_part, vec3 low_part, uvec2 rest) {
    precise vec3 from_eye = (high_part - eye_high.xyz) + (low_part - eye_low.xyz);
    return Vertex(from_eye, vec2(rest.x & 0xffffu, rest.x >> 16) / kPlaceUnits, float(rest.y >> 18) - 1500.0);
}
