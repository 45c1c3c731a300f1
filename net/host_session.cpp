#include "net/host_session.hpp"

#include <algorithm>
#include <numeric>
#include <utility>

#include <fmt/format.h>

#include "net/wire/cigi_message.hpp"
#include "net/wire/fgnetfdm.hpp"
#include "net/wire/protocol_of.hpp"

namespace eyepoint::net {
namespace {

constexpr double kSecondsPerTick = 1.0e-5;

/// A sender that leaves all of them 0 either stands still or does not fill them in.
std::optional<EntityRates> rates_of(const wire::FgNetFdm& fdm) {
    const AttitudeDeg& turn = fdm.attitude_rate;
    const bool moves = std::ranges::any_of(fdm.velocity_ned_mps, [](double speed) { return speed != 0.0; });
    const bool turns = turn.yaw_deg != 0.0 || turn.pitch_deg != 0.0 || turn.roll_deg != 0.0;
    if (!moves && !turns) return std::nullopt;
    return EntityRates{EntityRates::Axes::NorthEastDown, fdm.velocity_ned_mps, EntityRates::Turn::EulerAngles,
                       turn};
}

std::optional<WireError> error_of(tl::expected<void, WireError> result) {
    if (result) return std::nullopt;
    return std::move(result.error());
}

}  // namespace

std::uint64_t SessionCounters::dropped_total() const {
    return std::accumulate(dropped.begin(), dropped.end(), std::uint64_t{0});
}

const HostState* HostSession::state() const { return spoken_ ? &state_ : nullptr; }

void HostSession::count(Reception& reception, WireError error) {
    ++counters_.dropped[static_cast<std::size_t>(error.reason)];
    if (reception.dropped) return;
    reception.dropped = error.reason;
    reception.detail = std::move(error.detail);
}

// A host of the other protocol begins with nothing of the one before it.
void HostSession::begin(Protocol protocol) {
    if (spoken_ && state_.protocol == protocol) return;
    state_ = HostState{};
    state_.protocol = protocol;
    if (protocol == Protocol::Cigi) state_.commanded_mode = IgMode::Standby;
    frame_order_.reset();
    last_timestamp_10us_.reset();
    host_clock_10us_ = 0;
    spoken_ = true;
}

Reception HostSession::receive(std::span<const std::byte> bytes, ArrivalTime arrival) {
    ++counters_.datagrams;
    const auto protocol = wire::protocol_of(bytes);
    Reception reception;
    if (!protocol) {
        count(reception, protocol.error());
    } else if (*protocol == Protocol::FgNetFdm) {
        reception = receive_fgnetfdm(bytes, arrival);
    } else {
        reception = receive_cigi(bytes, arrival);
    }
    if (reception.applied) ++counters_.applied;
    return reception;
}

Reception HostSession::receive_fgnetfdm(std::span<const std::byte> bytes, ArrivalTime arrival) {
    Reception reception;
    auto fdm = wire::decode_fgnetfdm(bytes);
    if (!fdm) {
        count(reception, std::move(fdm.error()));
        return reception;
    }
    begin(Protocol::FgNetFdm);
    EntityState& ownship = state_.entities[0];
    ownship = EntityState{fdm->latitude_deg, fdm->longitude_deg, fdm->altitude_m, fdm->attitude};
    ownship.rates = rates_of(*fdm);
    state_.host_time_s = fdm->utc_s();
    ++state_.host_frame;
    state_.arrival = arrival;
    reception.applied = true;
    return reception;
}

Reception HostSession::receive_cigi(std::span<const std::byte> bytes, ArrivalTime arrival) {
    Reception reception;
    wire::CigiPacketWalk walk(bytes);
    const auto first = walk.next();
    if (!first) {
        const DropReason reason =
            bytes.size() < wire::kIgControlBytes ? DropReason::Short : walk.error()->reason;
        count(reception, {reason, walk.error()->detail});
        return reception;
    }
    const auto control = wire::decode_ig_control(first->bytes);
    if (!control) {
        count(reception, control.error());
        return reception;
    }
    begin(Protocol::Cigi);
    if (!frame_order_.accept(control->host_frame)) {
        count(reception, {DropReason::StaleFrame, fmt::format("CIGI host frame {} after {}",
                                                              control->host_frame, state_.host_frame)});
        return reception;
    }
    if (auto error = obey(*control)) count(reception, std::move(*error));
    while (const auto packet = walk.next()) {
        if (auto error = apply_packet(packet->id, packet->bytes)) count(reception, std::move(*error));
    }
    if (walk.error()) count(reception, *walk.error());
    state_.arrival = arrival;
    reception.applied = true;
    return reception;
}

std::optional<WireError> HostSession::obey(const wire::CigiIgControl& control) {
    dialect_ = control.dialect;
    state_.host_frame = control.host_frame;
    if (control.timestamp_valid) {
        const std::uint32_t now = control.timestamp_10us;
        host_clock_10us_ += last_timestamp_10us_ ? static_cast<std::int32_t>(now - *last_timestamp_10us_)
                                                 : static_cast<std::int64_t>(now);
        last_timestamp_10us_ = now;
        state_.host_time_s = static_cast<double>(host_clock_10us_) * kSecondsPerTick;
    } else {
        state_.host_time_s.reset();
    }
    if (control.database > 0) state_.requested_database = control.database;
    if (control.mode > static_cast<std::uint8_t>(IgMode::Debug)) {
        return WireError{DropReason::OutOfRange,
                         "CIGI IG Control with IG mode 3, expected 0 to 2; the mode stays"};
    }
    const auto mode = static_cast<IgMode>(control.mode);
    if (mode == IgMode::Standby && state_.commanded_mode != IgMode::Standby) {
        state_.entities.clear();
        state_.views.clear();
    }
    state_.commanded_mode = mode;
    if (control.database >= 0) return std::nullopt;
    return WireError{
        DropReason::OutOfRange,
        fmt::format("CIGI IG Control with database number {}, expected 0 to 127", control.database)};
}

std::optional<WireError> HostSession::apply_packet(std::uint8_t id, std::span<const std::byte> packet) {
    const auto order = dialect_.order;
    switch (static_cast<wire::CigiPacketId>(id)) {
        case wire::CigiPacketId::EntityControl:
            return error_of(
                wire::decode_entity_control(packet, order).map([this](const auto& c) { apply(c); }));
        case wire::CigiPacketId::RateControl:
            return error_of(
                wire::decode_rate_control(packet, order).map([this](const auto& c) { apply(c); }));
        case wire::CigiPacketId::ViewControl:
            return error_of(
                wire::decode_view_control(packet, order).map([this](const auto& c) { apply(c); }));
        case wire::CigiPacketId::ViewDefinition:
            return error_of(wire::decode_view_definition(packet, order).and_then([this](const auto& d) {
                return apply(d);
            }));
        case wire::CigiPacketId::IgControl:
            return WireError{DropReason::MisplacedIgControl,
                             "a second CIGI IG Control in one message is not used"};
        case wire::CigiPacketId::StartOfFrame:
            return WireError{DropReason::MisplacedIgControl,
                             "a CIGI Start Of Frame in a host's message is not used"};
    }
    return std::nullopt;
}

void HostSession::apply(const wire::CigiEntityControl& control) {
    if (control.placed) {
        EntityState& entity = state_.entities[control.entity_id];
        const auto rates = entity.rates;
        entity = *control.placed;
        entity.rates = rates;
    } else {
        state_.entities.erase(control.entity_id);
    }
}

void HostSession::apply(const wire::CigiRateControl& control) {
    const auto entity = state_.entities.find(control.entity_id);
    if (control.of_part || entity == state_.entities.end()) return;
    entity->second.rates = control.rates;
}

void HostSession::apply(const wire::CigiViewControl& control) {
    if (control.group_id != 0) return;
    ViewState& view = state_.views[control.view_id];
    view.entity_id = control.entity_id;
    for (std::size_t axis = 0; axis < view.offset_m.size(); ++axis) {
        view.offset_m[axis] = control.offset_m[axis].value_or(view.offset_m[axis]);
    }
    view.attitude.yaw_deg = control.yaw_deg.value_or(view.attitude.yaw_deg);
    view.attitude.pitch_deg = control.pitch_deg.value_or(view.attitude.pitch_deg);
    view.attitude.roll_deg = control.roll_deg.value_or(view.attitude.roll_deg);
}

// An edge that the host has not given yet has nothing to be on the wrong side of.
tl::expected<void, WireError> HostSession::apply(const wire::CigiViewDefinition& definition) {
    const auto present = state_.views.find(definition.view_id);
    ViewState view = present == state_.views.end() ? ViewState{} : present->second;
    const auto take = [](std::optional<double>& kept, const std::optional<double>& sent) {
        if (sent) kept = sent;
    };
    take(view.near_m, definition.near_m);
    take(view.left_deg, definition.left_deg);
    take(view.right_deg, definition.right_deg);
    take(view.bottom_deg, definition.bottom_deg);
    take(view.top_deg, definition.top_deg);
    const auto crossed = [](const std::optional<double>& low, const std::optional<double>& high) {
        return low && high && *low >= *high;
    };
    if (crossed(view.left_deg, view.right_deg) || crossed(view.bottom_deg, view.top_deg)) {
        return tl::unexpected(
            WireError{DropReason::OutOfRange,
                      fmt::format("CIGI View Definition {} with left not less than right, or bottom "
                                  "not less than top",
                                  definition.view_id)});
    }
    state_.views[definition.view_id] = view;
    return {};
}

std::vector<std::byte> HostSession::start_of_frame(const IgStatus& status) const {
    wire::CigiStartOfFrame start;
    start.database = status.database;
    start.status_code = status.status_code;
    start.mode = static_cast<std::uint8_t>(status.mode);
    start.ig_frame = status.ig_frame;
    start.timestamp_10us = status.timestamp_10us;
    start.last_host_frame = spoken_ && state_.protocol == Protocol::Cigi ? state_.host_frame : 0;
    return wire::encode_start_of_frame(start, dialect_);
}

}  // namespace eyepoint::net
