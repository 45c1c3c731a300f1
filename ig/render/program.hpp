/// Shader programs from the GLSL files beside this one, which are compiled into the program's binary.
#pragma once

#include <span>
#include <string>
#include <string_view>

#include <tl/expected.hpp>

#include "ig/render/gl_objects.hpp"

namespace eyepoint::ig {

/// Text of ig/render/shaders/NAME; empty for an unknown name.
[[nodiscard]] std::string_view shader_text(std::string_view name);

/// A linked program. Each stage is the given files one after the other, behind `#version 450 core`.
/// On failure: the driver's message with the names of the files.
[[nodiscard]] tl::expected<GlProgram, std::string> link_program(
    std::span<const std::string_view> vertex_files, std::span<const std::string_view> fragment_files);

}  // namespace eyepoint::ig
