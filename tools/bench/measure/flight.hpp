/// A flight without drawing: a database, its pager and a level-of-detail method, and what selection takes.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <unordered_map>
#include <unordered_set>

#include <tl/expected.hpp>

#include "terrain/lod/lod_method.hpp"
#include "terrain/pager/pager.hpp"

namespace eyepoint::tools {

struct FlightOptions {
    std::string lod_method = "nested";
    bool cull = false;  ///< nested alone: leave out what nearer terrain hides; the drawn mesh has gaps there
    std::uint32_t triangle_budget = 0;  ///< terrain::LodMethodOptions
    terrain::selective::Options selective{};
    terrain::tiles::Options tile{};
    terrain::hyperblock::Options hyperblock{};
    unsigned loader_threads = 1;
    std::uint64_t block_cache_bytes =
        8ULL << 30;  ///< so much that a path flown twice loads nothing the second time
    /// Heap allocations of the calling thread so far; nullptr: not counted.
    std::uint64_t (*allocations)() = nullptr;
};

/// What one call of the method took.
struct SelectionWork {
    double cpu_ns = 0.0;  ///< by the thread's clock
    std::uint64_t allocations = 0;
    std::uint64_t blocks_wished = 0;  ///< not loaded: the selection makes do without them
    /// Of blocks that no earlier frame has drawn, and of lists made for blocks that none has drawn so.
    std::uint64_t uploaded_bytes = 0;
};

/// Thread use: one thread.
class LodFlight {
  public:
    /// On failure: one sentence.
    [[nodiscard]] static tl::expected<std::unique_ptr<LodFlight>, std::string> create(
        std::shared_ptr<const terrain::Database> database, const FlightOptions& options);

    [[nodiscard]] const terrain::LodMethod& method() const { return *method_; }

    /// Selects once, as a frame does, and asks the pager for what is missing.
    const terrain::Selection& select(const terrain::LodView& view);
    /// Of the last select().
    [[nodiscard]] const SelectionWork& work() const { return work_; }
    /// From here on, every block counts as not drawn before.
    void forget_uploads() {
        uploaded_.clear();
        mesh_versions_.clear();
    }
    /// Selects, and loads, until nothing that can be read is missing. The last selection.
    const terrain::Selection& settle(const terrain::LodView& view);

  private:
    LodFlight(std::unique_ptr<terrain::Pager> pager, std::unique_ptr<terrain::LodMethod> method,
              std::uint64_t (*allocations)());
    /// What select() measures and settle() does not call, by itself: a profiler can count in it alone.
    const terrain::Selection& choose(const terrain::LodView& view);
    [[nodiscard]] std::uint64_t count_uploads(const terrain::Selection& selection);

    std::unique_ptr<terrain::Pager> pager_;
    std::unique_ptr<terrain::LodMethod> method_;
    std::uint64_t (*allocations_)();
    std::uint64_t frame_ = 0;
    SelectionWork work_;
    std::unordered_set<const terrain::Block*> uploaded_;
    std::unordered_map<const terrain::Block*, std::uint64_t> mesh_versions_;  ///< of the lists made for them
};

}  // namespace eyepoint::tools
