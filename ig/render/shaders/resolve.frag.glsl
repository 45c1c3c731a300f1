// Shading after raster: the terrain's shader, once at every pixel that the raster pass has drawn.
in vec3 ray;
layout(location = 0) out vec4 colour;

layout(binding = 0) uniform sampler2DArray images;
layout(binding = 1) uniform sampler2D noise;
layout(binding = 2) uniform samplerBuffer records;  // BlockRecord (block.glsl) by slot, three texels each
layout(binding = 3) uniform usampler2D surface;

void main() {
    SurfacePoint point = unpacked_surface(texelFetch(surface, ivec2(gl_FragCoord.xy), 0));
    int at = int(point.slot) * 3;
    vec4 to_noise = texelFetch(records, at + 1);
    vec2 noise_at = point.place * to_noise.x + to_noise.yz;
    // Steps to the next pixels that choose a texture's size as the triangle's own would.
    vec2 step = vec2(point.place_step * to_noise.x, 0.0);
    vec2 near_step = step * kNearNoiseScale;
    Ground ground = Ground(ray * (ray_corner.w / point.depth), point.normal, point.height, point.water,
                           textureGrad(noise, noise_at, step, step.yx).rg,
                           textureGrad(noise, kNearNoise * noise_at, near_step, near_step.yx).rg, vec3(0.0), to_noise.w);
#ifdef IMAGES
    vec4 to_image = texelFetch(records, at);
    vec2 image_step = vec2(point.place_step * to_image.y * (127.0 / 128.0), 0.0);
    if (to_image.x >= 0.0) {
        ground.picture = textureGrad(images, image_coordinates(point.place, to_image), image_step, image_step.yx).rgb;
    } else {
        ground.texel_metres = kNoPicture;
    }
#endif
    colour = shaded(ground);
}
