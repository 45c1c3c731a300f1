#include "ig/hud/hud_lines.hpp"

#include <map>

#include <gtest/gtest.h>

namespace eyepoint::ig {
namespace {

HudReading flying() {
    HudReading reading;
    reading.entry.host_frame = 812;
    reading.entry.frame_ms = 11.25;
    reading.entry.new_packet = true;
    reading.entry.arrival_to_complete_ms = 15.24;
    reading.entry.extrapolated_ms = 8.0;
    reading.entry.control = "steady";
    reading.entry.missed_deadlines = 2;
    reading.entry.drawn.triangles = 1234567;
    reading.entry.drawn.blocks_drawn = 321;
    reading.entry.drawn.blocks_tested = 1000;
    reading.entry.drawn.blocks_reused = 985;
    reading.entry.drawn.loads_pending = 4;
    reading.entry.drawn.blocks_uploaded = 3;
    reading.entry.drawn.bytes_uploaded = 1536;
    reading.entry.drawn.tau_px = 2.5;
    reading.entry.eye = {-46.5, -8.25, terrain::EllipsoidalHeight{2512.34}};
    reading.resident_bytes = 300ULL << 20;
    return reading;
}

std::map<std::string_view, std::string> lines_of(const HudReading& reading, const HudHistory& history) {
    std::map<std::string_view, std::string> lines;
    for (const HudLine& line : hud_lines(reading, history)) lines[line.label] = line.text;
    return lines;
}

std::map<std::string_view, std::string> lines_of(const HudReading& reading) {
    HudHistory history;
    history.add(reading.entry);
    return lines_of(reading, history);
}

TEST(HudLines, EveryFigureHasItsUnit) {
    const auto lines = lines_of(flying());
    ASSERT_EQ(lines.size(), kHudLines);
    EXPECT_EQ(lines.at("control"), "steady");
    EXPECT_EQ(lines.at("pacing"), "fixed, 60 Hz, 2 missed");
    EXPECT_EQ(lines.at("triangles"), "1 234 567");
    EXPECT_EQ(lines.at("blocks"), "321 drawn, 4 to load");
    EXPECT_EQ(lines.at("reused"), "98.5% of 1 000 choices");
    EXPECT_EQ(lines.at("uploads"), "3 blocks, 1.5 KiB");
    EXPECT_EQ(lines.at("delay"), "15.2 ms, eye moved on 8.0 ms");
    EXPECT_EQ(lines.at("host"), "connected, frame 812");
    EXPECT_EQ(lines.at("memory"), "300 MiB");
    EXPECT_EQ(lines.at("position"), "46.50000° S 8.25000° W");
    EXPECT_EQ(lines.at("height"), "2512.3 m above the ellipsoid");
}

TEST(HudLines, ASilentHostAndAnUnreachableTargetAreSaid) {
    HudReading reading = flying();
    reading.host_silent_s = 7.4;
    reading.entry.control = "coarsest";
    reading.entry.unreachable_share = 0.2;
    reading.pacing = config::Pacing::Host;
    const auto lines = lines_of(reading);
    EXPECT_EQ(lines.at("host"), "silent for 7 s");
    EXPECT_EQ(lines.at("control"), "coarsest: 20% over target");
    EXPECT_EQ(lines.at("pacing"), "by the host, 60 Hz, 2 missed");
}

TEST(HudLines, BeforeTheFirstPacketNothingIsMadeUp) {
    const auto lines = lines_of({}, {});
    EXPECT_EQ(lines.at("delay"), "no packet yet");
    EXPECT_EQ(lines.at("reused"), "none tested");
}

TEST(HudHistory, KeepsTheLast240FramesOldestFirst) {
    HudHistory history;
    FrameEntry entry;
    for (int frame = 1; frame <= 300; ++frame) {
        entry.frame_ms = frame;
        entry.drawn.tau_px = 300.0 - frame;
        entry.missed_deadlines = 1;
        history.add(entry);
    }
    EXPECT_EQ(history.frame_ms()[history.oldest()], 61.0F);
    EXPECT_EQ(history.slowest_frame_ms(), 300.0);
    EXPECT_EQ(history.greatest_tau_px(), 239.0);
    EXPECT_EQ(history.missed_deadlines(), 240U);
}

TEST(HudHistory, TheDelayIsOfTheLastNewPacket) {
    HudHistory history;
    FrameEntry entry;
    EXPECT_FALSE(history.transport_delay_ms().has_value());
    entry.new_packet = true;
    entry.arrival_to_complete_ms = 12.0;
    history.add(entry);
    entry.new_packet = false;
    entry.arrival_to_complete_ms = 28.0;
    history.add(entry);
    EXPECT_EQ(history.transport_delay_ms(), 12.0);
}

}  // namespace
}  // namespace eyepoint::ig
