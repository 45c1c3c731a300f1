in vec3 relative;
in vec3 normal;
in float height;
in float water;
in vec3 image_at;
in vec2 noise_at;
flat in float texel_metres;
layout(location = 0) out vec4 colour;

#ifdef IMAGES
layout(binding = 0) uniform sampler2DArray images;
#endif
layout(binding = 1) uniform sampler2D noise;

void main() {
    Ground ground = Ground(relative, normal, height, water, texture(noise, noise_at).rg,
                           texture(noise, kNearNoise * noise_at).rg, vec3(0.0), texel_metres);
#ifdef IMAGES
    ground.picture = texture(images, image_at).rgb;
#endif
    colour = shaded(ground);
}
