#include "ig/signals.hpp"

#include <cerrno>
#include <csignal>
#include <cstdlib>

#include <gtest/gtest.h>
#include <unistd.h>

namespace eyepoint::ig {
namespace {

TEST(StopSignals, NothingIsRequestedAtFirst) {
    const StopSignals signals;
    EXPECT_FALSE(StopSignals::requested());
}

class StopSignalsOf : public ::testing::TestWithParam<int> {};

TEST_P(StopSignalsOf, OneSignalAsksForTheEnd) {
    const StopSignals signals;
    std::raise(GetParam());
    EXPECT_TRUE(StopSignals::requested());
}

TEST_P(StopSignalsOf, ASecondSignalEndsTheProcessAtOnce) {
    GTEST_FLAG_SET(death_test_style, "threadsafe");  // libraries that are linked start threads
    EXPECT_EXIT(
        {
            const StopSignals signals;
            std::raise(SIGINT);
            std::raise(GetParam());
            std::exit(EXIT_SUCCESS);
        },
        ::testing::ExitedWithCode(128 + GetParam()), "");
}

INSTANTIATE_TEST_SUITE_P(Signals, StopSignalsOf, ::testing::Values(SIGINT, SIGTERM));

TEST(StopSignals, AWriteToAClosedPipeFailsInsteadOfKilling) {
    const StopSignals signals;
    int ends[2];
    ASSERT_EQ(pipe(ends), 0);
    close(ends[0]);
    EXPECT_EQ(write(ends[1], "x", 1), -1);
    EXPECT_EQ(errno, EPIPE);
    close(ends[1]);
}

TEST(StopSignals, TheHandlersBeforeComeBack) {
    struct sigaction before {};
    sigaction(SIGTERM, nullptr, &before);
    { const StopSignals signals; }
    struct sigaction after {};
    sigaction(SIGTERM, nullptr, &after);
    EXPECT_EQ(before.sa_handler, after.sa_handler);
}

}  // namespace
}  // namespace eyepoint::ig
