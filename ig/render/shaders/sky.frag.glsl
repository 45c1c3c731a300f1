in vec3 ray;
layout(location = 0) out vec4 colour;

const float kSunCosine = 0.9999892;  // angular radius 0.266 degrees

void main() {
    vec3 direction = normalize(ray);
    vec3 radiance = sky_radiance(direction);
    float to_sun = dot(direction, sun_direction.xyz);
    radiance += sunlight.rgb * 8.0 * smoothstep(kSunCosine - 4e-6, kSunCosine + 4e-6, to_sun);
    colour = displayed(radiance);
}
