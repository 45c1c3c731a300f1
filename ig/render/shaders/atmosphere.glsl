// Light in the air: one scattering of sunlight by molecules (Rayleigh) and haze (Mie), each with a density that falls
// exponentially with height, over a spherical Earth. Path lengths are "metres at sea-level density".

const float kEarthRadius = 6371000.0;
const vec3 kRayleigh = vec3(5.8e-6, 13.5e-6, 33.1e-6);  // 1/m at 680, 550, 440 nm, sea level
const float kRayleighHeight = 8000.0;
const float kMieHeight = 1200.0;
const float kHazeAlbedo = 0.92;
const float kSeveralScatterings = 2.3;  // how much brighter than single scattering a clear sky is, roughly
const vec3 kSunlight = vec3(1.0, 0.97, 0.92) * 3.14159265;

// Length, in scale heights, of the way out of an exponential atmosphere: radius and height of the eye in scale heights,
// cosine of the zenith angle. After Schueler, "An Approximation to the Chapman Grazing-Incidence Function for
// Atmospheric Scattering", GPU Pro 3 (2012).
float chapman(float radius, float height, float cosine) {
    float c = sqrt(1.5707963 * (radius + height));
    float outward = c / ((c - 1.0) * abs(cosine) + 1.0) * exp(-height);
    if (cosine >= 0.0) return outward;
    float nearest = sqrt(max(1.0 - cosine * cosine, 0.0)) * (radius + height);
    return 2.0 * sqrt(1.5707963 * nearest) * exp(max(radius - nearest, -60.0)) - outward;
}

vec2 path_to_space(float height, float cosine) {
    return vec2(kRayleighHeight * chapman(kEarthRadius / kRayleighHeight, height / kRayleighHeight, cosine),
                kMieHeight * chapman(kEarthRadius / kMieHeight, height / kMieHeight, cosine));
}

// Along a straight way between two heights.
vec2 path_between(float from_height, float to_height, float metres) {
    float rise = to_height - from_height;
    if (abs(rise) < 1.0) return metres * exp(-vec2(from_height) / vec2(kRayleighHeight, kMieHeight));
    vec2 scale = vec2(kRayleighHeight, kMieHeight);
    return metres * scale / rise * (exp(-vec2(from_height) / scale) - exp(-vec2(to_height) / scale));
}

vec3 optical_depth(vec2 path) { return kRayleigh * path.x + vec3(mie.x) * path.y; }

vec3 sunlight_at_eye() {
    float cosine = dot(eye_up.xyz, sun_direction.xyz);
    vec2 path = path_to_space(max(eye_up.w, 0.0), max(cosine, -0.05));
    // Haze scatters mostly forward: little of it is lost.
    return kSunlight * exp(-kRayleigh * path.x - vec3(0.25 * mie.x) * path.y) * smoothstep(-0.10, 0.02, cosine);
}

// Light scattered towards the eye from a direction along a path.
vec3 scattered(vec3 direction, vec2 path) {
    float mu = dot(direction, sun_direction.xyz);
    float rayleigh_phase = 0.75 * (1.0 + mu * mu);
    float g = 0.76;
    float forward = (1.0 - g * g) / pow(1.0 + g * g - 2.0 * g * mu, 1.5);
    float mie_phase = mix(1.0, forward, 0.45);
    vec3 depth = optical_depth(path);
    vec3 source = kRayleigh * path.x * rayleigh_phase + vec3(mie.x * kHazeAlbedo) * path.y * mie_phase;
    return sunlight_at_eye() * source / max(depth, vec3(1e-9)) * (1.0 - exp(-depth)) *
           (kSeveralScatterings / (4.0 * 3.14159265));
}

vec3 sky_radiance(vec3 direction) {
    float height = max(eye_up.w, 0.0);
    float ratio = kEarthRadius / (kEarthRadius + height);
    float horizon = -sqrt(max(1.0 - ratio * ratio, 0.0));
    return scattered(direction, path_to_space(height, max(dot(direction, eye_up.xyz), horizon)));
}

vec3 through_air(vec3 surface, vec3 direction, vec2 path) {
    return surface * exp(-optical_depth(path)) + scattered(direction, path);
}

// To display values: a film-like shoulder, then the display's gamma; half a step of dither against banding.
vec4 displayed(vec3 radiance) {
    vec3 toned = 1.0 - exp(-2.6 * radiance);
    float dither = fract(52.9829189 * fract(dot(gl_FragCoord.xy, vec2(0.06711056, 0.00583715)))) - 0.5;
    return vec4(pow(toned, vec3(1.0 / 2.2)) + dither / 255.0, 1.0);
}
