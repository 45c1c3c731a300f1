#include "tools/bench/measure/flight.hpp"

#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "ig/process_usage.hpp"
#include "terrain/lod/lod_method.hpp"

namespace eyepoint::tools {

tl::expected<std::unique_ptr<LodFlight>, std::string> LodFlight::create(
    std::shared_ptr<const terrain::Database> database, const FlightOptions& options) {
    auto method = terrain::make_lod_method(options.lod_method, {.cull = options.cull,
                                                                .triangle_budget = options.triangle_budget,
                                                                .selective = options.selective,
                                                                .tile = options.tile,
                                                                .hyperblock = options.hyperblock});
    if (!method) {
        return tl::unexpected(fmt::format("no LOD method is called '{}'; there is {}", options.lod_method,
                                          fmt::join(terrain::lod_method_names(), ", ")));
    }
    auto pager = terrain::Pager::create(std::move(database), {.threads = options.loader_threads,
                                                              .mesh = method->mesh_kind(),
                                                              .cell_bounds = options.cull,
                                                              .cache_bytes = options.block_cache_bytes});
    if (!pager) return tl::unexpected(pager.error());
    return std::unique_ptr<LodFlight>(
        new LodFlight(std::move(*pager), std::move(method), options.allocations));
}

LodFlight::LodFlight(std::unique_ptr<terrain::Pager> pager, std::unique_ptr<terrain::LodMethod> method,
                     std::uint64_t (*allocations)())
    : pager_(std::move(pager)), method_(std::move(method)), allocations_(allocations) {}

const terrain::Selection& LodFlight::select(const terrain::LodView& view) {
    const std::uint64_t allocated = allocations_ != nullptr ? allocations_() : 0;
    constexpr double kNsPerMs = 1e6;
    const double start_ms = ig::thread_cpu_ms();
    const terrain::Selection& selection = choose(view);
    work_.cpu_ns = (ig::thread_cpu_ms() - start_ms) * kNsPerMs;
    work_.allocations = allocations_ != nullptr ? allocations_() - allocated : 0;
    work_.blocks_wished = selection.wishes.size();
    work_.uploaded_bytes = count_uploads(selection);
    pager_->request(selection.wishes);
    return selection;
}

[[gnu::noinline]] const terrain::Selection& LodFlight::choose(const terrain::LodView& view) {
    return method_->select(view, pager_->tree(), ++frame_);
}

std::uint64_t LodFlight::count_uploads(const terrain::Selection& selection) {
    std::uint64_t bytes = 0;
    for (const terrain::BlockDraw& draw : selection.draws) {
        const terrain::Block& block = *draw.node->block;
        if (uploaded_.insert(&block).second)
            bytes += block.vertices.size() * sizeof(terrain::BlockVertex) + block.indices.size() * 2;
        if (draw.mesh == nullptr) continue;
        std::uint64_t& version = mesh_versions_[&block];
        if (std::exchange(version, draw.mesh->version) != draw.mesh->version)
            bytes += draw.mesh->indices.size() * sizeof(std::uint16_t);
    }
    return bytes;
}

const terrain::Selection& LodFlight::settle(const terrain::LodView& view) {
    constexpr std::size_t kAll = static_cast<std::size_t>(-1);
    while (true) {
        (void)pager_->publish(kAll, frame_);
        const terrain::Selection& selection = method_->select(view, pager_->tree(), ++frame_);
        pager_->request(selection.wishes);
        if (!pager_->wait_for_loads()) return selection;
    }
}

}  // namespace eyepoint::tools
