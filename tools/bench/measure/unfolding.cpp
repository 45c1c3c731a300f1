#include "tools/bench/measure/unfolding.hpp"

#include <algorithm>
#include <map>
#include <memory>
#include <vector>

#include "ig/process_usage.hpp"
#include "terrain/block/block.hpp"

namespace eyepoint::tools {

namespace {

using terrain::Block;
using terrain::TileId;

/// Unfolds tiles with their ancestors, each once.
class Unfolder {
  public:
    explicit Unfolder(const terrain::Database& database) : database_(database) {}

    tl::expected<std::shared_ptr<const Block>, std::string> unfold(TileId tile) {
        if (const auto done = blocks_.find(tile); done != blocks_.end()) return done->second;
        std::shared_ptr<const Block> above;
        if (tile.depth > 0) {
            auto unfolded = unfold(parent(tile));
            if (!unfolded) return unfolded;
            above = *unfolded;
        }
        const double start_ms = ig::thread_cpu_ms();
        auto block = database_.read_block(tile);
        if (!block) return tl::unexpected(block.error());
        const auto mesh = database_.read_mesh(tile);
        if (!mesh) return tl::unexpected(mesh.error());
        const double read_ms = ig::thread_cpu_ms();
        auto unfolded =
            terrain::unfold(std::move(*block), *database_.find(tile), *mesh, above.get(), std::nullopt);
        unfold_ms_.push_back(ig::thread_cpu_ms() - read_ms);
        read_ms_.push_back(read_ms - start_ms);
        return blocks_.emplace(tile, std::move(unfolded)).first->second;
    }

    [[nodiscard]] std::vector<double>& unfold_ms() { return unfold_ms_; }
    [[nodiscard]] std::vector<double>& read_ms() { return read_ms_; }

  private:
    const terrain::Database& database_;
    std::map<TileId, std::shared_ptr<const Block>> blocks_;
    std::vector<double> unfold_ms_, read_ms_;
};

}  // namespace

tl::expected<UnfoldingTimes, std::string> time_unfolding(const terrain::Database& database,
                                                         std::size_t tiles) {
    std::vector<TileId> all = database.tiles();
    std::sort(all.begin(), all.end());
    Unfolder unfolder(database);
    const std::size_t step = std::max<std::size_t>(all.size() / std::max<std::size_t>(tiles, 1), 1);
    for (std::size_t i = 0; i < all.size(); i += step) {
        if (const auto unfolded = unfolder.unfold(all[i]); !unfolded) return tl::unexpected(unfolded.error());
    }
    std::vector<double>&unfolds = unfolder.unfold_ms(), &reads = unfolder.read_ms();
    std::sort(unfolds.begin(), unfolds.end());
    std::sort(reads.begin(), reads.end());
    const double posts = static_cast<double>(all.size()) * terrain::kBlockCells * terrain::kBlockCells;
    return UnfoldingTimes{unfolds.size(), unfolds[unfolds.size() / 2], unfolds.back(),
                          reads[reads.size() / 2],
                          8.0 * static_cast<double>(database.stored_bytes().meshes) / posts};
}

}  // namespace eyepoint::tools
