/// Tiles' pictures on the graphics card: layers of one array texture.
#pragma once

#include <cstdint>
#include <optional>

#include "ig/render/gl_objects.hpp"
#include "ig/render/slot_table.hpp"
#include "terrain/database/database.hpp"

namespace eyepoint::ig {

class ImageStore {
  public:
    explicit ImageStore(std::uint32_t layers);

    /// The layer of a picture, good for this frame; uploads the picture with its smaller copies if it is not
    /// there yet. None when every layer is in use in this frame.
    [[nodiscard]] std::optional<std::uint32_t> layer_of(const terrain::ImageData& image, std::uint64_t frame);
    [[nodiscard]] GLuint texture() const { return texture_.name(); }
    [[nodiscard]] std::uint64_t uploads() const { return uploads_; }

  private:
    void upload(const terrain::ImageData& image, std::uint32_t layer);

    GlTexture texture_;
    SlotTable layers_;
    std::uint64_t uploads_ = 0;
};

}  // namespace eyepoint::ig
