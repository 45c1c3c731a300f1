/// Shader programs from the GLSL files beside this one, which are compiled into the program's binary.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include <tl/expected.hpp>

#include "ig/render/gl_objects.hpp"

namespace eyepoint::ig {

/// Text of ig/render/shaders/NAME; empty for an unknown name.
[[nodiscard]] std::string_view shader_text(std::string_view name);

/// What a program is made of. Each stage is the files one after the other, behind `#version 450 core` and a
/// #define for each name.
struct ProgramSource {
    std::vector<std::string_view> vertex_files;
    std::vector<std::string_view> fragment_files;
    std::vector<std::string_view> defines;
};

/// What a block's shading needs beside ground; sets of them are sums.
inline constexpr std::size_t kWaterFeature = 1;
inline constexpr std::size_t kImageFeature = 2;
inline constexpr std::size_t kFeatureSets = 4;
/// nested: what is painted changes with the level asked for (relief.glsl).
[[nodiscard]] std::vector<std::string_view> shading_defines(std::size_t set, bool nested);

/// The terrain's fragment shader, run with the triangles.
[[nodiscard]] std::vector<std::string_view> ground_files();

/// A linked program. On failure: the driver's message with the names of the files.
[[nodiscard]] tl::expected<GlProgram, std::string> link_program(const ProgramSource& source);

}  // namespace eyepoint::ig
