// The views that show how terrain is drawn: one colour a draw, lit by its slope so that the ground can be made out.
in vec3 relative;
in vec3 normal;
in float height;
in float water;
layout(location = 0) uniform vec4 paint;  // w: how much of it is lit by slope
layout(location = 0) out vec4 colour;

void main() {
    vec3 up = normalize(eye_high.xyz + relative);
    float lit = 0.35 + 0.65 * max(dot(normalize(normal), normalize(up + 0.8 * sun_direction.xyz)), 0.0);
    colour = vec4(paint.rgb * mix(1.0, lit, paint.w), 1.0);
}
