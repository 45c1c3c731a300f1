#include "ig/render/draw_list.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "terrain/geodesy/earth.hpp"
#include "terrain/lod/error_level.hpp"
#include "terrain/lod/painted_detail.hpp"

namespace eyepoint::ig {

namespace {

constexpr std::uint32_t kFirstSlots = 1024;
constexpr std::uint32_t kImageLayers = 512;
/// The noise repeats every side of a tile of this depth (0.18 degrees, about 20 km), the same over the whole
/// Earth.
constexpr int kNoiseDepth = 10;

/// Fields of BlockRecord::tree, as in block.glsl.
constexpr std::uint32_t kQuadrantShift = 8;
constexpr std::uint32_t kHasFloors = 1U << 16;
constexpr std::uint32_t kReliefShift = 24;

double fraction(double value) { return value - std::floor(value); }

const terrain::TileNode* nearest_with_image(const terrain::TileNode& node) {
    const terrain::TileNode* candidate = &node;
    while (candidate != nullptr && !(candidate->block && candidate->block->image))
        candidate = candidate->parent;
    return candidate;
}

/// Interpolated tiles have no relief of their own.
const terrain::TileNode& nearest_stored(const terrain::TileNode& node) {
    const terrain::TileNode* candidate = &node;
    while (!candidate->stored && candidate->parent != nullptr) candidate = candidate->parent;
    return *candidate;
}

/// Where what is painted on a tile, in layer or slot `at`, lies for places in the tile or in one below it.
glm::vec4 part_of(terrain::TileId painted, terrain::TileId tile, std::uint32_t at) {
    const double scale = std::ldexp(1.0, static_cast<int>(painted.depth) - static_cast<int>(tile.depth));
    return glm::vec4{glm::dvec4{at, scale, fraction(tile.x * scale), fraction(tile.y * scale)}};
}

/// As in tile_slide.glsl.
glm::uvec4 packed(const terrain::TileSlide& slide) {
    constexpr unsigned kSlidShift = 8, kStitchedShift = 16;
    glm::uvec4 words{slide.level | slide.slid << kSlidShift | slide.stitched << kStitchedShift, 0U, 0U, 0U};
    std::memcpy(&words.y, slide.border.data(), slide.border.size());
    return words;
}

/// Room made for draws at the start: more than views of a thousand blocks have.
constexpr std::size_t kDrawsAtFirst = 4096;

bool any(const terrain::EdgeFloors& floors) {
    return std::any_of(floors.begin(), floors.end(), [](std::uint8_t level) { return level != 0; });
}

bool slides(const terrain::TileSlide& slide) { return slide.slid != 0 || any(slide.border); }

}  // namespace

void DrawCommands::reserve(std::size_t draws) {
    counts.reserve(draws);
    offsets.reserve(draws);
    base_vertices.reserve(draws);
}

void DrawCommands::clear() {
    counts.clear();
    offsets.clear();
    base_vertices.clear();
}

void DrawCommands::add(terrain::IndexRange range, std::uint32_t first_index, std::uint32_t slot) {
    if (range.count == 0) return;  // Mesa 22.3 draws nothing at all where one of several draws is empty
    const std::size_t offset = (std::size_t{first_index} + range.first) * sizeof(std::uint16_t);
    counts.push_back(static_cast<GLsizei>(range.count));
    // NOLINTNEXTLINE(performance-no-int-to-ptr): OpenGL takes offsets into a buffer as pointers.
    offsets.push_back(reinterpret_cast<const void*>(offset));
    base_vertices.push_back(static_cast<GLint>(slot * terrain::kBlockVertices));
}

void DrawCommands::draw() const {
    glMultiDrawElementsBaseVertex(GL_TRIANGLES, counts.data(), GL_UNSIGNED_SHORT, offsets.data(),
                                  static_cast<GLsizei>(counts.size()), base_vertices.data());
}

void SortedCommands::reserve(std::size_t draws) {
    all.reserve(draws);
    for (DrawCommands& commands : by_features) commands.reserve(draws);
}

void SortedCommands::clear() {
    all.clear();
    for (DrawCommands& commands : by_features) commands.clear();
}

DrawList::DrawList(bool nested, int sliding_parts, bool shared_list)
    : nested_(nested),
      parts_(static_cast<std::size_t>(sliding_parts * sliding_parts)),
      shared_list_(shared_list),
      blocks_(kFirstSlots),
      images_(kImageLayers),
      record_words_(GLenum{GL_TEXTURE_BUFFER}) {
    others_.reserve(kDrawsAtFirst);
    if (parts_ > 0) sliding_.reserve(kDrawsAtFirst);
}

std::uint64_t DrawList::uploaded_bytes() const {
    constexpr std::uint64_t kImageBytes = std::uint64_t{terrain::kImageTexels} * terrain::kImageTexels * 4;
    return blocks_.uploaded_bytes() + images_.uploads() * kImageBytes;
}

void DrawList::update(const terrain::Selection& selection, std::uint64_t frame) {
    all_.clear();
    sliding_.clear();
    others_.clear();
    features_ = 0;
    blocks_drawn_ = 0;
    const terrain::TileNode* node = nullptr;
    std::uint32_t slot = 0;
    for (const terrain::BlockDraw& draw : selection.draws) {
        if (draw.node != node) slot = place(*draw.node, frame);
        node = draw.node;
        if (drawn_in_frame_[slot] != frame) describe_drawn(draw, slot, frame);
        if (parts_ > 0) slides_[slot * parts_ + draw.slide.part] = packed(draw.slide);
        if (draw.mesh != nullptr) blocks_.set_list(slot, *draw.mesh);
        add(draw, slot);
    }
    send_records();
}

/// The block's slot in this frame; in a nested mesh the ancestors have theirs too, and their records say so.
std::uint32_t DrawList::place(const terrain::TileNode& node, std::uint64_t frame) {
    const std::uint32_t slot = blocks_.slot_of(*node.block, frame);
    if (blocks_.slots() > records_.size()) {
        records_.resize(blocks_.slots());
        placed_in_frame_.resize(blocks_.slots());
        drawn_in_frame_.resize(blocks_.slots());
        slides_.resize(blocks_.slots() * parts_);
    }
    if (!nested_ || placed_in_frame_[slot] == frame) return slot;
    placed_in_frame_[slot] = frame;
    const std::uint32_t parent = node.parent != nullptr ? place(*node.parent, frame) + 1 : kNoSlot;
    const std::uint32_t quadrant = static_cast<std::uint32_t>(terrain::quadrant(node.tile));
    const std::uint32_t last_level = node.block->last_level,
                        relief_level = node.parent != nullptr ? terrain::relief_level(node.parent->tile) : 0U;
    records_[slot].tree = {
        parent, last_level | quadrant << kQuadrantShift | std::max(last_level, relief_level) << kReliefShift,
        0U, 0U};
    return slot;
}

void DrawList::describe_drawn(const terrain::BlockDraw& draw, std::uint32_t slot, std::uint64_t frame) {
    drawn_in_frame_[slot] = frame;
    ++blocks_drawn_;
    const glm::uvec4 tree = records_[slot].tree;
    records_[slot] = describe(*draw.node, frame);
    records_[slot].tree = tree;
    if (any(draw.floors)) {
        records_[slot].tree.y |= kHasFloors;
        std::memcpy(&records_[slot].tree.z, draw.floors.data(), draw.floors.size());
    }
}

DrawList::BlockRecord DrawList::describe(const terrain::TileNode& node, std::uint64_t frame) {
    BlockRecord record{{-1.0F, 1.0F, 0.0F, 0.0F}, {1.0F, 0.0F, 0.0F, 0.0F}, {}, {kNoSlot, 0U, 0U, 0U}};
    const auto depth = static_cast<int>(node.tile.depth);
    const double noise_scale = std::ldexp(1.0, kNoiseDepth - depth);
    record.noise = glm::vec4{glm::dvec4{noise_scale, fraction(node.tile.x * noise_scale),
                                        fraction(node.tile.y * noise_scale), 0.0}};
    const terrain::TileNode& surveyed = nearest_stored(node);
    record.relief = part_of(surveyed.tile, node.tile, place(surveyed, frame));
    if (const terrain::TileNode* pictured = nearest_with_image(node)) {
        const auto layer = images_.layer_of(*pictured->block->image, frame);
        const double texel_m =
            terrain::tile_side_deg(pictured->tile.depth) / terrain::kImageTexels * terrain::kMetresPerDegree;
        if (layer) record.image = part_of(pictured->tile, node.tile, *layer);
        record.noise.w = static_cast<float>(texel_m);
    }
    return record;
}

/// Of a nested mesh, the parent's relief may show.
bool DrawList::paints_water(const terrain::TileNode& node) const {
    return nearest_stored(node).block->has_water ||
           (nested_ && node.parent != nullptr && node.parent->block->has_water);
}

std::size_t DrawList::features_of(const terrain::BlockDraw& draw, std::uint32_t slot) const {
    return (paints_water(*draw.node) ? kWaterFeature : 0) +
           (records_[slot].image.x >= 0.0F ? kImageFeature : 0);
}

void DrawList::add(const terrain::BlockDraw& draw, std::uint32_t slot) {
    const std::size_t set = features_of(draw, slot);
    const std::uint32_t first_index = shared_list_ ? 0 : blocks_.first_index(slot);
    features_ |= set;
    all_.add(draw.indices, first_index, slot);
    SortedCommands& sorted = parts_ > 0 && slides(draw.slide) ? sliding_ : others_;
    sorted.all.add(draw.indices, first_index, slot);
    sorted.by_features[set].add(draw.indices, first_index, slot);
}

void DrawList::send_records() {
    glNamedBufferData(record_buffer_.name(), static_cast<GLsizeiptr>(records_.size() * sizeof(BlockRecord)),
                      records_.data(), GL_STREAM_DRAW);
    glTextureBuffer(record_words_.name(), GL_RGBA32UI, record_buffer_.name());
    if (slides_.empty()) return;
    glNamedBufferData(slide_buffer_.name(), static_cast<GLsizeiptr>(slides_.size() * sizeof(glm::uvec4)),
                      slides_.data(), GL_STREAM_DRAW);
}

}  // namespace eyepoint::ig
