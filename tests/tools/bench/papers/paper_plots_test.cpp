#include "tools/bench/papers/paper_plots.hpp"

#include <algorithm>
#include <array>
#include <fstream>
#include <iterator>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace eyepoint::tools {
namespace {

using ::testing::ElementsAre;
using ::testing::Field;
using ::testing::HasSubstr;
using ::testing::Not;

PaperTable plotted() {
    return {.source = "Author, table 1",
            .setting = "Flown with `tile`.",
            .names = "faces",
            .rows = {{"5000", {{"rate", 15.0, 145.0}, {"nested: rate", 14.0, {}}}, 5000.0, "bintree"},
                     {"10000", {{"rate", 14.0, 115.0}, {"nested: rate", {}, {}}}, 10000.0, "bintree"},
                     {"a footnote", {{"rate", 1.0, 2.0}, {"nested: rate", 3.0, {}}}, 0.0, ""}},
            .notes = {},
            .plots = {{"Rates", "faces", {"rate", "nested: rate"}, {"bintree"}, true}}};
}

TEST(PaperPlots, OursAndThePapersAreLinesOfOneColour) {
    const PlotSection section = plots_of(plotted());
    EXPECT_EQ(section.heading, "Author, table 1");
    ASSERT_EQ(section.plots.size(), 1U);
    const Plot& plot = section.plots.front();
    EXPECT_EQ(plot.x, "faces");
    EXPECT_TRUE(plot.logarithmic);
    using Point = std::array<double, 2>;
    ASSERT_EQ(plot.series.size(), 3U);
    EXPECT_EQ(plot.series[0].name, "rate");
    EXPECT_THAT(plot.series[0].points, ElementsAre(Point{5000.0, 15.0}, Point{10000.0, 14.0}));
    EXPECT_FALSE(plot.series[0].dashed);
    EXPECT_EQ(plot.series[1].name, "rate, paper");
    EXPECT_THAT(plot.series[1].points, ElementsAre(Point{5000.0, 145.0}, Point{10000.0, 115.0}));
    EXPECT_TRUE(plot.series[1].dashed);
    EXPECT_EQ(plot.series[1].colour, plot.series[0].colour);
    EXPECT_EQ(plot.series[2].name, "nested: rate");
    EXPECT_THAT(plot.series[2].points, ElementsAre(Point{5000.0, 14.0})) << "what there is not is no point";
}

TEST(PaperPlots, LinesOfOneFigureGoByTheirOwnNames) {
    PaperTable table = plotted();
    table.rows[1].line = "another";
    table.plots = {{"Rates", "faces", {"rate"}, {"bintree", "another"}}};
    EXPECT_THAT(plots_of(table).plots.front().series,
                ElementsAre(Field(&PlotSeries::name, "bintree"), Field(&PlotSeries::name, "bintree, paper"),
                            Field(&PlotSeries::name, "another"), Field(&PlotSeries::name, "another, paper")));
}

PaperResults published() {
    std::ifstream stream(EYEPOINT_SOURCE_DIR "/docs/results/papers.json");
    return parse_paper_results({std::istreambuf_iterator<char>(stream), {}}).value();
}

TEST(PaperPlots, ThePageOfThePublishedResultsHasEveryExperiment) {
    const PaperResults results = published();
    ASSERT_EQ(results.tables.size(), 4U);
    const std::string page = plots_page(results);
    for (const char* heading :
         {"<h2>Ueng &amp; Chuang, tables 1 to 3</h2>", "<h2>He, Wang &amp; Liu, table 1</h2>",
          "<h2>Larsen &amp; Christensen, table 7</h2>", "<h2>HyperBlock-QuadTIN, figures 14 to 16</h2>"})
        EXPECT_THAT(page, HasSubstr(heading));
    for (const PaperTable& table : results.tables) {
        const PlotSection section = plots_of(table);
        ASSERT_FALSE(section.plots.empty()) << table.source;
        for (const Plot& plot : section.plots) {
            EXPECT_GE(plot.series.size(), 2U) << plot.title;
            EXPECT_THAT(page, HasSubstr("\"title\":\"" + plot.title + "\""));
        }
    }
}

// A row may be of no plot only because nothing is plotted of it: every line that rows name is one of a
// plot's.
TEST(PaperPlots, EveryRowOfThePublishedResultsIsAPointOfALine) {
    for (const PaperTable& table : published().tables) {
        for (const PaperRow& row : table.rows) {
            EXPECT_TRUE(std::ranges::any_of(table.plots,
                                            [&](const PaperPlot& plot) {
                                                return std::ranges::find(plot.lines, row.line) !=
                                                       plot.lines.end();
                                            }))
                << table.source << ": " << row.name;
        }
    }
}

TEST(PaperPlots, ThePublishedPagesAreThoseOfThePublishedFigures) {
    std::ifstream stream(EYEPOINT_SOURCE_DIR "/docs/results/papers.md");
    const std::string page{std::istreambuf_iterator<char>(stream), {}};
    const PaperResults results = published();
    EXPECT_EQ(markdown(results.tables, results.machine), page);
}

TEST(PaperPlots, ThePageIsWholeInItself) {
    const std::string page = plots_page({"a <machine>", {plotted()}});
    EXPECT_THAT(page, ::testing::StartsWith("<!DOCTYPE html>"));
    EXPECT_THAT(page, ::testing::EndsWith("</html>\n"));
    EXPECT_THAT(page, HasSubstr("Chart.js v"));
    EXPECT_THAT(page, HasSubstr("default-src 'none'"));
    for (const char* fetched : {"<link", "@import", " src=", "{{"}) {
        const auto script = page.find("<script>");
        EXPECT_THAT(page.substr(0, script), Not(HasSubstr(fetched)));
    }
    EXPECT_THAT(page, HasSubstr("Flown with <code>tile</code>."));
    EXPECT_THAT(page, HasSubstr("a &lt;machine&gt;"));
}

}  // namespace
}  // namespace eyepoint::tools
