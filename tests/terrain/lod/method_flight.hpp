/// A LOD method over a database, without a renderer.
#pragma once

#include <cstdint>
#include <memory>
#include <utility>

#include "terrain/lod/lod_method.hpp"
#include "terrain/pager/pager.hpp"

namespace eyepoint::testing {

/// With room for all blocks. Throws tl::bad_expected_access with the sentence.
inline std::unique_ptr<terrain::Pager> open_pager(std::shared_ptr<const terrain::Database> database) {
    return std::move(
        terrain::Pager::create(std::move(database), {.threads = 1, .cache_bytes = 1ULL << 30}).value());
}

/// A pager and a method that go from view to view.
template <class Method>
class MethodFlight {
  public:
    template <class... Options>
    explicit MethodFlight(std::unique_ptr<terrain::Pager> pager, const Options&... options)
        : pager_(std::move(pager)), method_(options...) {}
    template <class... Options>
    explicit MethodFlight(std::shared_ptr<const terrain::Database> database, const Options&... options)
        : MethodFlight(open_pager(std::move(database)), options...) {}

    /// A frame; nothing is loaded for it.
    const terrain::Selection& select(const terrain::LodView& view) {
        return method_.select(view, pager_->tree(), ++frame_);
    }
    /// A frame; what it wishes for is begun to load.
    const terrain::Selection& step(const terrain::LodView& view) {
        const terrain::Selection& selection = select(view);
        pager_->request(selection.wishes);
        return selection;
    }
    /// Frames until everything the view asks for is there; the last selection.
    const terrain::Selection& settle(const terrain::LodView& view) {
        while (true) {
            pager_->publish(100000, frame_);
            const terrain::Selection& selection = step(view);
            if (!pager_->wait_for_loads()) return selection;
        }
    }
    /// So many of the blocks that were asked for arrive.
    void receive(std::size_t most) {
        (void)pager_->wait_for_loads();
        pager_->publish(most, frame_);
    }
    /// Frames in which nothing is drawn.
    void skip(std::uint64_t frames) { frame_ += frames; }

    [[nodiscard]] const Method& method() const { return method_; }
    [[nodiscard]] terrain::Pager& pager() { return *pager_; }
    [[nodiscard]] std::uint64_t frame() const { return frame_; }

  private:
    std::unique_ptr<terrain::Pager> pager_;
    Method method_;
    std::uint64_t frame_ = 0;
};

}  // namespace eyepoint::testing
