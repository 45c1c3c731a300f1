#include <cmath>

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "net/host_session.hpp"
#include "net/wire/fgnetfdm.hpp"
#include "tests/net/wire_bytes.hpp"

namespace eyepoint::net {
namespace {

using testing::Bytes;
using testing::operator+;
using wire::ByteOrder;

void check_angles(const AttitudeDeg& attitude) {
    RC_ASSERT(attitude.yaw_deg >= 0.0 && attitude.yaw_deg < 360.0);
    RC_ASSERT(std::abs(attitude.pitch_deg) <= 90.0);
    RC_ASSERT(std::abs(attitude.roll_deg) <= 180.0);
}

void check_state(const HostState* state) {
    if (state == nullptr) return;
    for (const auto& [id, entity] : state->entities) {
        RC_ASSERT(std::abs(entity.latitude_deg) <= 90.0);
        RC_ASSERT(std::abs(entity.longitude_deg) <= 180.0);
        RC_ASSERT(entity.altitude_m >= wire::kLowestAltitudeM &&
                  entity.altitude_m <= wire::kHighestAltitudeM);
        check_angles(entity.attitude);
    }
    for (const auto& [id, view] : state->views) {
        check_angles(view.attitude);
        for (const double offset : view.offset_m) RC_ASSERT(std::isfinite(offset));
        for (const auto& angle : {view.left_deg, view.right_deg, view.bottom_deg, view.top_deg}) {
            // In parentheses of its own: RapidCheck would evaluate both sides of the ||.
            RC_ASSERT((!angle || std::abs(*angle) < 90.0));
        }
        RC_ASSERT((!view.left_deg || !view.right_deg || *view.left_deg < *view.right_deg));
        RC_ASSERT((!view.bottom_deg || !view.top_deg || *view.bottom_deg < *view.top_deg));
        RC_ASSERT((!view.near_m || (std::isfinite(*view.near_m) && *view.near_m > 0.0)));
    }
    RC_ASSERT((!state->host_time_s || std::isfinite(*state->host_time_s)));
}

Bytes as_bytes(const std::vector<std::uint8_t>& numbers) {
    Bytes bytes;
    for (const std::uint8_t number : numbers) bytes.push_back(std::byte{number});
    return bytes;
}

Bytes valid_cigi(ByteOrder order, std::uint32_t frame) {
    return testing::ig_control({.host_frame = frame}, order) + testing::entity_control({}, order) +
           testing::view_definition({2, 0, 0x3f, 0, {1, 1000, -30, 30, 20, -20}}, order) +
           testing::view_control({2, 0, 0x3f, 0, {1, 2, 3, 4, 5, 6}}, order) +
           testing::entity_control({.id = 5, .pitch = -10, .yaw = 300}, order);
}

Bytes valid_fdm() {
    wire::FgNetFdm fdm;
    fdm.latitude_deg = 46.4;
    fdm.longitude_deg = 8.1;
    fdm.altitude_m = 3050.0;
    const auto bytes = wire::encode_fgnetfdm24(fdm);
    return {bytes.begin(), bytes.end()};
}

// Overwrites a few bytes; most fall where numbers lie, where 0x7f, 0x80 and 0xff make infinities and NaN.
Bytes mutated(Bytes bytes) {
    const auto faults = *rc::gen::inRange(1, 9);
    for (int i = 0; i < faults; ++i) {
        const auto at = *rc::gen::inRange<std::size_t>(0, bytes.size());
        bytes[at] = std::byte{*rc::gen::oneOf(rc::gen::arbitrary<std::uint8_t>(),
                                              rc::gen::element<std::uint8_t>(0x00, 0x7f, 0x80, 0xf0, 0xff))};
    }
    if (*rc::gen::inRange(0, 4) == 0) bytes.resize(*rc::gen::inRange<std::size_t>(0, bytes.size() + 16));
    return bytes;
}

RC_GTEST_PROP(HostSessionProperty, RandomBytesNeverMakeAnImpossibleState,
              (std::vector<std::uint8_t> numbers)) {
    HostSession session;
    const testing::ExactCopy bytes(as_bytes(numbers));
    const auto reception = session.receive(bytes.span(), {});
    RC_ASSERT(reception.applied || reception.dropped);
    check_state(session.state());
}

RC_GTEST_PROP(HostSessionProperty, RandomPacketsAfterIgControlNeverMakeAnImpossibleState,
              (std::vector<std::uint8_t> numbers)) {
    HostSession session;
    session.receive(testing::ExactCopy(testing::ig_control({}) + as_bytes(numbers)).span(), {});
    check_state(session.state());
}

RC_GTEST_PROP(HostSessionProperty, MutatedMessagesNeverMakeAnImpossibleState, ()) {
    HostSession session;
    const ByteOrder order = *rc::gen::element(ByteOrder::Big, ByteOrder::Little);
    for (std::uint32_t frame = 1; frame <= 20; ++frame) {
        session.receive(testing::ExactCopy(mutated(valid_cigi(order, frame))).span(), {});
        check_state(session.state());
        session.receive(testing::ExactCopy(mutated(valid_fdm())).span(), {});
        check_state(session.state());
    }
}

RC_GTEST_PROP(HostSessionProperty, BothByteOrdersGiveTheSameState, (float yaw, float roll)) {
    RC_PRE(std::isfinite(yaw) && std::isfinite(roll));
    const auto state_of = [&](ByteOrder order) {
        HostSession session;
        session.receive(testing::ig_control({}, order) +
                            testing::entity_control({.roll = roll, .yaw = yaw, .latitude = -33.25}, order),
                        {});
        return *session.state()->ownship();
    };
    const EntityState big = state_of(ByteOrder::Big), little = state_of(ByteOrder::Little);
    RC_ASSERT(big.latitude_deg == little.latitude_deg);
    RC_ASSERT(big.attitude.yaw_deg == little.attitude.yaw_deg);
    RC_ASSERT(big.attitude.roll_deg == little.attitude.roll_deg);
}

}  // namespace
}  // namespace eyepoint::net
