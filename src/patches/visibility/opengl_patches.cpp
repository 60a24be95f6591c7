
#include <epoxy/egl.h>
#include <epoxy/gl.h>
#include <fmt/format.h>

#include <array>
#include <stdexcept>
#include <string>
#include <vector>

#include "patches/visibility/opengl.h"
#include "stilb/error.h"

namespace stilb::patches {

namespace {

[[noreturn]] void throw_missing(const std::string& what) {
    throw InputError(
        "OpenGL is not available for drawing patches: " + what +
        " Install a driver (in Debian: libegl1, libgl1 and libgl1-mesa-dri, which needs no graphics card), "
        "or use visibility by rays.");
}

/// Frees what EGL keeps for this thread. If it were kept until the program ends, the ending thread and EGL
/// would both free it.
struct EglOfThread {
    EglOfThread() = default;
    ~EglOfThread() { eglReleaseThread(); }
    EglOfThread(const EglOfThread&) = delete;
    EglOfThread& operator=(const EglOfThread&) = delete;
};

std::vector<EGLDisplay> displays() {
    std::vector<EGLDisplay> found;
    if (epoxy_has_egl_extension(EGL_NO_DISPLAY, "EGL_EXT_platform_device") &&
        epoxy_has_egl_extension(EGL_NO_DISPLAY, "EGL_EXT_device_enumeration")) {
        std::array<EGLDeviceEXT, 16> devices{};
        EGLint count = 0;
        eglQueryDevicesEXT(static_cast<EGLint>(devices.size()), devices.data(), &count);
        for (EGLint i = 0; i < count; ++i) {
            found.push_back(eglGetPlatformDisplayEXT(EGL_PLATFORM_DEVICE_EXT, devices[i], nullptr));
        }
    }
    if (epoxy_has_egl_extension(EGL_NO_DISPLAY, "EGL_MESA_platform_surfaceless")) {
        found.push_back(
            eglGetPlatformDisplayEXT(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, nullptr));
    }
    return found;
}

/// EGL_NO_CONTEXT where the display has no suitable context.
EGLContext context_of(EGLDisplay display) {
    if (display == EGL_NO_DISPLAY || eglInitialize(display, nullptr, nullptr) == EGL_FALSE)
        return EGL_NO_CONTEXT;
    if (!epoxy_has_egl_extension(display, "EGL_KHR_surfaceless_context") ||
        !epoxy_has_egl_extension(display, "EGL_KHR_no_config_context") ||
        eglBindAPI(EGL_OPENGL_API) == EGL_FALSE) {
        return EGL_NO_CONTEXT;
    }
    // 4.5 is the first with glClipControl.
    constexpr std::array<EGLint, 7> wanted{EGL_CONTEXT_MAJOR_VERSION,
                                           4,
                                           EGL_CONTEXT_MINOR_VERSION,
                                           5,
                                           EGL_CONTEXT_OPENGL_PROFILE_MASK,
                                           EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT,
                                           EGL_NONE};
    return eglCreateContext(display, EGL_NO_CONFIG_KHR, EGL_NO_CONTEXT, wanted.data());
}

}  // namespace

OpenGlContext::OpenGlContext() {
    if (!epoxy_has_egl()) throw_missing("the library libEGL.so.1 is missing.");
    const EglOfThread egl;
    for (const EGLDisplay display : displays()) {
        const EGLContext context = context_of(display);
        if (context == EGL_NO_CONTEXT) continue;
        display_ = display;
        context_ = context;
        return;
    }
    throw_missing("EGL is present, but no driver has OpenGL 4.5 without a window.");
}

OpenGlContext::~OpenGlContext() {
    const EglOfThread egl;
    eglDestroyContext(display_, context_);
}

OpenGlContext::Current::Current(const OpenGlContext& context) : display_(context.display_) {
    eglBindAPI(EGL_OPENGL_API);
    if (eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, context.context_) == EGL_FALSE) {
        throw std::runtime_error("EGL: the OpenGL context could not be made current; another thread uses it");
    }
}

OpenGlContext::Current::~Current() {
    const EglOfThread egl;
    eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
}

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

/// Objects of OpenGL have the lifetime of the context.
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
