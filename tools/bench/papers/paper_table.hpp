/// A table of a published paper, measured again: the paper's figures beside ours.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>
#include <tl/expected.hpp>

namespace eyepoint::tools {

struct PaperFigure {
    std::string what;  ///< with its unit; the same in all rows of a table
    std::optional<double> ours;
    std::optional<double> paper;
};

struct PaperRow {
    std::string name;
    std::vector<PaperFigure> figures;
    // In plots:
    double x = 0.0;
    std::string line{};  ///< that it is a point of; empty: in none
};

/// Figures of a table's rows over their x.
struct PaperPlot {
    std::string title;
    std::string x;                     ///< what the rows' x is, with its unit
    std::vector<std::string> figures;  ///< PaperFigure::what
    std::vector<std::string> lines;    ///< PaperRow::line
    bool logarithmic = false;          ///< the figures' axis
};

struct PaperTable {
    std::string source;   ///< authors and the table's number
    std::string setting;  ///< a paragraph: terrain, flight, picture, what stands for what
    std::string names;    ///< what the rows' names are
    std::vector<PaperRow> rows;
    std::vector<std::string> notes;  ///< paragraphs under the table
    std::vector<PaperPlot> plots{};
};

struct PaperResults {
    std::string machine;
    std::vector<PaperTable> tables;
};

/// A page: a heading and a table each. Figures that the paper gives have a column for it.
[[nodiscard]] std::string markdown(std::span<const PaperTable> tables, const std::string& machine);
/// What to_json() gave, as text. On failure (another text): one sentence.
[[nodiscard]] tl::expected<PaperResults, std::string> parse_paper_results(const std::string& text);
/// A figure that there is not is null.
[[nodiscard]] nlohmann::json to_json(std::span<const PaperTable> tables, const std::string& machine);

}  // namespace eyepoint::tools
