#include "tools/bench/papers/built_field.hpp"

#include <chrono>

#include "tools/process/child_process.hpp"

namespace eyepoint::tools {

tl::expected<BuiltField, std::string> BuiltField::build(const PaperSettings& settings,
                                                        const std::vector<std::string>& arguments) {
    constexpr std::chrono::minutes kPatience{30};
    auto scratch = ScratchFolder::create();
    if (!scratch) return tl::unexpected(scratch.error());
    const auto folder = scratch->path() / "field";
    std::vector<std::string> command{(settings.programs / "eyepoint-terrain").string(),
                                     "build",
                                     "--vertical",
                                     "ellipsoid",
                                     "-o",
                                     folder.string()};
    command.insert(command.end(), arguments.begin(), arguments.end());
    auto child = ChildProcess::start(command);
    if (!child) return tl::unexpected(child.error());
    const Ending ending = child->wait(kPatience);
    if (ending.exit_code != 0) return tl::unexpected("eyepoint-terrain failed: " + ending.standard_error);
    auto database = terrain::Database::open(folder);
    if (!database) return tl::unexpected(database.error());
    return BuiltField{std::move(*scratch), std::make_shared<const terrain::Database>(std::move(*database))};
}

}  // namespace eyepoint::tools
