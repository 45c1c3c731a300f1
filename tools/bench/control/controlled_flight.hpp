/// Flying with and without tolerance control, in virtual time: every eye is drawn, however long it takes, and
/// scored by what it cost.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <tl/expected.hpp>

#include "ig/control/tolerance_controller.hpp"
#include "ig/egl_context.hpp"
#include "ig/frame_buffer.hpp"
#include "ig/recorded_flight.hpp"
#include "ig/scene.hpp"

namespace eyepoint::tools {

/// What a frame's cost is taken to be.
enum class CostClock : std::uint8_t {
    Cpu,  ///< CPU time of all threads of the process: on a software renderer all there is
    Wall  ///< monotonic clock, from the first call to the fence
};

struct ControlledFrame {
    double cost_ms = 0.0;
    double tau_px = 0.0;
    std::uint64_t triangles = 0;
    std::uint64_t bytes_uploaded = 0;
    ig::ControlState state = ig::ControlState::Steady;  ///< after the frame
    double unreachable_share = 0.0;
};

struct FlightSetting {
    std::optional<ig::ControlTarget> control;  ///< none: tau stands
    double tau_px = 1.0;                       ///< where it stands
    CostClock clock = CostClock::Cpu;
};

/// An OpenGL context with a scene. Thread use: one thread.
class ControlStage {
  public:
    /// On failure: one sentence.
    [[nodiscard]] static tl::expected<ControlStage, std::string> create(const std::filesystem::path& terrain,
                                                                        const ig::SceneOptions& options);

    /// Draws every eye once, in its own size; what an eye asks for is loaded before, not counted. The first
    /// eye is drawn a few times before the first frame that counts. On failure: one sentence.
    [[nodiscard]] tl::expected<std::vector<ControlledFrame>, std::string> fly(
        std::span<const ig::FlightEye> eyes, const FlightSetting& setting);

    [[nodiscard]] const std::string& renderer() const { return context_.identity().renderer; }

  private:
    ControlStage(ig::EglContext context, std::unique_ptr<ig::Scene> scene);
    [[nodiscard]] tl::expected<void, std::string> fit(const ig::View& view);

    ig::EglContext context_;
    std::unique_ptr<ig::Scene> scene_;
    std::optional<ig::FrameBuffer> frame_buffer_;
};

}  // namespace eyepoint::tools
