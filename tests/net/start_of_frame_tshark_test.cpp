// Wireshark's dissector as an independent reader of what we answer.
#include <array>
#include <cstdio>

#include <gtest/gtest.h>

#include "net/host_session.hpp"
#include "net/pcap_file.hpp"
#include "tests/net/command_output.hpp"
#include "tests/net/scratch.hpp"
#include "tests/net/wire_bytes.hpp"

namespace eyepoint::net {
namespace {

TEST(StartOfFrame, TsharkReadsWhatWasMeant) {
    if (testing::output_of("command -v tshark").empty())
        GTEST_SKIP() << "tshark is not installed: nobody to ask";
    const testing::Scratch scratch;
    auto writer = PcapWriter::create(scratch / "answer.pcap");
    ASSERT_TRUE(writer.has_value());
    for (const auto order : {wire::ByteOrder::Little, wire::ByteOrder::Big}) {
        HostSession session;
        session.receive(testing::ig_control({.host_frame = 4711}, order), {});
        CapturedDatagram answer;
        answer.destination_port = 8005;
        answer.payload = session.start_of_frame({815, IgMode::Operate, 3, 7, 123456});
        ASSERT_TRUE(writer->write(answer).has_value());
    }
    ASSERT_TRUE(writer->finish().has_value());
    const std::string told = testing::output_of(
        "tshark -r '" + (scratch / "answer.pcap").string() +
        "' -d udp.port==8005,cigi -T fields -e cigi.sof.ig_frame_number -e cigi.sof.last_host_frame_number "
        "-e cigi.sof.ig_mode -e cigi.sof.db_number -e cigi.sof.ig_status -e cigi.sof.timestamp "
        "2>/dev/null");
    const std::string line = "815\t4711\t1\t3\t7\t123456\n";
    EXPECT_EQ(told, line + line);
}

}  // namespace
}  // namespace eyepoint::net
