#include "ig/heard_host.hpp"

#include <string>
#include <utility>

#include <fmt/format.h>

namespace eyepoint::ig {

namespace {

constexpr std::int64_t kJumpQuietNs = 1'000'000'000;

std::optional<double> fine_host_time_s(const net::HostState& state) {
    return state.protocol == net::Protocol::Cigi ? state.host_time_s : std::nullopt;
}

}  // namespace

HeardHost::HeardHost(const config::Settings& settings, net::HostLink& link, Clock& clock, Warn warn)
    : link_(link),
      clock_(clock),
      warn_(std::move(warn)),
      extrapolates_(settings.host.extrapolation == config::Switch::On),
      view_(settings.view.cigi_view),
      arrivals_(clock),
      watch_(settings.frame.rate_hz) {}

net::PollResult HeardHost::read_socket() {
    const std::int64_t until_ns = clock_.now_ns() + kHearingNs;
    net::PollResult all = link_.poll();
    net::PollResult last = all;
    while (last.datagrams == net::HostLink::kDatagramsPerPoll && clock_.now_ns() < until_ns) {
        last = link_.poll();
        all.datagrams += last.datagrams;
        all.applied += last.applied;
        all.dropped += last.dropped;
        if (!last.details.empty()) all.details = last.details;
    }
    const bool emptied = last.datagrams < net::HostLink::kDatagramsPerPoll;
    if (const auto step_s = arrivals_.read(emptied)) {
        warn_(fmt::format(
            "the system clock was set by {:+.3f} s; frames and delays go on by the steady clock", *step_s));
    }
    return all;
}

unsigned HeardHost::hear() {
    const net::PollResult heard = read_socket();
    const std::int64_t now_ns = clock_.now_ns();
    const std::string newest = heard.details.empty() ? std::string{} : heard.details.back();
    if (const auto line = drop_log_.line(link_.counters(), newest, now_ns)) warn_(*line);
    if (const auto line = watch_.hear(heard.applied, now_ns)) warn_(*line);
    if (heard.applied > 0) follow(now_ns);
    return heard.applied;
}

void HeardHost::follow(std::int64_t now_ns) {
    const net::HostState& state = *link_.state();
    last_heard_ns_ = now_ns;
    arrival_ns_ = arrivals_.steady_ns(state.arrival);
    const std::uint16_t entity_id = viewed_entity(state, view_);
    if (followed_entity_ != entity_id || !state.entities.contains(entity_id)) motion_.forget();
    followed_entity_ = entity_id;
    const auto entity = state.entities.find(entity_id);
    if (entity == state.entities.end()) return;
    const bool jumped = motion_.observe(entity->second, {arrival_ns_, fine_host_time_s(state)});
    if (!jumped || (last_jump_told_ns_ && now_ns - *last_jump_told_ns_ < kJumpQuietNs)) return;
    last_jump_told_ns_ = now_ns;
    warn_(
        fmt::format("the host's vehicle jumped to {:.5f} {:.5f}, {:.0f} m; it is drawn there, and moved on "
                    "again from its next packet",
                    entity->second.latitude_deg, entity->second.longitude_deg, entity->second.altitude_m));
}

std::optional<TimedEye> HeardHost::eye_at(std::int64_t time_ns, const EyepointReading& reading,
                                          PictureSize size) const {
    const net::HostState* state = link_.state();
    if (state == nullptr) return std::nullopt;
    const auto moved = extrapolates_ ? motion_.at(time_ns) : std::nullopt;
    const auto eyepoint =
        moved ? eyepoint_of(*state, moved->entity, reading, size) : eyepoint_of(*state, reading, size);
    if (!eyepoint) return std::nullopt;
    return TimedEye{*eyepoint, arrival_ns_, moved ? moved->by_s : 0.0};
}

double HeardHost::silent_s() const {
    if (link_.state() == nullptr) return 0.0;
    return static_cast<double>(clock_.now_ns() - last_heard_ns_) * 1e-9;
}

}  // namespace eyepoint::ig
