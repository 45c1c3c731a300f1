// What all passes share in a frame; filled by ig/render/frame_uniforms.cpp. Directions are ECEF.
layout(std140, binding = 0) uniform Frame {
    mat4 clip_from_relative;  // from positions relative to the eye to clip space
    vec4 eye_high;            // the eye's ECEF position is eye_high + eye_low, metres
    vec4 eye_low;
    vec4 eye_up;              // unit; w: the eye's height, metres, 0 at least
    vec4 sun_direction;       // unit, towards the sun; w: kappa, pixels per unit of metres over metres
    vec4 sunlight;            // that reaches the ground near the eye; w: haze extinction at sea level, 1/m
    vec4 skylight;            // sunlight that is left to scatter in the air
    vec4 air_at_eye;          // density of air (x) and haze (y) at the eye, of that at sea level
    vec4 ray_corner;          // direction to the lower left corner of the picture, 1 along the view's axis; w: nearest distance
    vec4 ray_right;           // from there to the lower right corner
    vec4 ray_up;              // and to the upper left
    vec4 motion;              // nested meshes: squared scale of levels (error_level.hpp); 1: vertices slide, 0: they jump
};
