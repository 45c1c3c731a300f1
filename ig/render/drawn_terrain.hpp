/// Where the passes find terrain on the graphics card.
#pragma once

#include <cstddef>

#include <epoxy/gl.h>

namespace eyepoint::ig {

/// Names of GL objects that others own, and the set of features (program.hpp) that any block needs.
struct DrawnTerrain {
    GLuint vertices = 0;      ///< terrain::BlockVertex, kBlockVertices a block
    GLuint vertex_words = 0;  ///< the same as a buffer texture of pairs of words
    GLuint indices = 0;
    GLuint records = 0;       ///< BlockRecord of block.glsl, one a block
    GLuint record_words = 0;  ///< the same as a buffer texture, three texels a record
    GLuint images = 0;
    std::size_t features = 0;
};

}  // namespace eyepoint::ig
