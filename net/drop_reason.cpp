#include "net/drop_reason.hpp"

namespace eyepoint::net {

std::string_view name(DropReason reason) {
    switch (reason) {
        case DropReason::UnknownProtocol:
            return "unknown protocol";
        case DropReason::Short:
            return "short";
        case DropReason::Long:
            return "long";
        case DropReason::WrongVersion:
            return "wrong version";
        case DropReason::WrongByteOrder:
            return "wrong byte order";
        case DropReason::NotFinite:
            return "not finite";
        case DropReason::OutOfRange:
            return "out of range";
        case DropReason::BadPacketSize:
            return "bad packet size";
        case DropReason::MisplacedIgControl:
            return "misplaced IG Control";
        case DropReason::StaleFrame:
            return "stale frame";
        case DropReason::Count:
            break;
    }
    return "unknown reason";
}

}  // namespace eyepoint::net
