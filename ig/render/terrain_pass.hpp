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

    /// Needs the frame's uniforms bound. Uploads what is not on the card yet, then draws all blocks at once.
    /// Fills in triangles, draws, blocks and uploads of the statistics it returns.
    [[nodiscard]] FrameStatistics draw(const terrain::Selection& selection, std::uint64_t frame);

  private:
    /// std430 layout of BlockRecord in terrain.vert.glsl.
    struct BlockRecord {
        glm::vec4 image;
        glm::vec4 noise;
    };

    TerrainPass(GlProgram program, std::span<const std::uint16_t> indices);
    [[nodiscard]] BlockRecord describe(const terrain::TileNode& node, std::uint64_t frame);
    void upload(const terrain::Selection& selection, std::uint64_t frame);

    GlProgram program_;
    GlVertexArray layout_;
    GlBuffer indices_;
    GlBuffer record_buffer_;
    GlTexture noise_;
    BlockStore blocks_;
    ImageStore images_;
    std::vector<BlockRecord> records_;  ///< by slot
    std::vector<GLsizei> counts_;
    std::vector<const void*> offsets_;
    std::vector<GLint> base_vertices_;
};

}  // namespace eyepoint::ig
