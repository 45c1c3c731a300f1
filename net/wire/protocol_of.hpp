/// Which protocol a datagram is, by its first bytes.
#pragma once

#include <cstddef>
#include <span>

#include <tl/expected.hpp>

#include "net/drop_reason.hpp"
#include "net/host_state.hpp"

namespace eyepoint::net::wire {

/// The protocol whose decoder is to judge the datagram further. Refused here, with words on what it is: CIGI
/// 1, 2 and 4, CIGI from an image generator, a CIGI message that does not begin with IG Control, and what
/// nothing is known of.
[[nodiscard]] tl::expected<Protocol, WireError> protocol_of(std::span<const std::byte> datagram);

}  // namespace eyepoint::net::wire
