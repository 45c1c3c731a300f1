/// Why a datagram, or a packet in one, was not used.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace eyepoint::net {

enum class DropReason : std::uint8_t {
    UnknownProtocol,     ///< neither FGNetFDM nor CIGI by its first bytes
    Short,               ///< ends before its content does
    Long,                ///< longer than its format allows
    WrongVersion,        ///< a version that is not supported
    WrongByteOrder,      ///< a sender that forgot network byte order, or a wrong byte-swap magic
    NotFinite,           ///< NaN or infinity
    OutOfRange,          ///< latitude, longitude, altitude or an angle outside its range
    BadPacketSize,       ///< a CIGI packet size of zero, too small, or past the datagram's end
    MisplacedIgControl,  ///< a CIGI message that does not begin with IG Control, or holds a second one
    StaleFrame,          ///< a host frame number older than one already applied
    Count
};

/// As in logs and reports: "not finite", "stale frame", ...
[[nodiscard]] std::string_view name(DropReason reason);

/// What a codec answers in place of a value.
struct WireError {
    DropReason reason = DropReason::UnknownProtocol;
    std::string detail;  ///< one clause for the log: what came and what was expected
};

}  // namespace eyepoint::net
