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
#include "tools/terrain/nest/nest.hpp"

namespace eyepoint::tools {

using namespace terrain;

namespace {

constexpr const char* kInterrupted = "the build was interrupted";

/// Tiles done of the tiles to do, when every tile is done twice: heights, then mesh.
class Progress {
  public:
    Progress(const CompileRequest& request, std::uint64_t tiles) : request_(request), tiles_(tiles) {}
    void tile_done() {
        const std::uint64_t done = ++done_;
        if (std::this_thread::get_id() == caller_ && request_.progress) request_.progress(done / 2, tiles_);
    }

  private:
    const CompileRequest& request_;
    std::uint64_t tiles_;
    std::thread::id caller_ = std::this_thread::get_id();
    std::atomic<std::uint64_t> done_ = 0;
};

/// The heights of all tiles, in a database of their own beside the final one while that is made; removed at
/// the end.
class HeightsFolder {
  public:
    explicit HeightsFolder(const std::filesystem::path& output) : path_(output.string() + ".heights") {}
    ~HeightsFolder() {
        std::error_code ignored;
        std::filesystem::remove_all(path_, ignored);
    }
    HeightsFolder(const HeightsFolder&) = delete;
    HeightsFolder& operator=(const HeightsFolder&) = delete;
    [[nodiscard]] const std::filesystem::path& path() const { return path_; }

  private:
    std::filesystem::path path_;
};

/// One run over the tree, depth first: a tile's block is made from its parent's, its children are compiled in
/// parallel, and on the way back up its node is known and it is written. So memory holds paths, not the tree.
class Compilation {
  public:
    Compilation(const CompileRequest& request, const TilePlan& plan, DatabaseWriter& writer,
                Progress& progress)
        : request_(request),
          plan_(plan),
          writer_(writer),
          progress_(progress),
          maker_(plan, *request.elevation, request.height_step_m) {}

    [[nodiscard]] tl::expected<void, std::string> run() {
        tbb::parallel_for(0U, 2U, [this](std::uint32_t x) { (void)compile({0, x, 0}, nullptr, {}); });
        if (!failure_.empty()) return tl::unexpected(failure_);
        return {};
    }

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
        if (auto written = writer_.put({info, &data, nullptr, std::nullopt}); !written)
            return stop(written.error());
        progress_.tile_done();
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

    bool has_stopped() {
        if (!stopped_ && request_.cancelled && request_.cancelled()) (void)stop(kInterrupted);
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
    Progress& progress_;
    BlockMaker maker_;
    std::atomic<bool> stopped_ = false;
    std::mutex mutex_;
    std::string failure_;
};

/// Writes the heights as a database without meshes and pictures, and opens it.
tl::expected<Database, std::string> make_heights(const CompileRequest& request, const TilePlan& plan,
                                                 const std::filesystem::path& folder, Progress& progress) {
    auto writer = DatabaseWriter::create(folder, request.height_step_m);
    if (!writer) return tl::unexpected(writer.error());
    Compilation compilation{request, plan, *writer, progress};
    if (auto done = compilation.run(); !done) return tl::unexpected(done.error());
    Manifest manifest;
    manifest.height_step_m = request.height_step_m;
    manifest.max_depth = plan.max_depth();
    manifest.tiles = plan.tiles();
    manifest.detail_extent = plan.deepest_extent();
    if (auto written = writer->commit(manifest); !written) return tl::unexpected(written.error());
    return Database::open(folder);
}

/// The picture of a tile, where it has one.
std::optional<std::vector<std::uint8_t>> picture(const CompileRequest& request, TileId tile) {
    if (request.imagery == nullptr || (tile.depth > 0 && !request.imagery->has_detail(tile)))
        return std::nullopt;
    std::vector<std::uint8_t> rgb(std::size_t{kImageTexels} * kImageTexels * 3);
    const auto sides = extent(tile);
    request.imagery->sample({sides.south_deg, sides.west_deg, tile_side_deg(tile.depth) / (kImageTexels - 1),
                             kImageTexels, kImageTexels},
                            rgb);
    return rgb;
}

}  // namespace

tl::expected<Manifest, std::string> compile_database(const CompileRequest& request) {
    auto writer = DatabaseWriter::create(request.output, request.height_step_m);
    if (!writer) return tl::unexpected(writer.error());
    const TilePlan plan{*request.elevation, request.imagery, request.cancelled};
    Progress progress{request, plan.tiles()};
    const HeightsFolder folder{request.output};
    const auto heights = make_heights(request, plan, folder.path(), progress);
    if (!heights) return tl::unexpected(heights.error());

    std::atomic<std::uint64_t> images = 0;
    const auto put = [&](const NestedTile& tile) -> tl::expected<void, std::string> {
        if (request.cancelled && request.cancelled()) return tl::unexpected(std::string{kInterrupted});
        const auto rgb = picture(request, tile.block.tile);
        images += rgb ? 1 : 0;
        progress.tile_done();
        return writer->put({tile.info, &tile.block, &tile.mesh, rgb});
    };
    if (auto made = make_nested_meshes(*heights, put); !made) return tl::unexpected(made.error());

    Manifest manifest = request.manifest;
    manifest.height_step_m = request.height_step_m;
    manifest.max_depth = plan.max_depth();
    manifest.tiles = plan.tiles();
    manifest.image_tiles = images;
    if (!(manifest.detail_extent.west_deg < manifest.detail_extent.east_deg)) {
        manifest.detail_extent = plan.deepest_extent();
    }
    if (auto written = writer->commit(manifest); !written) return tl::unexpected(written.error());
    if (request.progress) request.progress(manifest.tiles, manifest.tiles);
    return manifest;
}

}  // namespace eyepoint::tools
