/// The pager: loads blocks on its own threads, most wanted first, within a memory budget. The frame never
/// waits.
#pragma once

#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <span>
#include <string>
#include <thread>
#include <unordered_set>
#include <vector>

#include <tl/expected.hpp>

#include "terrain/pager/tile_tree.hpp"

namespace eyepoint::terrain {

/// A block is kept this many frames after its last use even over budget: a view that flickers between two
/// tiles must not load them over and over.
inline constexpr std::uint64_t kKeepFrames = 60;

/// How one block was loaded, and when, by the steady clock.
struct BlockLoad {
    TileId tile;
    bool stored = false;  ///< in the database; otherwise made from the parent
    unsigned thread = 0;  ///< loader threads, counted from 0
    std::chrono::steady_clock::time_point began;
    std::chrono::steady_clock::time_point read;  ///< its content was there; then it was unfolded
    std::chrono::steady_clock::time_point done;
};

struct PagerOptions {
    unsigned threads = 1;
    MeshKind mesh = MeshKind::Grid;  ///< what blocks are unfolded to
    bool cell_bounds = false;        ///< nested blocks get Block::bounds, for horizon culling
    /// Loaded blocks kept, bytes. Blocks in use are never dropped, so a view that needs more gets more.
    std::uint64_t cache_bytes = 512ULL << 20;
    /// Tiles down to this depth are the base: loaded before create() returns, and never dropped. Wherever an
    /// eye appears, a globe is there at once that is as good as they are.
    std::uint32_t base_depth = 0;
    /// Called after each load, before it can be published, on its loader thread, so by several at once (for
    /// the base, by create() as thread 0, before there are any); empty: not called. It may not call the
    /// pager.
    std::function<void(const BlockLoad&)> on_load{};
};

/// A tile that a view would draw if it were loaded. Its parent's block is loaded.
struct BlockRequest {
    TileNode* node = nullptr;
    double priority = 0.0;  ///< greater is sooner
};

struct PagerCounters {
    std::uint64_t loaded = 0;
    std::uint64_t interpolated = 0;  ///< of loaded: made from the parent, not read
    std::uint64_t unreadable = 0;
    std::uint64_t evicted = 0;
    std::uint64_t blocks = 0;  ///< in memory now
    std::uint64_t bytes = 0;   ///< in memory now
};

/// Thread use: every member from one thread (the frame's); the loader threads are inside.
class Pager {
  public:
    /// Loads the blocks of the base before it returns; fails with one sentence if a root cannot be read.
    [[nodiscard]] static tl::expected<std::unique_ptr<Pager>, std::string> create(
        std::shared_ptr<const Database> database, const PagerOptions& options);
    ~Pager();
    Pager(const Pager&) = delete;
    Pager& operator=(const Pager&) = delete;

    [[nodiscard]] TileTree& tree() { return tree_; }

    /// Replaces the list of wishes. Loads that have begun go on.
    void request(std::span<const BlockRequest> wishes);
    /// Hands at most so many finished blocks to the tree, drops the longest unused beyond the budget, and
    /// returns how many tiles became drawable or known to be unreadable.
    std::size_t publish(std::size_t most_blocks, std::uint64_t frame);
    /// Waits until everything wished for has been loaded or found unreadable; true if there is something to
    /// publish.
    bool wait_for_loads();
    /// Wishes and loads under way, and finished ones not yet published.
    [[nodiscard]] std::size_t pending() const;
    [[nodiscard]] const PagerCounters& counters() const { return counters_; }
    /// Sentences about tiles that could not be read, each tile once; taken, they are gone.
    [[nodiscard]] std::vector<std::string> take_faults();

  private:
    struct Job {
        TileId tile;
        bool stored = false;
        NodeInfo info;
        std::shared_ptr<const Block> parent;
        double priority = 0.0;
    };
    struct Finished {
        TileId tile;
        bool stored = false;
        tl::expected<std::shared_ptr<const Block>, std::string> block;
    };

    /// What the database holds of a tile, decoded; or made from the parent.
    struct Content {
        BlockData data;
        std::optional<NestedMesh> mesh;  ///< of nested blocks
        std::optional<ImageData> image;
    };

    Pager(std::shared_ptr<const Database> database, const PagerOptions& options);
    void run(const std::stop_token& stop, unsigned thread);
    [[nodiscard]] Finished load(const Job& job, unsigned thread) const;
    [[nodiscard]] tl::expected<Content, std::string> read(const Job& job) const;
    [[nodiscard]] tl::expected<Content, std::string> interpolate(const Job& job) const;
    [[nodiscard]] std::shared_ptr<const Block> unfold_content(const Job& job, Content content) const;
    void load_base(TileNode& node);
    void place(Finished finished, std::uint64_t frame);
    void evict(std::uint64_t frame);

    std::shared_ptr<const Database> database_;
    PagerOptions options_;
    TileTree tree_;
    PagerCounters counters_;
    std::vector<std::string> faults_;

    mutable std::mutex mutex_;
    std::condition_variable_any work_;
    std::condition_variable done_;
    std::vector<Job> queue_;  ///< least wanted first
    std::unordered_set<TileId, TileHash> under_way_;
    std::vector<Finished> finished_;
    std::vector<std::jthread> threads_;  ///< last: they stop before what they use is gone
};

}  // namespace eyepoint::terrain
