/// A table of a published paper, measured again: the paper's figures beside ours.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

namespace eyepoint::tools {

struct PaperFigure {
    std::string what;  ///< with its unit; the same in all rows of a table
    std::optional<double> ours;
    std::optional<double> paper;
};

struct PaperRow {
    std::string name;
    std::vector<PaperFigure> figures;
};

struct PaperTable {
    std::string source;   ///< authors and the table's number
    std::string setting;  ///< a paragraph: terrain, flight, picture, what stands for what
    std::string names;    ///< what the rows' names are
    std::vector<PaperRow> rows;
    std::vector<std::string> notes;  ///< paragraphs under the table
};

/// A page: a heading and a table each. Figures that the paper gives have a column for it.
[[nodiscard]] std::string markdown(std::span<const PaperTable> tables, const std::string& machine);
/// A figure that there is not is null.
[[nodiscard]] nlohmann::json to_json(std::span<const PaperTable> tables, const std::string& machine);

}  // namespace eyepoint::tools
