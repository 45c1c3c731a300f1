#include "tools/bench/goals/scratch_folder.hpp"

#include <cstdlib>
#include <system_error>

namespace eyepoint::tools {

tl::expected<ScratchFolder, std::string> ScratchFolder::create() {
    std::error_code fault;
    const auto temporary = std::filesystem::temp_directory_path(fault);
    std::string path = (temporary / "eyepoint-goals-XXXXXX").string();
    if (fault || mkdtemp(path.data()) == nullptr)
        return tl::unexpected(path + ": cannot be made; check TMPDIR and free space");
    return ScratchFolder(path);
}

ScratchFolder& ScratchFolder::operator=(ScratchFolder&& other) noexcept {
    std::swap(path_, other.path_);
    return *this;
}

ScratchFolder::~ScratchFolder() {
    std::error_code ignored;
    if (!path_.empty()) std::filesystem::remove_all(path_, ignored);
}

}  // namespace eyepoint::tools
