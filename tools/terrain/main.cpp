/// eyepoint-terrain: makes, describes, checks and pictures terrain databases.
#include <CLI/CLI.hpp>

#include "tools/terrain/info_command.hpp"
#include "tools/terrain/preview_command.hpp"
#include "tools/terrain/synth_command.hpp"
#include "tools/terrain/verify_command.hpp"
#ifdef EYEPOINT_HAS_BUILD_COMMAND
#include "tools/terrain/build_command.hpp"
#endif

int main(int argc, char** argv) {
    CLI::App application{"Makes, describes, checks and pictures terrain databases.", "eyepoint-terrain"};
    application.set_version_flag("--version", "eyepoint-terrain " EYEPOINT_VERSION);
    application.require_subcommand(1);
    application.footer(
        "Exit codes: 0 done, 1 failed (one line on stderr says why), above 100 wrong usage.\n"
        "Examples:\n  eyepoint-terrain synth -o out/synth\n  eyepoint-terrain info out/synth\n"
        "  eyepoint-terrain preview out/synth -o relief.png");
    eyepoint::tools::add_synth_command(application);
    eyepoint::tools::add_info_command(application);
    eyepoint::tools::add_verify_command(application);
    eyepoint::tools::add_preview_command(application);
#ifdef EYEPOINT_HAS_BUILD_COMMAND
    eyepoint::tools::add_build_command(application);
#endif
    CLI11_PARSE(application, argc, argv);
    return 0;
}
