/// Which parts of a row of equal elements are taken: ranges of any length, given out and given back.
#pragma once

#include <cstdint>
#include <map>
#include <optional>

namespace eyepoint::ig {

/// First fit; what is given back joins its free neighbours, so giving back everything leaves one free range.
class RangeAllocator {
  public:
    explicit RangeAllocator(std::uint32_t size) : size_(size) { give_back(0, size); }

    /// First element of a free range of so many, now taken; none when there is no such range. Of none: 0.
    [[nodiscard]] std::optional<std::uint32_t> take(std::uint32_t count);
    /// A range that was taken, whole.
    void give_back(std::uint32_t first, std::uint32_t count);
    /// Adds free elements behind the present ones.
    void grow_to(std::uint32_t size);

    [[nodiscard]] std::uint32_t size() const { return size_; }
    [[nodiscard]] std::uint32_t largest_free() const;

  private:
    std::uint32_t size_ = 0;
    std::map<std::uint32_t, std::uint32_t> free_;  ///< length by first element; no two touch
};

}  // namespace eyepoint::ig
