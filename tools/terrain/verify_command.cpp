#include "tools/terrain/verify_command.hpp"

#include <memory>
#include <string>

#include <fmt/format.h>

#include "tools/terrain/command_failure.hpp"
#include "tools/terrain/progress_bar.hpp"
#include "tools/terrain/verify.hpp"

namespace eyepoint::tools {

void add_verify_command(CLI::App& application) {
    auto folder = std::make_shared<std::string>();
    auto* command = application.add_subcommand(
        "verify",
        "Reads all of a terrain database and checks that it is whole, without seams, and its errors bounded");
    command->add_option("database", *folder, "Folder of the database")->required();
    command->callback([folder] {
        const auto database = terrain::Database::open(*folder);
        if (!database) fail("verify", database.error());
        std::vector<std::string> faults;
        {
            ProgressBar bar{"verify"};
            VerifyRequest request;
            request.progress = [&bar](std::uint64_t done, std::uint64_t total) { bar.show(done, total); };
            faults = verify(*database, request);
        }
        for (const std::string& fault : faults) report_failure("verify", fault);
        if (!faults.empty()) throw CLI::RuntimeError(1);
        fmt::print("{}: sound, {} tiles\n", *folder, database->manifest().tiles);
    });
}

}  // namespace eyepoint::tools
