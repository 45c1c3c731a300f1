#include "tools/terrain/compile.hpp"

#include <array>
#include <atomic>
#include <mutex>
#include <optional>
#include <thread>
#include <utility>

#include <tbb/parallel_for.h>

#include "terrain/database/database_writer.hpp"
#include "tools/terrain/compile_block.hpp"
#include "tools/terrain/compile_error.hpp"
#include "tools/terrain/compile_plan.hpp"

namespace eyepoint::tools {

using namespace terrain;

namespace {

/// One run over the tree, depth first: a tile's block is made from its parent's, its children are compiled in
/// parallel, and on the way back up its node is known and it is written. So memory holds paths, not the tree.
class Compilation {
  public:
    Compilation(const CompileRequest& request, const TilePlan& plan, DatabaseWriter& writer)
        : request_(request),
          plan_(plan),
          writer_(writer),
          maker_(plan, *request.elevation, request.height_step_m) {}

    [[nodiscard]] tl::expected<void, std::string> run() {
        tbb::parallel_for(0U, 2U, [this](std::uint32_t x) { (void)compile({0, x, 0}, nullptr, {}); });
        if (!failure_.empty()) return tl::unexpected(failure_);
        return {};
    }
    [[nodiscard]] std::uint64_t images() const { return images_; }

  private:
    /// Empty when the run has stopped.
    std::optional<SurfaceBounds> compile(TileId tile, const QuantisedBlock* parent,
                                         std::vector<TileCorners> ancestors) {
        if (has_stopped()) return std::nullopt;
        auto block = maker_.make(tile, parent);
        if (!block) return stop(block.error());
        const BlockData data = maker_.finish(*block, *request_.geoid);
        const bool split = plan_.has_children(tile);
        std::optional<SurfaceBounds> below;
        if (split) {
            ancestors.push_back({tile,
                                 {data.height_m(0, 0), data.height_m(0, kBlockCells),
                                  data.height_m(kBlockCells, 0), data.height_m(kBlockCells, kBlockCells)}});
            below = compile_children(*block, ancestors);
            if (!below) return std::nullopt;
        } else {
            below = leaf_bounds(data, ancestors);
        }
        NodeInfo info = node_info(tile, *below);
        info.has_children = split;
        if (auto written = put(data, info); !written) return stop(written.error());
        report_progress();
        return below;
    }

    std::optional<SurfaceBounds> compile_children(const QuantisedBlock& block,
                                                  const std::vector<TileCorners>& ancestors) {
        std::array<std::optional<SurfaceBounds>, 4> parts;
        tbb::parallel_for(0, 4, [&](int i) {
            parts[static_cast<std::size_t>(i)] = compile(child(block.tile, i), &block, ancestors);
        });
        for (std::size_t i = 0; i < 4; ++i) {
            if (!parts[i]) return std::nullopt;
            if (i > 0) parts[0]->merge(*parts[i]);
        }
        return parts[0];
    }

    tl::expected<void, std::string> put(const BlockData& data, const NodeInfo& info) {
        DatabaseWriter::Tile tile{info, &data, nullptr, std::nullopt};
        std::vector<std::uint8_t> rgb;
        if (request_.imagery != nullptr &&
            (data.tile.depth == 0 || request_.imagery->has_detail(data.tile))) {
            rgb.resize(std::size_t{kImageTexels} * kImageTexels * 3);
            const auto sides = extent(data.tile);
            request_.imagery->sample(
                {sides.south_deg, sides.west_deg, tile_side_deg(data.tile.depth) / (kImageTexels - 1),
                 kImageTexels, kImageTexels},
                rgb);
            tile.image_rgb = rgb;
            ++images_;
        }
        return writer_.put(tile);
    }

    void report_progress() {
        const std::uint64_t done = ++done_;
        if (std::this_thread::get_id() != caller_) return;
        if (request_.progress) request_.progress(done, plan_.tiles());
    }

    bool has_stopped() {
        if (!stopped_ && request_.cancelled && request_.cancelled()) (void)stop("the build was interrupted");
        return stopped_;
    }

    std::nullopt_t stop(std::string reason) {
        const std::lock_guard guard{mutex_};
        if (failure_.empty()) failure_ = std::move(reason);
        stopped_ = true;
        return std::nullopt;
    }

    const CompileRequest& request_;
    const TilePlan& plan_;
    DatabaseWriter& writer_;
    BlockMaker maker_;
    std::thread::id caller_ = std::this_thread::get_id();
    std::atomic<std::uint64_t> done_ = 0;
    std::atomic<std::uint64_t> images_ = 0;
    std::atomic<bool> stopped_ = false;
    std::mutex mutex_;
    std::string failure_;
};

}  // namespace

tl::expected<Manifest, std::string> compile_database(const CompileRequest& request) {
    auto writer = DatabaseWriter::create(request.output, request.height_step_m);
    if (!writer) return tl::unexpected(writer.error());
    const TilePlan plan{*request.elevation, request.imagery, request.cancelled};
    Compilation compilation{request, plan, *writer};
    if (auto done = compilation.run(); !done) return tl::unexpected(done.error());

    Manifest manifest = request.manifest;
    manifest.height_step_m = request.height_step_m;
    manifest.max_depth = plan.max_depth();
    manifest.tiles = plan.tiles();
    manifest.image_tiles = compilation.images();
    if (!(manifest.detail_extent.west_deg < manifest.detail_extent.east_deg)) {
        manifest.detail_extent = plan.deepest_extent();
    }
    if (auto written = writer->commit(manifest); !written) return tl::unexpected(written.error());
    if (request.progress) request.progress(manifest.tiles, manifest.tiles);
    return manifest;
}

}  // namespace eyepoint::tools
