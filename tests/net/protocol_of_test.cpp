#include "net/wire/protocol_of.hpp"

#include <gtest/gtest.h>

#include "tests/net/wire_bytes.hpp"

namespace eyepoint::net::wire {
namespace {

using testing::Bytes;
using testing::operator+;
using testing::from_hex;

struct Refused {
    const char* what;
    Bytes bytes;
    DropReason reason;
    const char* named;  ///< found in the detail
};

TEST(ProtocolOf, RefusalsSayWhatCame) {
    const Refused cases[] = {
        {"nothing", {}, DropReason::Short, "0 bytes"},
        {"CIGI 4 host, little-endian", from_hex("180000000405000d0000000000000000"), DropReason::WrongVersion,
         "4.0"},
        {"CIGI 4 host, big-endian", from_hex("001800000405000d0000000000000000"), DropReason::WrongVersion,
         "4.0"},
        {"CIGI 4 IG, little-endian", from_hex("1800ffff04fb00050000000000000000"), DropReason::WrongVersion,
         "4.0"},
        {"CIGI 4 IG, big-endian", from_hex("0018ffff04fb00050000000000000000"), DropReason::WrongVersion,
         "4.0"},
        {"CIGI 2", from_hex("01100200000000000000000000000000"), DropReason::WrongVersion, "CIGI 2"},
        {"CIGI 1", from_hex("01100100000000000000000000000000"), DropReason::WrongVersion, "CIGI 1"},
        {"CIGI 3 IG", from_hex("651803fb07350080000000000d0c0b0a0000000000000000"),
         DropReason::MisplacedIgControl, "image generator"},
        {"entity first", testing::entity_control({}) + testing::ig_control({}),
         DropReason::MisplacedIgControl, "packet 2"},
        {"four bytes", from_hex("52504f53"), DropReason::Short, "bytes"},
        {"text", from_hex("48656c6c6f20776f726c6421"), DropReason::UnknownProtocol, "48 65 6c 6c"},
    };
    for (const Refused& refused : cases) {
        const auto protocol = protocol_of(refused.bytes);
        ASSERT_FALSE(protocol.has_value()) << refused.what;
        EXPECT_EQ(protocol.error().reason, refused.reason) << refused.what;
        EXPECT_NE(protocol.error().detail.find(refused.named), std::string::npos) << protocol.error().detail;
    }
}

TEST(ProtocolOf, TellsHostsApart) {
    EXPECT_EQ(protocol_of(testing::ig_control({})), Protocol::Cigi);
    EXPECT_EQ(protocol_of(testing::ig_control({.size = 16}, ByteOrder::Big)), Protocol::Cigi);
    Bytes fdm(408);
    fdm[3] = std::byte{24};
    EXPECT_EQ(protocol_of(fdm), Protocol::FgNetFdm);
    // Little-endian FGNetFDM goes to its decoder, which names the fault; its fifth byte is not CIGI 4's
    // version.
    fdm[3] = std::byte{0};
    fdm[0] = std::byte{24};
    EXPECT_EQ(protocol_of(fdm), Protocol::FgNetFdm);
}

}  // namespace
}  // namespace eyepoint::net::wire
