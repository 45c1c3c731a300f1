#include "ig/pacing/host_watch.hpp"

#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace eyepoint::ig {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

constexpr std::int64_t kMs = 1'000'000;

/// What is said while a host sends so many packets a second to a loop of 60 turns a second.
class Watched {
  public:
    std::vector<std::string> hear(double packets_hz, double seconds) {
        std::vector<std::string> said;
        for (int turn = 0; turn < static_cast<int>(seconds * 60.0); ++turn) {
            now_ns_ += 1'000 * kMs / 60;
            waiting_ += packets_hz / 60.0;
            const auto applied = static_cast<unsigned>(waiting_);
            waiting_ -= applied;
            if (const auto line = watch_.hear(applied, now_ns_)) said.push_back(*line);
        }
        return said;
    }

  private:
    HostWatch watch_{60.0};
    std::int64_t now_ns_ = 5'000 * kMs;
    double waiting_ = 0.0;
};

TEST(HostWatch, AnOrdinaryHostIsNotWorthAWord) {
    for (const double hz : {10.5, 30.0, 60.0, 200.0}) EXPECT_THAT(Watched().hear(hz, 60.0), IsEmpty()) << hz;
}

TEST(HostWatch, NothingIsMissedBeforeTheFirstPacket) { EXPECT_THAT(Watched().hear(0.0, 60.0), IsEmpty()); }

TEST(HostWatch, SilenceIsToldOnceAndItsEndOnce) {
    Watched watched;
    (void)watched.hear(60.0, 10.0);
    EXPECT_THAT(watched.hear(0.0, 6.0), ElementsAre(HasSubstr("no packet from the host for 2.0 s")));
    EXPECT_THAT(watched.hear(60.0, 10.0), ElementsAre(HasSubstr("speaks again after 6.0 s")));
}

TEST(HostWatch, AHostAtOneHertzIsCalledSlowOnceAndIsNotSilent) {
    EXPECT_THAT(Watched().hear(1.0, 60.0), ElementsAre(HasSubstr("sends 1.0 packets a second: too few")));
}

TEST(HostWatch, AHostAtAThousandHertzIsCalledFastOnce) {
    EXPECT_THAT(Watched().hear(1000.0, 60.0), ElementsAre(HasSubstr("for 60 frames: each draws the newest")));
}

TEST(HostWatch, TheReturnToAnOrdinaryRateIsTold) {
    Watched watched;
    (void)watched.hear(1000.0, 20.0);
    const auto said = watched.hear(60.0, 20.0);
    ASSERT_EQ(said.size(), 1U);
    EXPECT_THAT(said[0], HasSubstr("the host sends"));
}

}  // namespace
}  // namespace eyepoint::ig
