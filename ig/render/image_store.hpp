/// Tiles' pictures on the graphics card: layers of one array texture, the longest unused given away first.
#pragma once

#include <cstdint>
#include <optional>
#include <unordered_map>
#include <vector>

#include "ig/render/gl_objects.hpp"
#include "terrain/database/database.hpp"

namespace eyepoint::ig {

class ImageStore {
  public:
    explicit ImageStore(std::uint32_t layers);

    /// The layer of a picture, uploaded with its smaller copies if it is not there yet; none when every layer
    /// is in use in this frame.
    [[nodiscard]] std::optional<std::uint32_t> layer_of(const terrain::ImageData& image, std::uint64_t frame);
    [[nodiscard]] GLuint texture() const { return texture_.name(); }
    [[nodiscard]] std::uint64_t uploads() const { return uploads_; }

  private:
    struct Layer {
        terrain::TileId tile;
        std::uint64_t used_frame = 0;
        bool occupied = false;
    };
    void upload(const terrain::ImageData& image, std::uint32_t layer);

    GlTexture texture_;
    std::vector<Layer> layers_;
    std::unordered_map<terrain::TileId, std::uint32_t, terrain::TileHash> layer_by_tile_;
    std::uint64_t uploads_ = 0;
};

}  // namespace eyepoint::ig
