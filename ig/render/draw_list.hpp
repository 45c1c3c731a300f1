/// A selection of blocks as the graphics card draws it: content in its slots, a record a block, and the
/// commands.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include <glm/vec4.hpp>

#include "ig/render/block_store.hpp"
#include "ig/render/gl_objects.hpp"
#include "ig/render/image_store.hpp"
#include "ig/render/program.hpp"
#include "terrain/lod/lod_method.hpp"

namespace eyepoint::ig {

/// Draws of one glMultiDrawElementsBaseVertex.
struct DrawCommands {
    std::vector<GLsizei> counts;
    std::vector<const void*> offsets;
    std::vector<GLint> base_vertices;

    void reserve(std::size_t draws);
    void clear();
    void add(terrain::IndexRange range, std::uint32_t first_index, std::uint32_t slot);
    void draw() const;
    [[nodiscard]] bool empty() const { return counts.empty(); }
};

/// Draws, near to far, and by the set of features that they need.
struct SortedCommands {
    DrawCommands all;
    std::array<DrawCommands, kFeatureSets> by_features;

    void reserve(std::size_t draws);
    void clear();
};

class DrawList {
  public:
    /// std430 layout of BlockRecord in block.glsl.
    struct BlockRecord {
        glm::vec4 image;
        glm::vec4 noise;
        glm::vec4 relief;
        glm::uvec4 tree;
    };
    /// First word of BlockRecord::tree: a parent's slot + 1, or this. Zero, so that a vertex shader that
    /// reads zeros for a record finds no parent: llvmpipe (Mesa 22.3) runs the lanes that only fill up a
    /// vector of vertices too, with zeros for every record. Were zero a slot, such a lane could climb from it
    /// to itself for ever; Mesa ends the loops of the whole vector after 65535 turns, and the vertices in it
    /// are wrong.
    static constexpr std::uint32_t kNoSlot = 0;

    /// nested: a drawn block's ancestors are there with it, for the walk of nested.glsl. sliding_parts:
    /// LodMethod's. shared_list: all draws refer to one list, that the caller binds; otherwise to their
    /// blocks' (block_store()).
    DrawList(bool nested, int sliding_parts, bool shared_list);

    /// Takes in a selection: uploads what is not on the card yet.
    void update(const terrain::Selection& selection, std::uint64_t frame);

    /// All draws, near to far.
    [[nodiscard]] const DrawCommands& all() const { return all_; }
    /// Those of them whose vertices slide by tile_slide.glsl, and the rest.
    [[nodiscard]] const SortedCommands& sliding() const { return sliding_; }
    [[nodiscard]] const SortedCommands& others() const { return others_; }
    /// Set of all features that any draw needs.
    [[nodiscard]] std::size_t features() const { return features_; }
    [[nodiscard]] std::uint32_t blocks() const { return blocks_drawn_; }

    [[nodiscard]] const BlockStore& block_store() const { return blocks_; }
    [[nodiscard]] const ImageStore& images() const { return images_; }
    /// BlockRecord by slot (block.glsl), of the blocks of the last update.
    [[nodiscard]] GLuint record_buffer() const { return record_buffer_.name(); }
    /// The same as a buffer texture, GL_RGBA32UI: four texels a record.
    [[nodiscard]] GLuint record_words() const { return record_words_.name(); }
    /// TileSlide by slot and part (tile_slide.glsl), of the blocks of the last update.
    [[nodiscard]] GLuint slide_buffer() const { return slide_buffer_.name(); }
    /// Sent to the card since the list was made.
    [[nodiscard]] std::uint64_t uploaded_blocks() const { return blocks_.uploads(); }
    [[nodiscard]] std::uint64_t uploaded_bytes() const;

    /// Of the last update: the slot of its nth draw, a slot's record, and what set of features a draw needs.
    [[nodiscard]] std::uint32_t slot(std::size_t draw) const {
        return static_cast<std::uint32_t>(all_.base_vertices[draw]) / terrain::kBlockVertices;
    }
    [[nodiscard]] const BlockRecord& record(std::uint32_t slot) const { return records_[slot]; }
    [[nodiscard]] std::size_t features_of(const terrain::BlockDraw& draw, std::uint32_t slot) const;

  private:
    [[nodiscard]] std::uint32_t place(const terrain::TileNode& node, std::uint64_t frame);
    [[nodiscard]] BlockRecord describe(const terrain::TileNode& node, std::uint64_t frame);
    void describe_drawn(const terrain::BlockDraw& draw, std::uint32_t slot, std::uint64_t frame);
    void add(const terrain::BlockDraw& draw, std::uint32_t slot);
    [[nodiscard]] bool paints_water(const terrain::TileNode& node) const;
    void send_records();

    bool nested_;
    std::size_t parts_;  ///< of a block, that slide by themselves
    bool shared_list_;
    BlockStore blocks_;
    ImageStore images_;
    GlBuffer record_buffer_;
    GlTexture record_words_;
    std::vector<BlockRecord> records_;  ///< by slot
    GlBuffer slide_buffer_;
    std::vector<glm::uvec4> slides_;              ///< by slot and part
    std::vector<std::uint64_t> placed_in_frame_;  ///< by slot: the record's tree part is of that frame
    std::vector<std::uint64_t> drawn_in_frame_;   ///< by slot: all of the record is
    DrawCommands all_;
    SortedCommands sliding_, others_;
    std::size_t features_ = 0;
    std::uint32_t blocks_drawn_ = 0;
};

}  // namespace eyepoint::ig
