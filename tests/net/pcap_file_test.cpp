#include "net/pcap_file.hpp"

#include <array>
#include <cstdio>
#include <fstream>

#include <gtest/gtest.h>

#include "tests/net/command_output.hpp"
#include "tests/net/flights.hpp"
#include "tests/net/scratch.hpp"
#include "tests/net/wire_bytes.hpp"

namespace eyepoint::net {
namespace {

using testing::Bytes;
using testing::operator+;
using testing::Scratch;

CapturedDatagram datagram(std::int64_t time_ns, Bytes payload) {
    return {time_ns, {192, 0, 2, 7}, {192, 0, 2, 9}, 40000, 5560, std::move(payload)};
}

// Writes the datagrams; throws where the writer refuses.
void write(const std::filesystem::path& file, const std::vector<CapturedDatagram>& datagrams) {
    auto writer = PcapWriter::create(file);
    if (!writer) throw std::runtime_error(writer.error());
    for (const auto& one : datagrams) {
        if (const auto written = writer->write(one); !written) throw std::runtime_error(written.error());
    }
    if (const auto finished = writer->finish(); !finished) throw std::runtime_error(finished.error());
}

TEST(PcapFile, WhatIsWrittenIsReadBack) {
    const Scratch scratch;
    const std::vector<CapturedDatagram> sent{datagram(1'700'000'000'123'456'000, Bytes(408, std::byte{0x5a})),
                                             datagram(1'700'000'000'140'000'000, Bytes()),
                                             datagram(1'700'000'001'000'000'000, Bytes(65507, std::byte{1}))};
    write(scratch / "flight.pcap", sent);
    const auto recording = read_pcap(scratch / "flight.pcap");
    ASSERT_TRUE(recording.has_value()) << recording.error();
    ASSERT_EQ(recording->datagrams.size(), sent.size());
    for (std::size_t i = 0; i < sent.size(); ++i) {
        const CapturedDatagram& got = recording->datagrams[i];
        EXPECT_EQ(got.time_ns, sent[i].time_ns);
        EXPECT_EQ(got.source_address, sent[i].source_address);
        EXPECT_EQ(got.destination_address, sent[i].destination_address);
        EXPECT_EQ(got.source_port, sent[i].source_port);
        EXPECT_EQ(got.destination_port, sent[i].destination_port);
        EXPECT_EQ(got.payload, sent[i].payload);
    }
    EXPECT_EQ(recording->other_packets + recording->fragments + recording->cut_packets, 0U);
    EXPECT_FALSE(recording->truncated);
}

TEST(PcapFile, AnUnfinishedFileLeavesNothing) {
    const Scratch scratch;
    {
        auto writer = PcapWriter::create(scratch / "flight.pcap");
        ASSERT_TRUE(writer.has_value());
        ASSERT_TRUE(writer->write(datagram(1, Bytes(10))).has_value());
        EXPECT_FALSE(std::filesystem::exists(scratch / "flight.pcap"));
    }
    EXPECT_TRUE(std::filesystem::is_empty(scratch.folder()));
}

TEST(PcapFile, AnOverlongPayloadIsRefused) {
    const Scratch scratch;
    auto writer = PcapWriter::create(scratch / "flight.pcap");
    ASSERT_TRUE(writer.has_value());
    EXPECT_FALSE(writer->write(datagram(1, Bytes(65508))).has_value());
}

TEST(PcapFile, ACaptureCutInTheMiddleGivesWhatCameBefore) {
    const Scratch scratch;
    write(scratch / "whole.pcap", {datagram(1, Bytes(100)), datagram(2, Bytes(100))});
    std::filesystem::copy_file(scratch / "whole.pcap", scratch / "cut.pcap");
    std::filesystem::resize_file(scratch / "cut.pcap",
                                 std::filesystem::file_size(scratch / "whole.pcap") - 50);
    const auto recording = read_pcap(scratch / "cut.pcap");
    ASSERT_TRUE(recording.has_value());
    EXPECT_EQ(recording->datagrams.size(), 1U);
    EXPECT_TRUE(recording->truncated);
}

TEST(PcapFile, WhatIsNoCaptureIsRefusedByName) {
    const Scratch scratch;
    std::ofstream(scratch / "text.pcap") << "this is no capture at all, only text";
    for (const char* name : {"text.pcap", "missing.pcap"}) {
        const auto recording = read_pcap(scratch / name);
        ASSERT_FALSE(recording.has_value());
        EXPECT_NE(recording.error().find(name), std::string::npos);
    }
    EXPECT_FALSE(PcapWriter::create(scratch / "no/such/folder/flight.pcap").has_value());
}

TEST(PcapFile, TheSampleFlightIsRead) {
    const auto recording = read_pcap(testing::sample_flight());
    ASSERT_TRUE(recording.has_value()) << recording.error();
    EXPECT_EQ(recording->datagrams.size(), 1800U);
    // Seconds and microseconds of the first record, read with Python's struct module.
    EXPECT_EQ(recording->datagrams.front().time_ns, 1795323143LL * 1'000'000'000 + 491390LL * 1000);
}

TEST(PcapFile, PcapngIsRead) {
    if (testing::output_of("command -v editcap").empty())
        GTEST_SKIP() << "editcap is not installed: no pcapng to make";
    const Scratch scratch;
    const std::string made = (scratch / "flight.pcapng").string();
    static_cast<void>(testing::output_of("editcap -F pcapng '" + testing::sample_flight().string() + "' '" +
                                         made + "' 2>&1"));
    const auto recording = read_pcap(made);
    ASSERT_TRUE(recording.has_value()) << recording.error();
    EXPECT_EQ(recording->datagrams.size(), 1800U);
}

TEST(PcapFile, TsharkFindsTheChecksumsRight) {
    if (testing::output_of("command -v tshark").empty())
        GTEST_SKIP() << "tshark is not installed: nobody to ask";
    const Scratch scratch;
    Bytes odd(409, std::byte{0xee});
    write(scratch / "flight.pcap",
          {datagram(1'700'000'000'000'000'000, Bytes(408, std::byte{7})),
           datagram(1'700'000'000'100'000'000, odd), datagram(1'700'000'000'200'000'000, {})});
    const std::string told =
        testing::output_of("tshark -r '" + (scratch / "flight.pcap").string() +
                           "' -o ip.check_checksum:TRUE -o udp.check_checksum:TRUE -T fields "
                           "-e ip.checksum.status -e udp.checksum.status -e udp.length 2>/dev/null");
    EXPECT_EQ(told, "1\t1\t416\n1\t1\t417\n1\t1\t8\n");  // 1: good
}

}  // namespace
}  // namespace eyepoint::net
