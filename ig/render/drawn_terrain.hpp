/// Where the passes find terrain on the graphics card.
#pragma once

#include <cstddef>

#include <epoxy/gl.h>

namespace eyepoint::ig {

/// Texture units, as in the shaders.
inline constexpr GLuint kImageUnit = 0, kNoiseUnit = 1, kVertexUnit = 2, kSurfaceUnit = 3, kRecordUnit = 4,
                        kReliefUnit = 5;

/// Names of GL objects that others own, and the set of features (program.hpp) that any block needs.
struct DrawnTerrain {
    GLuint vertices = 0;      ///< terrain::BlockVertex, kBlockVertices a block
    GLuint vertex_words = 0;  ///< the same as a buffer texture, two texels a vertex
    GLuint indices = 0;
    GLuint records = 0;       ///< BlockRecord of block.glsl, one a block
    GLuint record_words = 0;  ///< the same as a buffer texture, four texels a record
    GLuint relief = 0;        ///< terrain::ReliefPost as a buffer texture, kBlockVertices a block
    GLuint images = 0;
    GLuint slides = 0;  ///< of tile_slide.glsl, where vertices of grids slide
    std::size_t features = 0;

    /// Binds what fragment shaders read of it, and the noise.
    void bind_painted(GLuint noise) const {
        glBindTextureUnit(kImageUnit, images);
        glBindTextureUnit(kNoiseUnit, noise);
        glBindTextureUnit(kRecordUnit, record_words);
        glBindTextureUnit(kReliefUnit, relief);
    }
};

}  // namespace eyepoint::ig
