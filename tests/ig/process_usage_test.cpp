#include "ig/process_usage.hpp"

#include <chrono>
#include <vector>

#include <gtest/gtest.h>

#include "tools/process/child_process.hpp"

namespace eyepoint::ig {
namespace {

constexpr std::uint64_t kMib = 1ULL << 20;

// Stands first, for it is of a process that has done nothing yet.
TEST(ProcessUsage, AProgramThatDoesNothingHasASmallPeak) {
    EXPECT_GT(peak_resident_bytes(), kMib);
    EXPECT_LT(peak_resident_bytes(), 150 * kMib);
}

TEST(ProcessUsage, APeakIsOfMemoryThatIsNoLongerThere) {
    const std::uint64_t before = peak_resident_bytes();
    { const std::vector<char> block(200 * kMib, 1); }
    EXPECT_GE(peak_resident_bytes(), before + 150 * kMib);
}

// getrusage() would say so: a process that calls exec() hands its peak on.
TEST(ProcessUsage, APeakIsNotThatOfTheProgramThatStartedThisOne) {
    const std::vector<char> block(300 * kMib, 1);
    auto small = tools::ChildProcess::start(
        {"/proc/self/exe", "--gtest_filter=ProcessUsage.AProgramThatDoesNothingHasASmallPeak"});
    ASSERT_TRUE(small) << small.error();
    const tools::Ending ending = small->wait(std::chrono::seconds(60));
    EXPECT_EQ(ending.exit_code, 0) << ending.standard_output;
    EXPECT_EQ(block.back(), 1);
}

}  // namespace
}  // namespace eyepoint::ig
