#include "net/frame_order.hpp"

#include <gtest/gtest.h>

namespace eyepoint::net {
namespace {

TEST(FrameOrder, AcceptsWhatFollowsAndRepeats) {
    FrameOrder order;
    for (const std::uint32_t frame : {100U, 101U, 101U, 105U, 5000U})
        EXPECT_TRUE(order.accept(frame)) << frame;
}

TEST(FrameOrder, RefusesOneThatCameLate) {
    FrameOrder order;
    EXPECT_TRUE(order.accept(100));
    EXPECT_TRUE(order.accept(102));
    EXPECT_FALSE(order.accept(101));
    EXPECT_TRUE(order.accept(103));
}

TEST(FrameOrder, GoesOnThroughTheWrap) {
    FrameOrder order;
    EXPECT_TRUE(order.accept(0xffffffffU));
    EXPECT_TRUE(order.accept(0));
    EXPECT_FALSE(order.accept(0xfffffffeU));
    EXPECT_TRUE(order.accept(1));
}

TEST(FrameOrder, FollowsAHostThatRestarted) {
    FrameOrder order;
    EXPECT_TRUE(order.accept(90000));
    EXPECT_FALSE(order.accept(0));
    EXPECT_FALSE(order.accept(1));
    EXPECT_TRUE(order.accept(2));
    EXPECT_TRUE(order.accept(3));
}

TEST(FrameOrder, StraysNeverWindTheCountBack) {
    FrameOrder order;
    EXPECT_TRUE(order.accept(1000));
    for (const std::uint32_t stray : {7U, 3U, 900U, 900U, 12U, 500U})
        EXPECT_FALSE(order.accept(stray)) << stray;
    EXPECT_TRUE(order.accept(1001));
    EXPECT_FALSE(order.accept(8));
    EXPECT_FALSE(order.accept(9));
    EXPECT_TRUE(order.accept(1002));  // breaks the row
    EXPECT_FALSE(order.accept(10));
}

}  // namespace
}  // namespace eyepoint::net
