layout(location = 0) in vec3 high;
layout(location = 1) in vec3 low;
layout(location = 2) in vec4 packed_normal;
layout(location = 3) in uint surface;

struct BlockRecord {
    vec4 image;  // layer (negative: none), scale and offset of the picture's coordinates
    vec4 noise;  // scale and offset of the noise's coordinates; w: metres a texel of the picture
};
layout(std430, binding = 0) readonly buffer Blocks { BlockRecord blocks[]; };

const int kPosts = 33;

out vec3 relative;
out vec3 normal;
out float height;
out float water;
out vec3 image_at;  // z: layer
out vec2 noise_at;
flat out float texel_metres;

invariant gl_Position;

void main() {
    // The eye is subtracted part by part, so that what is left is small and exact; `precise` keeps the order, so that
    // a post shared by two blocks lands on the same bits from both.
    precise vec3 from_eye = (high - eye_high.xyz) + (low - eye_low.xyz);
    relative = from_eye;
    gl_Position = clip_from_relative * vec4(from_eye, 1.0);

    normal = packed_normal.xyz;
    height = float(surface & 0xffffu) * 0.25 - 1500.0;
    water = float((surface >> 16) & 1u);

    BlockRecord block = blocks[gl_VertexID / (kPosts * kPosts)];
    int post = gl_VertexID % (kPosts * kPosts);
    vec2 place = vec2(float(post % kPosts), float(post / kPosts)) / float(kPosts - 1);
    vec2 image_place = place * block.image.y + block.image.zw;
    image_at = vec3((image_place * 127.0 + 0.5) / 128.0, block.image.x);
    noise_at = place * block.noise.x + block.noise.yz;
    texel_metres = block.noise.w;
}
