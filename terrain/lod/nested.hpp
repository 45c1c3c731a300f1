/// Nested meshes: blocks and levels chosen by the eye's distance alone, with a cache of choices that costs
/// one comparison a block while the eye is too near where it was to change them.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "terrain/lod/cell_cut.hpp"
#include "terrain/lod/error_level.hpp"
#include "terrain/lod/horizon_culling.hpp"
#include "terrain/lod/lod_method.hpp"

namespace eyepoint::terrain {

/// How it chooses. The drawn surface is a function of the eye (nested_motion.hpp); blocks and lists are only
/// how it is drawn. From the roots down, with lambda the level asked for at the distance of a tile's box: the
/// tile is drawn, with the list of level min(floor(lambda), last_level), where lambda >= first_level or there
/// is nothing finer; else its four children are, or, until all four are loaded, the tile at its first level
/// ("starved": nested_floors.hpp sees to its neighbours). Tiles outside the view or behind the curve of the
/// Earth are left out. There is no balancing. Blocks are then cut into cells (cell_cut.hpp).
///
/// LOD cache. A list of level k is right while every point of the tile is at least R_k = kappa E_k / (tau +
/// s) away. Chosen with the box at D0 and the eye's odometer (length of its path) at o0, it stands while D0 -
/// (o - o0) >= R_k, because the eye has come nearer by at most its path (triangle inequality): this holds for
/// an eye inside the box, at any speed, for a jump. A choice is made with tau, so a slack s buys it a path of
/// R_k s / tau. It is made anew, too, when the next coarser one could be right, D0 + (o - o0) >= R_(k+1) by
/// tau alone, or it would draw too much. R is this frame's: tau, s and kappa may change from frame to frame.
class NestedLod final : public LodMethod {
  public:
    /// reuse: false makes every choice anew in every frame. cull: leave out what nearer terrain hides
    /// (horizon_culling.hpp); it takes blocks with bounds (PagerOptions::cell_bounds). cut: false draws whole
    /// blocks. The picture is the same with and without, but the drawn mesh has gaps where it is not seen.
    explicit NestedLod(bool reuse = true, bool cull = false, bool cut = true)
        : reuse_(reuse), cull_(cull), cut_(cut) {}
    [[nodiscard]] std::string_view name() const override { return "nested"; }
    [[nodiscard]] MeshKind mesh_kind() const override { return MeshKind::Nested; }
    [[nodiscard]] std::span<const std::uint16_t> indices() const override { return {}; }
    [[nodiscard]] const Selection& select(const LodView& view, TileTree& tree, std::uint64_t frame) override;

  private:
    struct Frame;
    static constexpr std::int32_t kNone = -1;
    static constexpr std::size_t kAlways = 64;  ///< in the tables of distances: passed anywhere
    static constexpr std::size_t kNever = 65;   ///< nowhere

    /// What a steady frame reads of four siblings or the two roots. Their nodes lie in a row.
    struct Quad {
        std::array<double, 4> x{}, y{}, z{};           ///< middle of the box
        std::array<double, 4> radius_m{};              ///< of the sphere around it
        std::array<std::array<float, 4>, 9> half_m{};  ///< half sides: three vectors, by component
        std::array<double, 4> near_m{};                ///< distance at the choice + odometer then
        std::array<double, 4> far_m{};                 ///< distance at the choice - odometer then
        std::array<double, 4> slide_within_m{};     ///< what vertices may slide up to the tile's last level
        std::array<double, 4> texel_m{};            ///< of its picture; -infinity for none finer below
        std::array<std::uint8_t, 4> split_until{};  ///< the level from which on it will do
        std::array<IndexRange, 4> range{};          ///< of the list chosen
        std::array<std::uint8_t, 4> level{};        ///< of the list chosen
        std::array<std::uint8_t, 4> nearest{};      ///< row of `nearer_m`: nearer than that, choose anew
        std::array<std::uint8_t, 4> farthest{};     ///< row of `farther_m`
        std::array<bool, 4> chosen{};
        std::array<bool, 4> split{};
        std::array<std::int32_t, 4> children{kNone, kNone, kNone, kNone};
        TileNode* nodes = nullptr;
        std::uint32_t count = 0;
        bool loaded = false;                        ///< all blocks are
        std::uint64_t changes = ~std::uint64_t{0};  ///< of the tree, when `loaded` was seen
        std::uint64_t used_frame = 0;               ///< when the nodes were told that they are in use
    };
    /// Still to do: a tile to draw, or (lane kWhole) a quad to look into.
    struct Pending {
        std::int32_t quad = 0;
        std::uint8_t lane = 0;
        std::uint8_t planes = 0;  ///< bit n: may be cut by side n of the view
    };
    static constexpr std::uint8_t kWhole = 4;

    std::int32_t add(TileNode* nodes, std::uint32_t count);
    void refresh(Quad& quad, const Frame& frame);
    void look_into(const Frame& frame, const Pending& pending);
    [[nodiscard]] bool stands(const Quad& quad, std::size_t lane, const Frame& frame) const;
    void choose(std::int32_t quad, std::size_t lane, const Frame& frame);
    [[nodiscard]] Pending next_of(std::int32_t quad, std::size_t lane, std::uint8_t planes,
                                  const Frame& frame);
    void draw(const Pending& pending, const Frame& frame);
    void wish(const Quad& quad, std::size_t lane, const Frame& frame);

    bool reuse_, cull_, cut_;
    CellCut cutting_;
    HorizonCulling culling_;
    const TileTree* tree_ = nullptr;
    Ecef eye_{0.0};
    double odometer_m_ = 0.0;
    std::vector<Quad> quads_;
    std::vector<Pending> pending_;
    std::vector<std::uint32_t> starved_;  ///< draws
    std::vector<std::uint8_t> sides_;     ///< by draw: of the view, that may cut it
    Selection selection_;
};

}  // namespace eyepoint::terrain
