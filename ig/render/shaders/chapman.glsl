// Shared with C++ (ig/render/frame_uniforms.cpp): plain float arithmetic only.

// Length, in scale heights, of the way out of an exponential atmosphere: radius and height of the eye in scale heights,
// cosine of the zenith angle. After Schueler, "An Approximation to the Chapman Grazing-Incidence Function for
// Atmospheric Scattering", GPU Pro 3 (2012).
float chapman(float radius, float height, float cosine) {
    float c = sqrt(1.5707963f * (radius + height));
    float outward = c / ((c - 1.0f) * abs(cosine) + 1.0f) * exp(-height);
    if (cosine >= 0.0f) return outward;
    float nearest = sqrt(max(1.0f - cosine * cosine, 0.0f)) * (radius + height);
    return 2.0f * sqrt(1.5707963f * nearest) * exp(max(radius - nearest, -60.0f)) - outward;
}
