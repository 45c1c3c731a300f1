#include "tools/bench/papers/paper_table.hpp"

#include <array>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace eyepoint::tools {
namespace {

using ::testing::HasSubstr;

PaperTable rates() {
    return {"Author, table 1",
            "How it was flown.",
            "faces",
            {{"5000", {{"frames a second", 123.4, 145.0}, {"bytes", 1.625, {}}, {"cracks", {}, {}}}},
             {"10000", {{"frames a second", 62.25, {}}, {"bytes", 16.5, {}}, {"cracks", 0.0, {}}}}},
            {"A note."}};
}

TEST(PaperTable, ThePapersFigureStandsBesideOursWhereItGivesOne) {
    const std::string page = markdown(std::array{rates()}, "a machine");
    EXPECT_THAT(page, HasSubstr("Machine: a machine\n"));
    EXPECT_THAT(page, HasSubstr("## Author, table 1\n\nHow it was flown.\n"));
    EXPECT_THAT(page, HasSubstr("| faces | frames a second | paper | bytes | cracks |\n"
                                "| --- | --- | --- | --- | --- |\n"
                                "| 5000 | 123 | 145 | 1.62 |  |\n"
                                "| 10000 | 62.2 |  | 16.5 | 0.00 |\n"));
    EXPECT_THAT(page, HasSubstr("\nA note.\n"));
}

TEST(PaperTable, TablesFollowEachOtherOnOnePage) {
    PaperTable other = rates();
    other.source = "Another, table 7";
    const std::string page = markdown(std::array{rates(), other}, "a machine");
    EXPECT_LT(page.find("## Author, table 1"), page.find("## Another, table 7"));
}

TEST(PaperTable, JsonHasEveryFigureInFullAndNullWhereThereIsNone) {
    const auto json = to_json(std::array{rates()}, "a machine");
    EXPECT_EQ(json["machine"], "a machine");
    const auto& table = json["tables"][0];
    EXPECT_EQ(table["source"], "Author, table 1");
    const auto& figures = table["rows"][0]["figures"];
    EXPECT_EQ(figures[0]["what"], "frames a second");
    EXPECT_EQ(figures[0]["ours"], 123.4);
    EXPECT_EQ(figures[0]["paper"], 145.0);
    EXPECT_TRUE(figures[1]["paper"].is_null());
    EXPECT_TRUE(figures[2]["ours"].is_null());
    EXPECT_EQ(table["notes"][0], "A note.");
}

TEST(PaperTable, WhatIsWrittenAsJsonIsReadAgain) {
    PaperTable table = rates();
    table.rows[0].x = 5000.0;
    table.rows[0].line = "bintree";
    table.plots = {{"Rates", "faces", {"frames a second"}, {"bintree"}, true}};
    const auto json = to_json(std::array{table}, "a machine");
    const auto read = parse_paper_results(json.dump());
    ASSERT_TRUE(read) << read.error();
    EXPECT_EQ(to_json(read->tables, read->machine), json);
}

TEST(PaperTable, JsonThatIsNoResultIsRefusedInOneSentence) {
    for (const char* text : {"", "{", "[]", "{\"machine\":1,\"tables\":[]}",
                             "{\"machine\":\"a\",\"tables\":[{\"source\":\"b\"}]}"}) {
        const auto read = parse_paper_results(text);
        ASSERT_FALSE(read) << text;
        EXPECT_THAT(read.error(), HasSubstr("not results of eyepoint-bench papers"));
        EXPECT_EQ(read.error().find('\n'), std::string::npos);
    }
}

}  // namespace
}  // namespace eyepoint::tools
