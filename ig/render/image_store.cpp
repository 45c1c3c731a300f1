#include "ig/render/image_store.hpp"

#include <bit>
#include <vector>

namespace eyepoint::ig {

namespace {

constexpr int kMipLevels = std::bit_width(static_cast<unsigned>(terrain::kImageTexels));

/// The picture at half the side, each texel the mean of four.
std::vector<std::uint8_t> halved(const std::vector<std::uint8_t>& rgb, std::size_t side) {
    const std::size_t half = side / 2;
    std::vector<std::uint8_t> result(half * half * 3);
    for (std::size_t i = 0; i < result.size(); ++i) {
        const std::size_t channel = i % 3, column = i / 3 % half, row = i / 3 / half;
        const auto at = [&](std::size_t r, std::size_t c) {
            return static_cast<unsigned>(rgb[((row * 2 + r) * side + column * 2 + c) * 3 + channel]);
        };
        result[i] = static_cast<std::uint8_t>((at(0, 0) + at(0, 1) + at(1, 0) + at(1, 1) + 2) / 4);
    }
    return result;
}

}  // namespace

ImageStore::ImageStore(std::uint32_t layers) : texture_(GLenum{GL_TEXTURE_2D_ARRAY}), layers_(layers) {
    glTextureStorage3D(texture_.name(), kMipLevels, GL_SRGB8_ALPHA8, terrain::kImageTexels,
                       terrain::kImageTexels, static_cast<GLsizei>(layers));
    glTextureParameteri(texture_.name(), GL_TEXTURE_MIN_FILTER, GL_LINEAR_MIPMAP_LINEAR);
    glTextureParameteri(texture_.name(), GL_TEXTURE_MAG_FILTER, GL_LINEAR);
    glTextureParameteri(texture_.name(), GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
    glTextureParameteri(texture_.name(), GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
}

std::optional<std::uint32_t> ImageStore::layer_of(const terrain::ImageData& image, std::uint64_t frame) {
    const auto placement = layers_.place(image.tile, frame);
    if (!placement) return std::nullopt;
    if (placement->fresh) upload(image, placement->slot);
    return placement->slot;
}

void ImageStore::upload(const terrain::ImageData& image, std::uint32_t layer) {
    std::vector<std::uint8_t> rgb = image.rgb;
    auto side = static_cast<GLsizei>(terrain::kImageTexels);
    glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
    for (int level = 0; level < kMipLevels; ++level) {
        if (level > 0) {
            rgb = halved(rgb, static_cast<std::size_t>(side));
            side /= 2;
        }
        glTextureSubImage3D(texture_.name(), level, 0, 0, static_cast<GLint>(layer), side, side, 1, GL_RGB,
                            GL_UNSIGNED_BYTE, rgb.data());
    }
    glPixelStorei(GL_UNPACK_ALIGNMENT, 4);
    ++uploads_;
}

}  // namespace eyepoint::ig
