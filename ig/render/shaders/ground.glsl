// What a point of the ground looks like from the eye: the terrain's shader, without its textures' look-ups, which differ
// between shading while triangles are drawn (terrain.frag.glsl) and after (resolve.frag.glsl).
struct Ground {
    vec3 relative;  // to the eye, metres
    float height;   // above the sea, metres
    vec3 relief;    // x, y: how the normal leans to the east and north; z: water, 0..1
    vec2 broad;     // noise, at two scales
    vec2 near;
    vec3 picture;   // the tile's picture and its texels' side, metres
    float texel_metres;
};

// Side of a texel where there is no picture: so large that none of it is seen.
const float kNoPicture = 1e12;

// Albedo of bare ground by height above the sea, steepness (1 - cosine of the slope), squared sine of the latitude and
// noise around 0 (x kilometres, y hundreds of metres, z tens of metres): fields and forest, meadow, rock, snow; sand in
// the dry belts.
vec3 ground_albedo(float metres, float steepness, float sin2, vec3 grain) {
    float rough = grain.y + 0.8 * grain.z;
    // 5300 m at the equator, 2900 m at 46 degrees, sea level at 68.
    float snow_line = max(5300.0 - sin2 * (2462.0 + 4224.0 * sin2), 0.0) + 300.0 * grain.x + 450.0 * rough;
    float tree_line = snow_line - 950.0;
    float dry = smoothstep(0.04, 0.12, sin2) * (1.0 - smoothstep(0.25, 0.35, sin2));

    vec3 field = mix(vec3(0.060, 0.098, 0.022), vec3(0.140, 0.128, 0.045), clamp(0.5 + 0.8 * grain.x + rough, 0.0, 1.0));
    vec3 forest = vec3(0.016, 0.034, 0.013) * (1.0 + 1.2 * grain.z);
    vec3 meadow = mix(vec3(0.070, 0.086, 0.028), vec3(0.120, 0.108, 0.050), clamp(0.5 + grain.x + rough, 0.0, 1.0));
    vec3 rock = vec3(0.118, 0.110, 0.102) * (1.0 + 0.5 * grain.y + 0.8 * grain.z);
    vec3 snow = vec3(0.78, 0.82, 0.88);
    vec3 sand = vec3(0.40, 0.32, 0.21) * (1.0 + 0.3 * grain.y + 0.3 * grain.z);

    float wooded = smoothstep(0.40, 0.62, 0.42 + 0.7 * grain.x + 0.9 * grain.y + 0.5 * grain.z + 1.6 * steepness);
    vec3 albedo = mix(field, forest, wooded);
    albedo = mix(albedo, meadow, smoothstep(tree_line - 250.0, tree_line + 150.0, metres));
    albedo = mix(albedo, sand, dry * (1.0 - smoothstep(1500.0, 2500.0, metres)));
    float bare = smoothstep(0.18, 0.40, steepness + 0.10 * grain.y + 0.25 * grain.z) +
                 smoothstep(snow_line - 600.0, snow_line - 50.0, metres);
    albedo = mix(albedo, rock, clamp(bare, 0.0, 1.0));
    // Steep ground sheds its snow, the sooner the nearer the snow line.
    float snowy = smoothstep(snow_line - 120.0, snow_line + 180.0, metres - 1600.0 * max(steepness - 0.18, 0.0)) *
                  (1.0 - smoothstep(0.28, 0.48, steepness + 0.4 * grain.y + 0.5 * grain.z));
    return mix(albedo, snow, snowy);
}

vec3 lit_ground(vec3 albedo, vec3 n, vec3 up) {
    float sun = max(dot(n, sun_direction.xyz), 0.0);
    vec3 sky = vec3(0.068, 0.085, 0.118) * (0.55 + 0.45 * dot(n, up)) * skylight.g;
    return albedo * (sunlight.rgb * sun * 0.31831 + sky);
}

#ifdef WATER
vec3 lit_water(vec3 direction, vec3 up, vec2 ripple, float metres) {
    float chop = 0.05 / (1.0 + metres / 4000.0);
    vec3 east = normalize(cross(vec3(0.0, 0.0, 1.0), up) + vec3(1e-6));
    vec3 n = normalize(up + chop * (ripple.x * east + ripple.y * cross(up, east)));
    float away = 1.0 - clamp(-dot(n, direction), 0.0, 1.0);
    float away2 = away * away;
    float mirror = 0.02 + 0.69 * away2 * away2 * away;  // Schlick, less what waves turn away
    vec3 mirrored = reflect(direction, n);
    mirrored = normalize(mirrored + up * max(0.05 - dot(mirrored, up), 0.0));
    vec3 body = vec3(0.004, 0.017, 0.028) * (0.35 + max(dot(up, sun_direction.xyz), 0.0));
    float glint = pow(max(dot(mirrored, sun_direction.xyz), 0.0), 180.0);
    return body + mirror * (sky_radiance(mirrored) + 3.0 * glint * sunlight.rgb);
}
#endif

vec4 shaded(Ground ground) {
    float metres = length(ground.relative);
    vec3 direction = ground.relative / metres;
    // Perpendicular to the ellipsoid, nearly: z is stretched by 1 / (1 - e^2).
    vec3 up = normalize((eye_high.xyz + ground.relative) * vec3(1.0, 1.0, 1.0067395));
    vec3 n = leaning(ground.relief.xy, up, eye_high.xyz + ground.relative);

    vec2 broad = ground.broad - 0.5, near = ground.near - 0.5;
    // From far away the broad part would show its repetition too.
    vec3 grain = vec3(broad.r, broad.g, near.g + 0.25 * near.r) * (1.0 - smoothstep(60000.0, 160000.0, metres));
    vec3 albedo = ground_albedo(ground.height, 1.0 - dot(n, up), up.z * up.z, grain);
    float pictured = 0.0;
#ifdef IMAGES
    // A picture counts in full while its texels are small on the screen or on the ground; blown up beyond that, colours
    // by height and slope say more.
    float texel_pixels = ground.texel_metres * sun_direction.w / metres;
    float sharp = 1.0 - smoothstep(3.0, 6.5, log2(max(texel_pixels, 1.0)));
    float small = 1.0 - smoothstep(150.0, 1000.0, ground.texel_metres);
    pictured = max(sharp, small);
    albedo = mix(albedo, ground.picture, pictured);
#endif

    vec3 surface = lit_ground(albedo, n, up);
#ifdef WATER
    // Water's own shading gives way to the picture where that is sharper than the posts that say where water is.
    float wet = smoothstep(0.4, 0.6, ground.relief.z) * (1.0 - 0.85 * pictured * smoothstep(20000.0, 100000.0, metres));
    surface = mix(surface, lit_water(direction, up, grain.yz, metres), wet);
#endif
    Air air = air_along(direction, path_from_eye(max(ground.height, 0.0), metres));
    return displayed(surface * air.clear + air.glow);
}
