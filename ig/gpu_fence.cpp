#include "ig/gpu_fence.hpp"

#include <epoxy/gl.h>

namespace eyepoint::ig {

namespace {
constexpr GLuint64 kPatienceNs = 10'000'000'000ULL;
}

bool wait_for_gpu() {
    const GLsync fence = glFenceSync(GL_SYNC_GPU_COMMANDS_COMPLETE, 0);
    if (fence == nullptr) return false;
    const GLenum outcome = glClientWaitSync(fence, GL_SYNC_FLUSH_COMMANDS_BIT, kPatienceNs);
    glDeleteSync(fence);
    return outcome == GL_ALREADY_SIGNALED || outcome == GL_CONDITION_SATISFIED;
}

}  // namespace eyepoint::ig
