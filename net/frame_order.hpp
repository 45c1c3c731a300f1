/// Whether a host frame number continues the host's count, on a wire that loses, repeats and reorders.
#pragma once

#include <cstdint>
#include <optional>

namespace eyepoint::net {

/// A number behind the newest by less than half the 32-bit range is old. A host that restarts counts from the
/// start again: kRestartMessages old numbers in a row, each one more than the one before, are taken for that,
/// so a single stray datagram never winds the count back.
class FrameOrder {
  public:
    /// True: apply the message of this number (it is new, or repeats the newest). False: it is stale.
    [[nodiscard]] bool accept(std::uint32_t frame);
    void reset() { *this = FrameOrder{}; }

    static constexpr int kRestartMessages = 3;

  private:
    std::optional<std::uint32_t> newest_;
    std::uint32_t last_stale_ = 0;
    int stale_in_a_row_ = 0;
};

}  // namespace eyepoint::net
