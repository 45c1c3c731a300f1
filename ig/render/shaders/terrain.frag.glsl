// The terrain's shader, run with the triangles.
in vec3 relative;
in float height;
in vec2 tile_place;
flat in int tile_slot;
layout(location = 0) out vec4 colour;

#ifdef IMAGES
layout(binding = 0) uniform sampler2DArray images;
#endif
layout(binding = 1) uniform sampler2D noise;

void main() {
    vec4 to_noise = record_floats(tile_slot, 1);
    vec2 noise_at = tile_place * to_noise.x + to_noise.yz;
    Ground ground = Ground(relative, height, relief_at(tile_slot, tile_place, relative), texture(noise, noise_at).rg,
                           texture(noise, kNearNoise * noise_at).rg, vec3(0.0), to_noise.w);
#ifdef IMAGES
    ground.picture = texture(images, image_coordinates(tile_place, record_floats(tile_slot, 0))).rgb;
#endif
    colour = shaded(ground);
}
