#include "tools/bench/goals/profiled_flight.hpp"

#include <chrono>
#include <fstream>
#include <iterator>
#include <utility>

#include "tools/bench/goals/scratch_folder.hpp"
#include "tools/process/child_process.hpp"

namespace eyepoint::tools {

tl::expected<ProfiledFlight, std::string> profile_selection(const GoalBench& bench, std::size_t frames,
                                                            const std::vector<std::string>& arguments) {
    const auto scratch = ScratchFolder::create();
    if (!scratch) return tl::unexpected(scratch.error());
    const auto json_file = scratch->path() / "flight.json", profile_file = scratch->path() / "profile";
    const GoalSettings& settings = bench.settings();
    std::vector<std::string> command{"valgrind",
                                     "--tool=callgrind",
                                     "--collect-atstart=no",
                                     "--toggle-collect=*LodFlight::choose*",
                                     "--callgrind-out-file=" + profile_file.string(),
                                     (settings.programs / "eyepoint-bench").string(),
                                     "measure",
                                     (settings.paths / "cruise.csv").string(),
                                     "--terrain",
                                     settings.terrain.string(),
                                     "--frames",
                                     std::to_string(frames),
                                     "--selection-only",
                                     "--json",
                                     json_file.string()};
    command.insert(command.end(), arguments.begin(), arguments.end());
    auto child = ChildProcess::start(std::move(command));
    if (!child) return tl::unexpected(child.error());
    constexpr std::chrono::seconds kPatience{1200};
    const Ending ending = child->wait(kPatience);
    auto json = nlohmann::json::parse(std::ifstream(json_file), nullptr, false);
    if (ending.exit_code != 0 || json.is_discarded())
        return tl::unexpected(std::string("valgrind cannot run this program"));
    std::ifstream profile(profile_file);
    return ProfiledFlight{{std::istreambuf_iterator<char>(profile), {}}, std::move(json["frames"])};
}

}  // namespace eyepoint::tools
