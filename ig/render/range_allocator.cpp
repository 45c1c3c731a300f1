#include "ig/render/range_allocator.hpp"

#include <algorithm>
#include <iterator>

namespace eyepoint::ig {

std::optional<std::uint32_t> RangeAllocator::take(std::uint32_t count) {
    if (count == 0) return 0;
    const auto found = std::find_if(free_.begin(), free_.end(),
                                    [count](const auto& range) { return range.second >= count; });
    if (found == free_.end()) return std::nullopt;
    const auto [first, length] = *found;
    free_.erase(found);
    if (length > count) free_.emplace(first + count, length - count);
    return first;
}

void RangeAllocator::give_back(std::uint32_t first, std::uint32_t count) {
    if (count == 0) return;
    const auto next = free_.lower_bound(first);
    if (next != free_.end() && next->first == first + count) {
        count += next->second;
        free_.erase(next);
    }
    const auto after = free_.lower_bound(first);
    if (after != free_.begin()) {
        const auto before = std::prev(after);
        if (before->first + before->second == first) {
            before->second += count;
            return;
        }
    }
    free_.emplace(first, count);
}

void RangeAllocator::grow_to(std::uint32_t size) {
    const std::uint32_t added_from = size_;
    size_ = size;
    give_back(added_from, size - added_from);
}

std::uint32_t RangeAllocator::largest_free() const {
    std::uint32_t largest = 0;
    for (const auto& [first, length] : free_) largest = std::max(largest, length);
    return largest;
}

}  // namespace eyepoint::ig
