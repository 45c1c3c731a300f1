#include "net/frame_order.hpp"

namespace eyepoint::net {

bool FrameOrder::accept(std::uint32_t frame) {
    constexpr std::uint32_t kHalfRange = 0x80000000U;
    if (!newest_ || frame - *newest_ < kHalfRange) {
        newest_ = frame;
        stale_in_a_row_ = 0;
        return true;
    }
    stale_in_a_row_ = stale_in_a_row_ > 0 && frame - last_stale_ == 1 ? stale_in_a_row_ + 1 : 1;
    last_stale_ = frame;
    if (stale_in_a_row_ < kRestartMessages) return false;
    newest_ = frame;
    stale_in_a_row_ = 0;
    return true;
}

}  // namespace eyepoint::net
