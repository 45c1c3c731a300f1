/// Draws a selection of blocks.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include <glm/vec4.hpp>
#include <tl/expected.hpp>

#include "ig/frame_statistics.hpp"
#include "ig/render/block_store.hpp"
#include "ig/render/gl_objects.hpp"
#include "ig/render/image_store.hpp"
#include "terrain/lod/lod_method.hpp"

namespace eyepoint::ig {

class TerrainPass {
  public:
    /// indices: the LOD method's index list, copied to the graphics card.
    [[nodiscard]] static tl::expected<TerrainPass, std::string> create(
        std::span<const std::uint16_t> indices);

    /// Draws one triangle of a selection's first block with every shader, so that no later frame pays for a
    /// first use.
    void warm_up(const terrain::Selection& selection, std::uint64_t frame);

    /// Needs the frame's uniforms bound. Uploads what is not on the card yet, then draws all blocks at once.
    /// Fills in triangles, draws, blocks and uploads of the statistics it returns.
    [[nodiscard]] FrameStatistics draw(const terrain::Selection& selection, std::uint64_t frame);

  private:
    /// std430 layout of BlockRecord in terrain.vert.glsl.
    struct BlockRecord {
        glm::vec4 image;
        glm::vec4 noise;
    };

    /// Blocks with water and blocks with pictures have shaders of their own, so that the others do not pay
    /// for them.
    static constexpr std::size_t kWater = 1;
    static constexpr std::size_t kImage = 2;
    static constexpr std::size_t kVariants = 4;
    struct Variant {
        GlProgram program;
        std::vector<GLsizei> counts;
        std::vector<const void*> offsets;
        std::vector<GLint> base_vertices;
    };

    TerrainPass(std::vector<Variant> variants, std::span<const std::uint16_t> indices);
    [[nodiscard]] BlockRecord describe(const terrain::TileNode& node, std::uint64_t frame);
    void upload(const terrain::Selection& selection, std::uint64_t frame);
    void bind() const;

    std::vector<Variant> variants_;  ///< by the sum of their features
    GlVertexArray layout_;
    GlBuffer indices_;
    GlBuffer record_buffer_;
    GlTexture noise_;
    BlockStore blocks_;
    ImageStore images_;
    std::vector<BlockRecord> records_;  ///< by slot
};

}  // namespace eyepoint::ig
