#include "ig/render/noise_texture.hpp"

#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

namespace eyepoint::ig {

namespace {

constexpr int kTexels = 256;
constexpr int kNoiseMipLevels = 9;

/// A number in 0..1 for a lattice point (integer hash by multiplication and shifts).
double lattice_value(int x, int y, std::uint32_t seed) {
    std::uint32_t bits =
        static_cast<std::uint32_t>(x) * 0x8da6b343U ^ static_cast<std::uint32_t>(y) * 0xd8163841U ^ seed;
    bits = (bits ^ (bits >> 15)) * 0x2c1b3c6dU;
    bits = (bits ^ (bits >> 12)) * 0x297a2d39U;
    return (bits ^ (bits >> 15)) / 4294967295.0;
}

/// Value noise that repeats every `period` cells.
double value_noise(double x, double y, int period, std::uint32_t seed) {
    const int x0 = static_cast<int>(x), y0 = static_cast<int>(y);
    const auto smooth = [](double t) { return t * t * (3.0 - 2.0 * t); };
    const double u = smooth(x - x0), v = smooth(y - y0);
    const auto at = [&](int dx, int dy) {
        return lattice_value((x0 + dx) % period, (y0 + dy) % period, seed);
    };
    return (at(0, 0) * (1.0 - u) + at(1, 0) * u) * (1.0 - v) + (at(0, 1) * (1.0 - u) + at(1, 1) * u) * v;
}

/// Octaves of noise from a first number of cells across the picture, each half as strong as the one before.
double fractal(int row, int column, int first_cells, int octaves, std::uint32_t seed) {
    double sum = 0.0, weight = 1.0, weights = 0.0;
    for (int octave = 0; octave < octaves; ++octave) {
        const int cells = first_cells << octave;
        const double scale = static_cast<double>(cells) / kTexels;
        sum += weight *
               value_noise(column * scale, row * scale, cells, seed + static_cast<std::uint32_t>(octave));
        weights += weight;
        weight *= 0.55;
    }
    return sum / weights;
}

std::uint8_t to_byte(double value) {
    return static_cast<std::uint8_t>(std::lround(std::fmin(std::fmax(value, 0.0), 1.0) * 255.0));
}

}  // namespace

GlTexture make_noise_texture() {
    std::vector<std::array<std::uint8_t, 2>> texels;
    texels.reserve(kTexels * kTexels);
    for (int i = 0; i < kTexels * kTexels; ++i) {
        const int row = i / kTexels, column = i % kTexels;
        const double patches = 0.5 + 1.6 * (fractal(row, column, 4, 7, 17U) - 0.5);
        const double grain = 0.5 + 1.8 * (fractal(row, column, 32, 4, 71U) - 0.5);
        texels.push_back({to_byte(patches), to_byte(grain)});
    }
    GlTexture texture{GLenum{GL_TEXTURE_2D}};
    glTextureStorage2D(texture.name(), kNoiseMipLevels, GL_RG8, kTexels, kTexels);
    glTextureSubImage2D(texture.name(), 0, 0, 0, kTexels, kTexels, GL_RG, GL_UNSIGNED_BYTE, texels.data());
    glGenerateTextureMipmap(texture.name());
    glTextureParameteri(texture.name(), GL_TEXTURE_MIN_FILTER, GL_LINEAR_MIPMAP_NEAREST);
    glTextureParameteri(texture.name(), GL_TEXTURE_MAG_FILTER, GL_LINEAR);
    return texture;
}

}  // namespace eyepoint::ig
