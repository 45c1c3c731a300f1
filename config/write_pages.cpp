/// Writes config/eyepoint.toml and docs/settings.md anew from the table of settings: write_pages
/// SOURCE_FOLDER
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>

#include <fmt/format.h>

#include "config/pages.hpp"

namespace {

bool write(const std::filesystem::path& file, const std::string& text) {
    std::ofstream stream(file, std::ios::binary);
    stream << text;
    stream.close();
    if (!stream) fmt::print(stderr, "{}: cannot be written\n", file.string());
    return static_cast<bool>(stream);
}

}  // namespace

int main(int argument_count, char** arguments) {
    if (argument_count != 2) {
        fmt::print(stderr, "usage: write_pages SOURCE_FOLDER\n");
        return EXIT_FAILURE;
    }
    const std::filesystem::path root(arguments[1]);
    const bool written = write(root / "config/eyepoint.toml", eyepoint::config::sample_file()) &&
                         write(root / "docs/settings.md", eyepoint::config::reference_page());
    return written ? EXIT_SUCCESS : EXIT_FAILURE;
}
