in vec3 relative;
in vec3 normal;
in float height;
in float water;
in vec3 image_at;
in vec2 noise_at;
flat in float texel_metres;
layout(location = 0) out vec4 colour;

layout(binding = 0) uniform sampler2DArray images;
layout(binding = 1) uniform sampler2D noise;

// Albedo of bare ground by height above the sea, steepness and latitude (degrees): fields, forest, meadow, rock, snow.
vec3 ground_albedo(float metres, float steepness, float latitude, vec2 grain) {
    float snow_line = max(5300.0 - 1.13 * latitude * latitude, 0.0) + 500.0 * (grain.x - 0.5);
    float tree_line = snow_line - 950.0 + 350.0 * (grain.y - 0.5);
    float dry = smoothstep(12.0, 20.0, latitude) * (1.0 - smoothstep(30.0, 36.0, latitude));

    vec3 field = mix(vec3(0.155, 0.175, 0.065), vec3(0.23, 0.215, 0.10), grain.x);
    vec3 forest = mix(vec3(0.030, 0.058, 0.022), vec3(0.055, 0.085, 0.032), grain.y);
    vec3 meadow = mix(vec3(0.13, 0.145, 0.06), vec3(0.18, 0.165, 0.085), grain.x);
    vec3 rock = mix(vec3(0.16, 0.15, 0.135), vec3(0.27, 0.26, 0.245), grain.x * 0.6 + grain.y * 0.4);
    vec3 snow = vec3(0.80, 0.84, 0.90);
    vec3 sand = mix(vec3(0.38, 0.30, 0.19), vec3(0.46, 0.38, 0.25), grain.x);

    float wooded = smoothstep(0.42, 0.62, grain.x + 1.2 * steepness);
    vec3 albedo = mix(field, forest, wooded);
    albedo = mix(albedo, meadow, smoothstep(tree_line - 250.0, tree_line + 150.0, metres));
    albedo = mix(albedo, sand, dry * (1.0 - smoothstep(1500.0, 2500.0, metres)));
    float rocky = smoothstep(0.20, 0.38, steepness + 0.10 * (grain.y - 0.5)) +
                  smoothstep(snow_line - 500.0, snow_line + 50.0, metres);
    albedo = mix(albedo, rock, clamp(rocky, 0.0, 1.0));
    float snowy = smoothstep(snow_line - 150.0, snow_line + 250.0, metres - 1100.0 * max(steepness - 0.22, 0.0));
    return mix(albedo, snow, snowy);
}

vec3 lit_ground(vec3 albedo, vec3 n, vec3 up) {
    float sun = max(dot(n, sun_direction.xyz), 0.0);
    vec3 sky = vec3(0.20, 0.25, 0.33) * (0.55 + 0.45 * dot(n, up)) * smoothstep(-0.15, 0.2, dot(up, sun_direction.xyz));
    return albedo * (sunlight_at_eye() * sun + 3.14159265 * 0.33 * sky) / 3.14159265;
}

vec3 lit_water(vec3 direction, vec3 up, vec2 grain, float metres) {
    float chop = 0.05 / (1.0 + metres / 4000.0);
    vec3 east = normalize(cross(vec3(0.0, 0.0, 1.0), up) + vec3(1e-6));
    vec3 n = normalize(up + chop * ((grain.x - 0.5) * east + (grain.y - 0.5) * cross(up, east)));
    float facing = clamp(-dot(n, direction), 0.0, 1.0);
    float mirror = 0.02 + 0.98 * pow(1.0 - facing, 5.0) * 0.7;
    vec3 mirrored = reflect(direction, n);
    mirrored = normalize(mirrored + up * max(0.05 - dot(mirrored, up), 0.0));
    vec3 body = vec3(0.006, 0.022, 0.034) * (0.35 + max(dot(up, sun_direction.xyz), 0.0));
    float glint = pow(max(dot(mirrored, sun_direction.xyz), 0.0), 180.0);
    return body + mirror * (sky_radiance(mirrored) + 3.0 * glint * sunlight_at_eye());
}

void main() {
    float metres = length(relative);
    vec3 direction = relative / metres;
    // Perpendicular to the ellipsoid, nearly: z is stretched by 1 / (1 - e^2).
    vec3 up = normalize((eye_high.xyz + relative) * vec3(1.0, 1.0, 1.0067395));
    vec3 n = normalize(normal);

    vec2 grain = mix(texture(noise, noise_at).rg, texture(noise, noise_at * 13.0).rg, 0.45);
    float latitude = degrees(asin(abs(up.z)));
    vec3 albedo = ground_albedo(height, 1.0 - dot(n, up), latitude, grain);
    if (image_at.z >= 0.0) {
        // A picture counts in full while its texels are small on the screen or on the ground; blown up beyond that,
        // colours by height and slope say more.
        float texel_pixels = texel_metres * sun_direction.w / metres;
        float sharp = 1.0 - smoothstep(3.0, 6.5, log2(max(texel_pixels, 1.0)));
        float fine = 1.0 - smoothstep(150.0, 1000.0, texel_metres);
        albedo = mix(albedo, texture(images, image_at).rgb, max(sharp, fine));
    }

    vec3 surface = lit_ground(albedo, n, up);
    float wet = smoothstep(0.4, 0.6, water);
    if (wet > 0.0) surface = mix(surface, lit_water(direction, up, grain, metres), wet);
    vec2 path = path_between(max(eye_up.w, 0.0), max(height, 0.0), metres);
    colour = displayed(through_air(surface, direction, path));
}
