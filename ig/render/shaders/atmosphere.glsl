// Light in the air: one scattering of sunlight by molecules (Rayleigh) and haze (Mie), each with a density that falls
// exponentially with height, over a spherical Earth. Path lengths are "metres at sea-level density": x air, y haze.

const float kEarthRadius = 6371000.0;
const vec3 kRayleigh = vec3(5.8e-6, 13.5e-6, 33.1e-6);  // 1/m at 680, 550, 440 nm, sea level
const vec2 kScaleHeight = vec2(8000.0, 1200.0);
const float kHazeAlbedo = 0.92;
// How much brighter than by single scattering air and haze are, roughly.
const float kAirBrightening = 2.8;
const float kHazeBrightening = 1.9;

vec2 path_to_space(float height, float cosine) {
    return vec2(kScaleHeight.x * chapman(kEarthRadius / kScaleHeight.x, height / kScaleHeight.x, cosine),
                kScaleHeight.y * chapman(kEarthRadius / kScaleHeight.y, height / kScaleHeight.y, cosine));
}

// From the eye along a straight way to a place of another height.
vec2 path_from_eye(float height, float metres) {
    float rise = height - eye_up.w;
    if (abs(rise) < 1.0) return metres * air_at_eye.xy;
    return metres * kScaleHeight / rise * (air_at_eye.xy - exp(-vec2(height) / kScaleHeight));
}

// What is left of light from behind a path (transmittance), and what is scattered into it towards the eye.
struct Air {
    vec3 clear;
    vec3 glow;
};

Air air_along(vec3 direction, vec2 path) {
    float mu = dot(direction, sun_direction.xyz);
    float rayleigh_phase = 0.75 * (1.0 + mu * mu);
    const float g = 0.76;  // Henyey-Greenstein
    float spread = 1.0 + g * g - 2.0 * g * mu;
    float mie_phase = mix(1.0, (1.0 - g * g) / (spread * sqrt(spread)), 0.45);
    vec3 by_air = kRayleigh * path.x;
    float by_haze = sunlight.w * path.y;
    vec3 depth = by_air + by_haze;
    vec3 clear = exp(-depth);
    vec3 source = by_air * (rayleigh_phase * kAirBrightening) + by_haze * (kHazeAlbedo * mie_phase * kHazeBrightening);
    vec3 glow = skylight.rgb * source / max(depth, vec3(1e-9)) * (1.0 - clear) / 12.566371;
    return Air(clear, glow);
}

vec3 sky_radiance(vec3 direction) {
    float ratio = kEarthRadius / (kEarthRadius + eye_up.w);
    float horizon = -sqrt(max(1.0 - ratio * ratio, 0.0));
    return air_along(direction, path_to_space(eye_up.w, max(dot(direction, eye_up.xyz), horizon))).glow;
}

// To display values: a film-like shoulder, which pales colours, so they are deepened before; then the display's gamma;
// half a step of dither against banding.
vec4 displayed(vec3 radiance) {
    const float kDeepen = 1.35;
    float grey = dot(radiance, vec3(0.2126, 0.7152, 0.0722));
    vec3 toned = 1.0 - exp(-2.9 * max(mix(vec3(grey), radiance, kDeepen), 0.0));
    float dither = fract(52.9829189 * fract(dot(gl_FragCoord.xy, vec2(0.06711056, 0.00583715)))) - 0.5;
    return vec4(pow(toned, vec3(1.0 / 2.2)) + dither / 255.0, 1.0);
}
