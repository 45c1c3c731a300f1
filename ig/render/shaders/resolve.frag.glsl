// Shading after raster: the terrain's shader, once at every pixel that the raster pass has drawn.
in vec3 ray;
layout(location = 0) out vec4 colour;

layout(binding = 0) uniform sampler2DArray images;
layout(binding = 1) uniform sampler2D noise;
layout(binding = 3) uniform usampler2D surface;

// Sides of the textures, as powers of two (noise_texture.cpp, kImageTexels).
const float kNoiseOctaves = 8.0;
const float kImageOctaves = 7.0;

void main() {
    SurfacePoint point = unpacked_surface(texelFetch(surface, ivec2(gl_FragCoord.xy), 0));
    int slot = int(point.slot);
    vec3 relative = ray * (ray_corner.w / point.depth);
    vec4 to_noise = record_floats(slot, 1);
    vec2 noise_at = point.place * to_noise.x + to_noise.yz;
    float octave = point.octave + (log2(to_noise.x) + kNoiseOctaves);
    Ground ground = Ground(relative, point.height, relief_at(slot, point.place, relative),
                           textureLod(noise, noise_at, octave).rg,
                           textureLod(noise, kNearNoise * noise_at, octave + kNearNoiseOctaves).rg, vec3(0.0),
                           to_noise.w);
#ifdef IMAGES
    vec4 to_image = record_floats(slot, 0);
    if (to_image.x >= 0.0) {
        float image_octave = point.octave + log2(to_image.y) + kImageOctaves;
        ground.picture = textureLod(images, image_coordinates(point.place, to_image), image_octave).rgb;
    } else {
        ground.texel_metres = kNoPicture;
    }
#endif
    colour = shaded(ground);
}
