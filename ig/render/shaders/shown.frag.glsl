// The views that show how terrain is drawn: one colour a draw, lit by its slope so that the ground can be made out.
in vec3 relative;
in float height;
in vec2 tile_place;
flat in int tile_slot;
layout(location = 0) uniform vec4 paint;  // w: how much of it is lit by slope
layout(location = 0) out vec4 colour;

void main() {
    vec3 ecef = eye_high.xyz + relative, up = normalize(ecef);
    vec3 n = leaning(relief_at(tile_slot, tile_place, relative).xy, up, ecef);
    float lit = 0.35 + 0.65 * max(dot(n, normalize(up + 0.8 * sun_direction.xyz)), 0.0);
    colour = vec4(paint.rgb * mix(1.0, lit, paint.w), 1.0);
}
