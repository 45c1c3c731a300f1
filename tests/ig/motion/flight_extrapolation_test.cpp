/// Extrapolation judged by recorded flights: the packets of one third are given, the ones between foretold.
#include <cmath>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <gtest/gtest.h>

#include "ig/motion/host_motion.hpp"
#include "net/host_session.hpp"
#include "tests/net/flights.hpp"

namespace eyepoint::ig {
namespace {

struct Flown {
    std::int64_t time_ns = 0;
    net::EntityState entity;
};

std::vector<Flown> read_flight(const std::filesystem::path& file, double from_s) {
    std::vector<Flown> flight;
    net::HostSession session;
    const auto datagrams = net::testing::datagrams_to(file, 5560);
    for (const auto& datagram : datagrams) {
        session.receive(datagram.payload, {datagram.time_ns});
        const auto since_ns = static_cast<double>(datagram.time_ns - datagrams.front().time_ns);
        if (since_ns * 1e-9 >= from_s) flight.push_back({datagram.time_ns, *session.state()->ownship()});
    }
    return flight;
}

/// Root mean square and largest.
struct Error {
    double rms = 0.0, most = 0.0;
    void add(double value) {
        sum_ += value * value;
        ++count_;
        rms = std::sqrt(sum_ / count_);
        most = std::max(most, value);
    }

  private:
    double sum_ = 0.0;
    int count_ = 0;
};

struct Errors {
    Error place_m, attitude_deg;
    void add(const net::EntityState& drawn, const net::EntityState& real) {
        place_m.add(glm::length(way_between(drawn, real)));
        attitude_deg.add(glm::degrees(glm::length(turn_between(drawn, real))));
    }
};

/// One packet in `every` is given; each of the others is foretold from what was given before it.
struct Judged {
    Errors with, without;
    int jumps = 0;
};

Judged judge(const std::vector<Flown>& flight, std::size_t every, bool stated) {
    Judged judged;
    HostMotion motion;
    net::EntityState newest;
    for (std::size_t i = 0; i < flight.size(); ++i) {
        if (i % every == 0) {
            newest = flight[i].entity;
            if (!stated) newest.rates.reset();
            judged.jumps += motion.observe(newest, {flight[i].time_ns, {}}) ? 1 : 0;
        } else if (i >= 2 * every) {  // one packet alone moves nothing
            judged.with.add(motion.at(flight[i].time_ns)->entity, flight[i].entity);
            judged.without.add(newest, flight[i].entity);
        }
    }
    return judged;
}

void tell(const std::string& name, const Judged& judged) {
    const auto line = [](const Errors& errors) {
        return fmt::format("place rms {:.3f} m max {:.3f} m, attitude rms {:.3f} deg max {:.3f} deg",
                           errors.place_m.rms, errors.place_m.most, errors.attitude_deg.rms,
                           errors.attitude_deg.most);
    };
    fmt::print("{}\n  not extrapolated: {}\n  extrapolated:     {}\n", name, line(judged.without),
               line(judged.with));
}

void expect_better(const Judged& judged, double place_share, double attitude_share) {
    EXPECT_LT(judged.with.place_m.rms, place_share * judged.without.place_m.rms);
    // The worst is a packet that was caught some 25 ms late: of the yardstick, not of the extrapolation.
    EXPECT_LT(judged.with.place_m.most, judged.without.place_m.most);
    EXPECT_LT(judged.with.attitude_deg.most, judged.without.attitude_deg.most);
    EXPECT_LT(judged.with.attitude_deg.rms, attitude_share * judged.without.attitude_deg.rms);
    EXPECT_EQ(judged.jumps, 0);
}

TEST(FlightExtrapolation, SampleFlightAtTenHertzByStatedVelocities) {
    const Judged judged = judge(read_flight(net::testing::sample_flight(), 0.0), 3, true);
    tell("sample flight, 10 of 30 Hz, stated velocities", judged);
    expect_better(judged, 0.1, 0.5);
}

/// Packets timed as they were sent, every 1/30 s: what is left is the extrapolation's own error.
TEST(FlightExtrapolation, SampleFlightAtTenHertzWithoutJitter) {
    auto flight = read_flight(net::testing::sample_flight(), 0.0);
    for (std::size_t i = 0; i < flight.size(); ++i)
        flight[i].time_ns = static_cast<std::int64_t>(static_cast<double>(i) * 1e9 / 30.0);
    const Judged judged = judge(flight, 3, true);
    tell("sample flight, 10 of 30 Hz, stated velocities, no jitter", judged);
    expect_better(judged, 0.01, 0.1);
    EXPECT_LT(judged.with.place_m.most, 0.02 * judged.without.place_m.most);
}

TEST(FlightExtrapolation, SampleFlightAtTenHertzByDifferences) {
    const Judged judged = judge(read_flight(net::testing::sample_flight(), 0.0), 3, false);
    tell("sample flight, 10 of 30 Hz, differences", judged);
    expect_better(judged, 0.15, 0.6);
}

TEST(FlightExtrapolation, SampleFlightAtFiveHertz) {
    const Judged judged = judge(read_flight(net::testing::sample_flight(), 0.0), 6, true);
    tell("sample flight, 5 of 30 Hz, stated velocities", judged);
    expect_better(judged, 0.1, 0.6);
}

TEST(FlightExtrapolation, AJetAtTenHertz) {
    const auto folder = net::testing::captures_folder();
    if (!folder) GTEST_SKIP() << "EYEPOINT_REAL_DATA is not set";
    constexpr double kAfterItsTrimS = 3.0;  // the README: the first second jumps
    const auto flight = read_flight(*folder / "alps-737.pcap", kAfterItsTrimS);
    for (const bool stated : {true, false}) {
        const Judged judged = judge(flight, 6, stated);
        tell(stated ? "737, 10 of 60 Hz, stated velocities" : "737, 10 of 60 Hz, differences", judged);
        expect_better(judged, 0.1, 0.8);
    }
}

}  // namespace
}  // namespace eyepoint::ig
