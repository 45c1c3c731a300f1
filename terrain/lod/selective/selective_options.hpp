/// What of the method of Ueng & Chuang can be chosen.
#pragma once

#include <cstdint>

namespace eyepoint::terrain::selective {

/// How many pixels leaving a vertex out has. D: distance from the eye, h: the horizontal part of it; kappa,
/// the paper's d * lambda, pixels per unit of metres over metres.
enum class ErrorFormula : std::uint8_t {
    /// kappa E / D, E a bound on the distance of the surface from what is drawn where the vertex is left out
    /// (BlockPosts::bound_m), and D the least distance to there: holds at every point.
    Bound,
    /// The paper's: kappa delta h / D^2, delta the vertex's own height difference, at the vertex alone. It
    /// knows nothing of posts beside the vertex.
    Paper
};

/// When a block's selection is used again.
enum class ReuseTest : std::uint8_t {
    Sound,       ///< by the way flown: no vertex left out is above tau + s, wherever the eye is
    FourCorner,  ///< the paper's, at the block's corners, for eyes outside the block
    Off          ///< never
};

struct Options {
    ErrorFormula error = ErrorFormula::Bound;
    ReuseTest reuse = ReuseTest::Sound;
};

}  // namespace eyepoint::terrain::selective
