// What is painted on the ground at a place of a tile: its lean and its water, from the posts of a tile
// (terrain/block/relief.hpp), not from the mesh's few vertices.
layout(binding = 4) uniform usamplerBuffer records;  // BlockRecord (block.glsl) by slot, four texels each
layout(binding = 5) uniform usamplerBuffer relief_posts;  // 33 x 33 a slot

const int kReliefPosts = 33 * 33;

vec4 record_floats(int slot, int part) { return uintBitsToFloat(texelFetch(records, slot * 4 + part)); }

// x, y: eastern and northern components of the normal; z: water.
vec3 relief_post(int at) {
    int bits = int(texelFetch(relief_posts, at).x);
    return vec3((bits << 20) >> 20, (bits << 8) >> 20, float(uint(bits) >> 24)) / vec3(2047.0, 2047.0, 255.0);
}

vec3 block_relief(int slot, vec2 place) {
    vec2 at = clamp(place, 0.0, 1.0) * 32.0;
    ivec2 cell = min(ivec2(at), 31);
    vec2 share = at - vec2(cell);
    int post = slot * kReliefPosts + cell.y * 33 + cell.x;
    return mix(mix(relief_post(post), relief_post(post + 1), share.x),
               mix(relief_post(post + 33), relief_post(post + 34), share.x), share.y);
}

#ifdef RELIEF_BY_LEVEL
const int kMostDepths = 26;

// Where nested meshes choose blocks, a tile gives way to its parent without a change of shape. Nor does the relief
// change: from one level before a tile's last on, it turns into the parent's. The last is that of the mesh or, if it is
// more, that from which on the parent's relief is fine enough (painted_detail.hpp).
vec3 relief_at(int slot, vec2 place, vec3 relative) {
    vec4 painted = record_floats(slot, 2);
    slot = int(painted.x);
    place = place * painted.y + painted.zw;
    float level = log2(max(dot(relative, relative) * motion.x, 1e-18));
    if (motion.y == 0.0) level = floor(level);
    vec3 sum = vec3(0.0);
    float left = 1.0;
    for (int depths = 0; depths < kMostDepths; ++depths) {
        uvec4 tree = texelFetch(records, slot * 4 + 3);
        float last = float(tree.y >> 24);
        float to_parent = tree.x == 0u ? 0.0 : clamp(level - (last - 1.0), 0.0, 1.0);
        sum += left * (1.0 - to_parent) * block_relief(slot, place);
        left *= to_parent;
        if (left == 0.0) break;
        place = 0.5 * (place + vec2((tree.y >> 8) & 1u, (tree.y >> 9) & 1u));
        slot = int(tree.x) - 1;
    }
    return sum;
}
#else
vec3 relief_at(int slot, vec2 place, vec3 relative) {
    vec4 painted = record_floats(slot, 2);
    return block_relief(int(painted.x), place * painted.y + painted.zw);
}
#endif

// The unit normal with these eastern and northern components, at a place (ECEF) with the vertical `up`.
vec3 leaning(vec2 lean, vec3 up, vec3 ecef) {
    vec3 east = normalize(vec3(-ecef.y, ecef.x + 1e-3, 0.0));
    return lean.x * east + lean.y * cross(up, east) + sqrt(max(1.0 - dot(lean, lean), 0.0)) * up;
}
