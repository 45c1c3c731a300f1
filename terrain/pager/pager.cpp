#include "terrain/pager/pager.hpp"

#include <algorithm>

#include "terrain/database/virtual_tile.hpp"

namespace eyepoint::terrain {

namespace {

bool has_loaded_child(const TileNode& node) {
    return node.children && std::any_of(node.children->begin(), node.children->end(),
                                        [](const TileNode& child) { return child.block != nullptr; });
}

/// Blocks that could go: loaded, not of the base, no loaded child that was made from it or stands below it.
void collect_unused(TileNode& node, std::uint32_t base_depth, std::uint64_t before_frame,
                    std::vector<TileNode*>& unused) {
    if (node.children) {
        for (TileNode& child : *node.children) collect_unused(child, base_depth, before_frame, unused);
    }
    if (node.block && node.tile.depth > base_depth && node.used_frame < before_frame &&
        !has_loaded_child(node)) {
        unused.push_back(&node);
    }
}

}  // namespace

tl::expected<std::unique_ptr<Pager>, std::string> Pager::create(std::shared_ptr<const Database> database,
                                                                const PagerOptions& options) {
    std::unique_ptr<Pager> pager{new Pager(std::move(database), options)};
    for (TileNode& root : pager->tree_.roots()) {
        pager->load_base(root);
        if (root.unreadable) return tl::unexpected(pager->faults_.front());
    }
    for (unsigned i = 0; i < std::max(options.threads, 1U); ++i) {
        pager->threads_.emplace_back(
            [raw = pager.get(), i](const std::stop_token& stop) { raw->run(stop, i); });
    }
    return pager;
}

Pager::Pager(std::shared_ptr<const Database> database, const PagerOptions& options)
    : database_(std::move(database)), options_(options), tree_(database_, options.mesh) {}

void Pager::load_base(TileNode& node) {
    const auto parent = node.parent != nullptr ? node.parent->block : nullptr;
    place(load({node.tile, node.stored, node.info, parent, 0.0}, 0), 0);
    if (!node.block || node.tile.depth >= options_.base_depth) return;
    for (TileNode& child : tree_.children(node)) load_base(child);
}

Pager::~Pager() {
    for (std::jthread& thread : threads_) thread.request_stop();
    work_.notify_all();
}

void Pager::request(std::span<const BlockRequest> wishes) {
    const std::scoped_lock lock(mutex_);
    queue_.clear();
    for (const BlockRequest& wish : wishes) {
        const TileNode& node = *wish.node;
        const bool known = node.unreadable || node.block || under_way_.contains(node.tile);
        if (known || node.parent == nullptr || !node.parent->block) continue;
        queue_.push_back({node.tile, node.stored, node.info, node.parent->block, wish.priority});
    }
    std::sort(queue_.begin(), queue_.end(),
              [](const Job& a, const Job& b) { return a.priority < b.priority; });
    if (!queue_.empty()) work_.notify_all();
}

void Pager::run(const std::stop_token& stop, unsigned thread) {
    while (true) {
        Job job;
        {
            std::unique_lock lock(mutex_);
            if (!work_.wait(lock, stop, [this] { return !queue_.empty(); })) return;
            job = std::move(queue_.back());
            queue_.pop_back();
            under_way_.insert(job.tile);
        }
        Finished finished = load(job, thread);
        {
            const std::scoped_lock lock(mutex_);
            finished_.push_back(std::move(finished));
        }
        done_.notify_all();
    }
}

Pager::Finished Pager::load(const Job& job, unsigned thread) const {
    using Clock = std::chrono::steady_clock;
    BlockLoad load{job.tile, job.stored, thread, Clock::now(), {}, {}};
    auto content = job.stored ? read(job) : interpolate(job);
    load.read = Clock::now();
    Finished finished{job.tile, job.stored, std::move(content).map([&](Content&& got) {
                          return unfold_content(job, std::move(got));
                      })};
    load.done = Clock::now();
    if (options_.on_load) options_.on_load(load);
    return finished;
}

tl::expected<Pager::Content, std::string> Pager::read(const Job& job) const {
    auto data = database_->read_block(job.tile);
    if (!data) return tl::unexpected(data.error());
    Content content{std::move(*data), std::nullopt, std::nullopt};
    if (job.info.has_image) {
        auto image = database_->read_image(job.tile);
        if (!image) return tl::unexpected(image.error());
        content.image = std::move(*image);
    }
    if (options_.mesh == MeshKind::Grid) return content;
    auto mesh = database_->read_mesh(job.tile);
    if (!mesh) return tl::unexpected(mesh.error());
    content.mesh = std::move(*mesh);
    return content;
}

tl::expected<Pager::Content, std::string> Pager::interpolate(const Job& job) const {
    Content content{subdivide(job.parent->data, quadrant(job.tile), database_->manifest().height_step_m),
                    std::nullopt, std::nullopt};
    if (options_.mesh == MeshKind::Nested) content.mesh = virtual_mesh(job.tile, job.info.last_level);
    return content;
}

std::shared_ptr<const Block> Pager::unfold_content(const Job& job, Content content) const {
    if (!content.mesh) return unfold(std::move(content.data), std::move(content.image));
    return unfold(std::move(content.data), job.info, *content.mesh, job.parent.get(),
                  std::move(content.image), options_.cell_bounds);
}

std::size_t Pager::publish(std::size_t most_blocks, std::uint64_t frame) {
    std::vector<Finished> ready;
    {
        const std::scoped_lock lock(mutex_);
        const auto count = static_cast<std::ptrdiff_t>(std::min(most_blocks, finished_.size()));
        std::move(finished_.begin(), finished_.begin() + count, std::back_inserter(ready));
        finished_.erase(finished_.begin(), finished_.begin() + count);
        for (const Finished& finished : ready) under_way_.erase(finished.tile);
    }
    const std::size_t published = ready.size();
    for (Finished& finished : ready) place(std::move(finished), frame);
    if (counters_.bytes > options_.cache_bytes) evict(frame);
    return published;
}

void Pager::place(Finished finished, std::uint64_t frame) {
    TileNode* node = tree_.find(finished.tile);
    if (node == nullptr) return;
    tree_.note_change();
    if (!finished.block) {
        node->unreadable = true;
        ++counters_.unreadable;
        faults_.push_back(std::move(finished.block.error()));
        return;
    }
    node->block = std::move(*finished.block);
    node->used_frame = frame;
    ++counters_.loaded;
    ++counters_.blocks;
    counters_.interpolated += finished.stored ? 0 : 1;
    counters_.bytes += node->block->bytes();
}

void Pager::evict(std::uint64_t frame) {
    std::vector<TileNode*> unused;
    if (frame < kKeepFrames) return;
    for (TileNode& root : tree_.roots())
        collect_unused(root, options_.base_depth, frame - kKeepFrames, unused);
    std::sort(unused.begin(), unused.end(),
              [](const TileNode* a, const TileNode* b) { return a->used_frame < b->used_frame; });
    for (TileNode* node : unused) {
        if (counters_.bytes <= options_.cache_bytes) return;
        counters_.bytes -= node->block->bytes();
        --counters_.blocks;
        ++counters_.evicted;
        node->block.reset();
        tree_.note_change();
    }
}

bool Pager::wait_for_loads() {
    std::unique_lock lock(mutex_);
    done_.wait(lock, [this] { return queue_.empty() && under_way_.size() == finished_.size(); });
    return !finished_.empty();
}

std::size_t Pager::pending() const {
    const std::scoped_lock lock(mutex_);
    return queue_.size() + under_way_.size();
}

std::vector<std::string> Pager::take_faults() { return std::exchange(faults_, {}); }

}  // namespace eyepoint::terrain
