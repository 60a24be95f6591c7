#include "patches/visibility/opengl_patches.h"

#include <epoxy/gl.h>
#include <fmt/format.h>

#include <array>
#include <stdexcept>
#include <vector>

namespace stilb::patches {
namespace {

GLuint compiled(GLenum kind, const char* source) {
    const GLuint shader = glCreateShader(kind);
    glShaderSource(shader, 1, &source, nullptr);
    glCompileShader(shader);
    GLint ok = GL_FALSE;
    glGetShaderiv(shader, GL_COMPILE_STATUS, &ok);
    if (ok == GL_TRUE) return shader;
    std::array<char, 1024> log{};
    glGetShaderInfoLog(shader, log.size(), nullptr, log.data());
    throw std::runtime_error(fmt::format("OpenGL refuses a shader: {}", log.data()));
}

GLuint linked_program(const ShaderSources& sources) {
    const GLuint program = glCreateProgram();
    for (const GLuint shader :
         {compiled(GL_VERTEX_SHADER, sources.vertex), compiled(GL_FRAGMENT_SHADER, sources.fragment)}) {
        glAttachShader(program, shader);
        glDeleteShader(shader);  // lives as long as the program
    }
    glLinkProgram(program);
    GLint ok = GL_FALSE;
    glGetProgramiv(program, GL_LINK_STATUS, &ok);
    if (ok != GL_TRUE) throw std::runtime_error("OpenGL cannot link its shaders");
    return program;
}

void upload(const Patches& patches) {
    GLuint vertex_array = 0;
    std::array<GLuint, 2> buffers{};
    glGenVertexArrays(1, &vertex_array);
    glBindVertexArray(vertex_array);
    glGenBuffers(2, buffers.data());
    const auto upload_to = [](GLenum target, GLuint buffer, const auto& values) {
        glBindBuffer(target, buffer);
        glBufferData(target, static_cast<GLsizeiptr>(values.size() * sizeof values[0]), values.data(),
                     GL_STATIC_DRAW);
    };
    upload_to(GL_ARRAY_BUFFER, buffers[0], patches.vertices);
    upload_to(GL_ELEMENT_ARRAY_BUFFER, buffers[1], patches.corners);
    glEnableVertexAttribArray(0);
    glVertexAttribPointer(0, 3, GL_FLOAT, GL_FALSE, sizeof(Float3), nullptr);
}

}  // namespace

/// Objects of OpenGL live and die with the context.
OpenGlPatches::OpenGlPatches(const Patches& patches, const ShaderSources& shaders) : patches_(patches) {
    const OpenGlContext::Current current(context_);
    renderer_ = reinterpret_cast<const char*>(glGetString(GL_RENDERER));
    glGetIntegerv(GL_MAX_RENDERBUFFER_SIZE, &largest_picture_);
    glUseProgram(linked_program(shaders));
    upload(patches);
    glClipControl(GL_LOWER_LEFT, GL_ZERO_TO_ONE);
    glEnable(GL_DEPTH_TEST);
    check_opengl();
}

void OpenGlPatches::draw() const {
    glDrawElements(GL_TRIANGLES, static_cast<GLsizei>(3 * patches_.count()), GL_UNSIGNED_INT, nullptr);
}

void check_opengl() {
    const GLenum error = glGetError();
    if (error != GL_NO_ERROR) {
        throw std::runtime_error(fmt::format("OpenGL: error {:#x} in drawing patches{}", error,
                                             error == GL_OUT_OF_MEMORY ? ": out of memory" : ""));
    }
}

void set_uniform(int location, std::initializer_list<Vec3> vectors) {
    std::vector<float> coordinates;
    for (const Vec3& v : vectors) {
        for (const double coordinate : {v.x, v.y, v.z}) coordinates.push_back(static_cast<float>(coordinate));
    }
    glUniform3fv(location, static_cast<GLsizei>(vectors.size()), coordinates.data());
}

}  // namespace stilb::patches
