#include "ig/render/program.hpp"

#include <array>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace eyepoint::ig {

namespace {

std::string shader_log(GLuint shader) {
    std::array<char, 2048> text{};
    GLsizei length = 0;
    glGetShaderInfoLog(shader, static_cast<GLsizei>(text.size()), &length, text.data());
    return {text.data(), static_cast<std::size_t>(length)};
}

std::string program_log(GLuint program) {
    std::array<char, 2048> text{};
    GLsizei length = 0;
    glGetProgramInfoLog(program, static_cast<GLsizei>(text.size()), &length, text.data());
    return {text.data(), static_cast<std::size_t>(length)};
}

tl::expected<GlShader, std::string> compile(GLenum stage, const std::vector<std::string_view>& files,
                                            const std::vector<std::string_view>& defines) {
    std::string head = "#version 450 core\n";
    for (const std::string_view name : defines) head += fmt::format("#define {}\n", name);
    std::vector<const char*> texts{head.c_str()};
    std::vector<GLint> lengths{-1};
    for (const std::string_view file : files) {
        const std::string_view text = shader_text(file);
        texts.push_back(text.data());
        lengths.push_back(static_cast<GLint>(text.size()));
    }
    GlShader shader{stage};
    glShaderSource(shader.name(), static_cast<GLsizei>(texts.size()), texts.data(), lengths.data());
    glCompileShader(shader.name());
    GLint compiled = GL_FALSE;
    glGetShaderiv(shader.name(), GL_COMPILE_STATUS, &compiled);
    if (compiled == GL_FALSE) {
        return tl::unexpected(fmt::format("shader {} does not compile: {}", fmt::join(files, " + "),
                                          shader_log(shader.name())));
    }
    return shader;
}

}  // namespace

std::vector<std::string_view> shading_defines(std::size_t set, bool nested) {
    std::vector<std::string_view> defines;
    if ((set & kWaterFeature) != 0) defines.emplace_back("WATER");
    if ((set & kImageFeature) != 0) defines.emplace_back("IMAGES");
    if (nested) defines.emplace_back("RELIEF_BY_LEVEL");
    return defines;
}

std::vector<std::string_view> ground_files() {
    return {"frame.glsl",      "tile.glsl",   "relief.glsl",      "chapman.glsl",
            "atmosphere.glsl", "ground.glsl", "terrain.frag.glsl"};
}

tl::expected<GlProgram, std::string> link_program(const ProgramSource& source) {
    auto vertex = compile(GL_VERTEX_SHADER, source.vertex_files, source.defines);
    if (!vertex) return tl::unexpected(vertex.error());
    auto fragment = compile(GL_FRAGMENT_SHADER, source.fragment_files, source.defines);
    if (!fragment) return tl::unexpected(fragment.error());
    GlProgram program;
    glAttachShader(program.name(), vertex->name());
    glAttachShader(program.name(), fragment->name());
    glLinkProgram(program.name());
    GLint linked = GL_FALSE;
    glGetProgramiv(program.name(), GL_LINK_STATUS, &linked);
    if (linked == GL_FALSE) {
        return tl::unexpected(
            fmt::format("shaders {} and {} do not link: {}", fmt::join(source.vertex_files, " + "),
                        fmt::join(source.fragment_files, " + "), program_log(program.name())));
    }
    return program;
}

}  // namespace eyepoint::ig
