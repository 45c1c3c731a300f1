/// eyepoint-bench control: whether frames cost what they may.
#include <cmath>
#include <fstream>
#include <memory>

#include <fmt/format.h>

#include "tools/bench/command_options.hpp"
#include "tools/bench/control/choice_reuse.hpp"
#include "tools/bench/control/control_report.hpp"
#include "tools/bench/eyes.hpp"

namespace eyepoint::tools {

namespace {

struct ControlRequest {
    std::filesystem::path terrain;
    EyesRequest eyes;
    std::size_t first_frames = 0;
    std::string lod_method = "nested";
    ig::ControlTarget bounds{.tau_min_px = 0.1, .tau_max_px = 16.0, .nominal_tau_px = 2.0};
    std::string clock = "cpu";
    std::vector<double> floors, rates_hz;
    std::size_t flights = 1;
    double target_share = 0.85;
    double step_floors = 1.25;
    double step_s = 3.0;
    std::optional<std::filesystem::path> json;
};

/// The frames of a control test are eyes at this rate.
constexpr double kRateHz = 60.0;

CostClock clock_of(const ControlRequest& request) {
    return request.clock == "cpu" ? CostClock::Cpu : CostClock::Wall;
}

std::vector<ig::FlightEye> eyes_of(const ControlRequest& request) {
    auto eyes = read_eyes(request.eyes);
    if (!eyes) fail(eyes.error());
    if (request.first_frames > 0 && request.first_frames < eyes->size()) eyes->resize(request.first_frames);
    return *std::move(eyes);
}

ControlStage stage_of(const ControlRequest& request) {
    ig::SceneOptions options;
    options.lod_method = request.lod_method;
    auto stage = ControlStage::create(request.terrain, options);
    if (!stage) fail(stage.error());
    return *std::move(stage);
}

std::vector<ControlledFrame> fly(ControlStage& stage, std::span<const ig::FlightEye> eyes,
                                 const FlightSetting& setting) {
    auto frames = stage.fly(eyes, setting);
    if (!frames) fail(frames.error());
    return *std::move(frames);
}

double floor_ms(ControlStage& stage, std::span<const ig::FlightEye> eyes, const ControlRequest& request) {
    const auto frames =
        fly(stage, eyes, {.control = {}, .tau_px = request.bounds.tau_max_px, .clock = clock_of(request)});
    return score(frames, request.bounds, 1.0, request.eyes.rate_hz).median_ms;
}

nlohmann::json header(const ControlRequest& request, const ControlStage& stage) {
    return {{"path", request.eyes.file.filename().string()},
            {"renderer", stage.renderer()},
            {"lod", request.lod_method},
            {"cost", request.clock},
            {"width_px", request.eyes.size.width_px},
            {"height_px", request.eyes.size.height_px},
            {"tau_min_px", request.bounds.tau_min_px},
            {"tau_max_px", request.bounds.tau_max_px}};
}

double reuse(const ControlRequest& request, std::span<const ig::FlightEye> eyes,
             std::span<const ControlledFrame> frames) {
    const auto share =
        reuse_share(request.terrain, request.lod_method, ig::SceneOptions{}.slack, eyes, frames);
    if (!share) fail(share.error());
    return *share;
}

TargetRun run_target(ControlStage& stage, std::span<const ig::FlightEye> eyes, const ControlRequest& request,
                     std::string name, double target_ms) {
    ig::ControlTarget target = request.bounds;
    target.frame_ms = target_ms;
    TargetRun run;
    run.name = std::move(name);
    for (std::size_t i = 0; i < request.flights; ++i) {
        run.controlled.push_back(fly(stage, eyes, {target, 0.0, clock_of(request)}));
        run.each.push_back(score(run.controlled.back(), target, target_ms, request.eyes.rate_hz));
    }
    run.middle = score(middle_flight(run.controlled), target, target_ms, request.eyes.rate_hz);
    run.fixed = fly(stage, eyes, {{}, std::exp(run.middle.mean_log_tau), clock_of(request)});
    run.reuse_share = reuse(request, eyes, run.controlled.front());
    run.reuse_share_fixed = reuse(request, eyes, run.fixed);
    run.beside = score(run.fixed, target, target_ms, request.eyes.rate_hz);
    return run;
}

void run_flight(const ControlRequest& request) {
    const auto eyes = eyes_of(request);
    ControlStage stage = stage_of(request);
    const double floor = floor_ms(stage, eyes, request);
    std::vector<std::pair<std::string, double>> targets;
    for (const double floors : request.floors)
        targets.emplace_back(fmt::format("{:g} floors", floors), floors * floor);
    for (const double rate_hz : request.rates_hz)
        targets.emplace_back(fmt::format("{:g} Hz", rate_hz), 1e3 * request.target_share / rate_hz);
    if (targets.empty()) targets.emplace_back("1.5 floors", 1.5 * floor);
    nlohmann::json json = header(request, stage);
    for (const auto& [name, target_ms] : targets) {
        TargetRun run = run_target(stage, eyes, request, name, target_ms);
        run.floor_ms = floor;
        fmt::print("{}", describe(run));
        json["targets"].push_back(to_json(run));
    }
    if (request.json) write_or_fail(*request.json, json.dump(1) + "\n");
}

/// The first eye, standing, in pictures of one size and of twice as many pixels beside each other: narrow,
/// wide, narrow. kappa, and with it what tau asks for, does not change.
std::vector<ig::FlightEye> step_eyes(const ControlRequest& request, std::size_t phase) {
    const ig::FlightEye first = eyes_of(request).front();
    std::vector<ig::FlightEye> eyes;
    for (std::size_t i = 0; i < 3 * phase; ++i) {
        eyes.push_back(first);
        if (i / phase == 1) eyes.back().eyepoint.view.width_px *= 2;
    }
    return eyes;
}

void run_step(const ControlRequest& request) {
    const auto phase = static_cast<std::size_t>(request.step_s * kRateHz);
    const auto eyes = step_eyes(request, phase);
    ControlStage stage = stage_of(request);
    ig::ControlTarget target = request.bounds;
    target.frame_ms = request.step_floors * floor_ms(stage, std::span(eyes).subspan(phase, kRateHz), request);
    const auto frames = fly(stage, eyes, {target, 0.0, clock_of(request)});
    fmt::print("target {:.2f} ms, {} times the coarsest picture of twice the width\n", target.frame_ms,
               request.step_floors);
    nlohmann::json json = header(request, stage);
    json["target_ms"] = target.frame_ms;
    for (std::size_t part = 0; part < 3; ++part) {
        constexpr std::array kNames{"start", "pixels doubled", "pixels halved"};
        const auto span = std::span(frames).subspan(part * phase, phase);
        const StepScore step = score_step(span, target.frame_ms, kRateHz);
        fmt::print("  {:<16}{:.2f} to {:.2f} ms, tau {:.3f} to {:.3f} px: {}", kNames[part],
                   span.front().cost_ms, span.back().cost_ms, span.front().tau_px, span.back().tau_px,
                   describe(step));
        json["steps"].push_back(to_json(step));
    }
    json["frames"] = to_json(std::span(frames));
    if (request.json) write_or_fail(*request.json, json.dump(1) + "\n");
}

void add_common(CLI::App& command, ControlRequest& request) {
    command
        .add_option("path", request.eyes.file,
                    "path over the benchmark field (csv) or recorded flight (pcap)")
        ->required()
        ->check(CLI::ExistingFile);
    command.add_option("--terrain", request.terrain, "terrain database")->type_name("DB")->required();
    add_size_option(command, request.eyes.size);
    command.add_option("--lod", request.lod_method, "level-of-detail method")->capture_default_str();
    command.add_option("--tau-min", request.bounds.tau_min_px, "least tolerance, pixels")
        ->check(CLI::Range(0.05, 100.0))
        ->capture_default_str();
    command.add_option("--tau-max", request.bounds.tau_max_px, "greatest tolerance, pixels")
        ->check(CLI::Range(0.05, 100.0))
        ->capture_default_str();
    command.add_option("--tau", request.bounds.nominal_tau_px, "tolerance to begin with, pixels")
        ->check(CLI::Range(0.05, 100.0))
        ->capture_default_str();
    command.add_option("--cost", request.clock, "cost of a frame: CPU time of the process, or wall time")
        ->check(CLI::IsMember({"cpu", "wall"}))
        ->capture_default_str();
    command.add_option("--json", request.json, "figures and frames as JSON")->type_name("FILE");
}

void add_flight(CLI::App& control) {
    auto request = std::make_shared<ControlRequest>();
    auto* command = control.add_subcommand(
        "flight", "Flies at a target, and again at the fixed tolerance of equal mean quality.");
    add_common(*command, *request);
    command->add_option("--floors", request->floors,
                        "target: so many times the flight's cost at the coarsest tolerance; may be repeated");
    command->add_option("--target-rate", request->rates_hz, "target: frames a second; may be repeated");
    command->add_option("--flights", request->flights, "times to fly at each target")
        ->check(CLI::Range(1, 100))
        ->capture_default_str();
    command->add_option("--share", request->target_share, "of the period, that a frame may take")
        ->check(CLI::Range(0.1, 1.0))
        ->capture_default_str();
    command->add_option("--rate", request->eyes.rate_hz, "frames a second of a recorded flight")
        ->check(CLI::Range(0.01, 1000.0))
        ->capture_default_str();
    command->add_option("--frames", request->first_frames, "only the first so many frames");
    command->add_flag("--ellipsoid", request->eyes.ellipsoid,
                      "a recorded flight's altitudes are above the ellipsoid, not the sea");
    command->callback([request] { run_flight(*request); });
}

void add_step(CLI::App& control) {
    auto request = std::make_shared<ControlRequest>();
    request->eyes.size = {400, 800};
    auto* command = control.add_subcommand(
        "step", "Doubles the pixels at once and halves them again, the path's first eye standing still.");
    add_common(*command, *request);
    command
        ->add_option("--floors", request->step_floors,
                     "target: so many times the cost of twice the pixels at the coarsest tolerance")
        ->capture_default_str();
    command->add_option("--seconds", request->step_s, "of each of the three parts, at 60 frames a second")
        ->check(CLI::Range(2.0, 3600.0))
        ->capture_default_str();
    command->callback([request] { run_step(*request); });
}

}  // namespace

void add_control_command(CLI::App& program) {
    auto* control = program.add_subcommand(
        "control", "Measures tolerance control: how near to their target frames stay, in virtual time.");
    control->require_subcommand(1);
    add_flight(*control);
    add_step(*control);
    control->footer(
        "Example: eyepoint-bench control flight sweep.csv --terrain FIELD --floors 1.5\n"
        "         eyepoint-bench control step cruise.csv --terrain FIELD");
}

}  // namespace eyepoint::tools
