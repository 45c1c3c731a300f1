/// Whether one flight's result is better or worse than another's.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <tl/expected.hpp>

#include "tools/bench/regression/block_bootstrap.hpp"
#include "tools/bench/regression/flight_result.hpp"

namespace eyepoint::tools {

enum class Verdict : std::uint8_t {
    Same,
    Better,
    Worse,
    Different,  ///< neither: another picture, or a count that only moved between frames
    Unclear     ///< a ratio whose interval is too wide to say
};

struct ComparedLine {
    enum class Kind : std::uint8_t { Count, Ratio, Time, Picture, Band };

    Kind kind = Kind::Count;
    std::string what;
    double before =
        0.0;  ///< a count's sum over the flight; a ratio or time; frames with a picture; a band's bound
    double after = 0.0;
    std::optional<Interval> change;  ///< after over before, where it has an interval
    Verdict verdict = Verdict::Same;
    std::string remark;  ///< may be empty
};

struct Comparison {
    std::vector<ComparedLine> lines;
    std::vector<std::string> notes;  ///< what was not compared, and why

    /// Nothing is worse or different; where `exact`, no count is better either.
    [[nodiscard]] bool passes(bool exact) const;
};

struct ComparisonOptions {
    /// A ratio or time is worse where its whole interval of after over before is above 1 + margin, better
    /// where it is below 1 - margin, the same where it is between, else unclear.
    double margin = 0.02;
};

/// before and after must be of the same flight flown the same way, else one sentence says what differs.
/// Counts are compared frame by frame and must be equal. Ratios and times are compared at the same frames,
/// with the block_bootstrap.hpp's interval of after over before; times only on the same machine and OpenGL.
/// Pictures by their hashes, on the same OpenGL.
[[nodiscard]] tl::expected<Comparison, std::string> compare(const FlightResult& before,
                                                            const FlightResult& after,
                                                            const ComparisonOptions& options = {});

/// A table for people.
[[nodiscard]] std::string describe(const Comparison& comparison);
/// The same for programs.
[[nodiscard]] std::string to_json_text(const Comparison& comparison);

}  // namespace eyepoint::tools
