/// eyepoint-report: a run's frame record and pictures as one page, and pictures as a contact sheet.
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "tools/report/contact_sheet.hpp"
#include "tools/report/frame_columns.hpp"
#include "tools/report/page.hpp"
#include "tools/report/pictures.hpp"

namespace {

namespace tools = eyepoint::tools;

struct Request {
    std::filesystem::path record{};
    std::filesystem::path pictures{};
    std::filesystem::path output{};
    std::string title{};
    std::size_t count = 12;
    int columns = 4;
    int width_px = 480;
};

using Done = tl::expected<void, std::string>;

tl::expected<std::vector<tools::SmallPicture>, std::string> small_pictures(const Request& request) {
    const auto files = tools::choose_pictures(request.pictures, request.count);
    if (!files) return tl::unexpected(files.error());
    std::vector<tools::SmallPicture> pictures;
    for (const auto& file : *files) {
        auto picture = tools::read_small(file, request.width_px);
        if (!picture) return tl::unexpected(picture.error());
        pictures.push_back(std::move(*picture));
    }
    return pictures;
}

Done write_page(const Request& request) {
    const auto record = tools::read_frame_columns(request.record);
    if (!record) return tl::unexpected(record.error());
    std::vector<tools::SmallPicture> pictures;
    if (!request.pictures.empty()) {
        auto read = small_pictures(request);
        if (!read) return tl::unexpected(read.error());
        pictures = std::move(*read);
    }
    const auto title = request.title.empty() ? request.record.stem().string() : request.title;
    const auto page = tools::report_page(title, *record, pictures);
    if (!page) return tl::unexpected(page.error());
    return tools::write_whole(request.output, *page);
}

Done write_contact_sheet(const Request& request) {
    const auto pictures = small_pictures(request);
    if (!pictures) return tl::unexpected(pictures.error());
    return tools::write_picture(request.output, tools::lay_out(*pictures, request.columns));
}

void add_picture_options(CLI::App& command, Request& request) {
    command.add_option("--count", request.count, "Pictures to show, spread evenly over the run")
        ->check(CLI::Range(1, 200))
        ->capture_default_str();
    command.add_option("--width", request.width_px, "Width of each picture, pixels")
        ->check(CLI::Range(16, 4096))
        ->capture_default_str();
}

int run(int argument_count, char** arguments) {
    CLI::App app(
        "Turns a run of eyepoint into a page to read.\n"
        "  eyepoint-report page --record flight.jsonl --pictures pictures -o report.html\n"
        "  eyepoint-report contact-sheet --pictures pictures -o contact-sheet.png");
    app.require_subcommand(1);
    Request page{.output = "report.html"};
    auto* page_command =
        app.add_subcommand("page", "Plots and percentiles of a frame record as one HTML file");
    page_command->add_option("--record", page.record, "Frame record that eyepoint wrote with --record")
        ->required();
    page_command->add_option("--pictures", page.pictures, "Folder of numbered pictures");
    page_command->add_option("-o,--output", page.output, "Page to write")->capture_default_str();
    page_command->add_option("--title", page.title, "Title; the record's name where left out");
    add_picture_options(*page_command, page);
    Request sheet{.output = "contact-sheet.png"};
    auto* sheet_command = app.add_subcommand("contact-sheet", "Pictures of a run on one");
    sheet_command->add_option("--pictures", sheet.pictures, "Folder of numbered pictures")->required();
    sheet_command->add_option("-o,--output", sheet.output, "Picture to write")->capture_default_str();
    sheet_command->add_option("--columns", sheet.columns, "Pictures in a row")
        ->check(CLI::Range(1, 50))
        ->capture_default_str();
    add_picture_options(*sheet_command, sheet);
    CLI11_PARSE(app, argument_count, arguments);

    const bool is_page = page_command->parsed();
    const auto done = is_page ? write_page(page) : write_contact_sheet(sheet);
    if (!done) {
        fmt::print(stderr, "eyepoint-report: {}\n", done.error());
        return EXIT_FAILURE;
    }
    fmt::print("{}\n", (is_page ? page : sheet).output.string());
    return EXIT_SUCCESS;
}

}  // namespace

int main(int argument_count, char** arguments) {
    try {
        return run(argument_count, arguments);
    } catch (const std::exception& fault) {
        std::fprintf(stderr, "eyepoint-report: unexpected fault: %s\n", fault.what());
        return EXIT_FAILURE;
    }
}
