// Depth. What is written is near / z, z being the distance along the face's axis, in single precision and
// with nearer being larger: a relative precision of 2^-24 at every distance, whatever the near plane is
// [Upchurch, Desbrun 2012, Tightening the precision of perspective rendering]. So the near plane can lie
// closer than anything is seen from: a viewpoint on a surface is lifted by 2^-19 of the scene's size
// (viewpoint.h), the near plane is at 2^-23.
//
// Agreement with rays. Both see a pixel's middle from the same place, rounded alike, through vertices rounded
// alike. OpenGL rounds them once more on the screen, usually to 1/256 of a pixel: the middle of a pixel that
// is nearer than that to an edge may fall to the other side of it.
#include "patches/opengl_item_buffers.h"

#include <epoxy/gl.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>
#include <string>

#include "base/error.h"
#include "patches/opengl_context.h"

namespace stilb {
namespace {

/// `axes` are the face's right, up and forward; the window maps the picture's plane to [-1, 1]^2.
constexpr const char* kVertexShader = R"(#version 450 core
layout(location = 0) in vec3 place;
layout(location = 0) uniform vec3 eye;
layout(location = 1) uniform vec3 axes[3];
layout(location = 4) uniform vec2 scale;
layout(location = 5) uniform vec2 shift;
layout(location = 6) uniform float near_plane;
void main() {
    vec3 way = place - eye;
    vec3 seen = vec3(dot(axes[0], way), dot(axes[1], way), dot(axes[2], way));
    gl_Position = vec4(scale * seen.xy + shift * seen.z, near_plane, seen.z);
}
)";

constexpr const char* kFragmentShader = R"(#version 450 core
layout(location = 7) uniform uint count;
layout(location = 0) out uint side;
void main() { side = uint(gl_PrimitiveID) + (gl_FrontFacing ? 0u : count); }
)";

constexpr GLint kEye = 0, kAxes = 1, kScale = 4, kShift = 5, kNearPlane = 6, kCount = 7;

using Floats = std::array<float, 3>;
Floats in_floats(const Vec3& v) {
    return {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)};
}

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

GLuint linked_program() {
    const GLuint program = glCreateProgram();
    for (const GLuint shader :
         {compiled(GL_VERTEX_SHADER, kVertexShader), compiled(GL_FRAGMENT_SHADER, kFragmentShader)}) {
        glAttachShader(program, shader);
        glDeleteShader(shader);  // lives as long as the program
    }
    glLinkProgram(program);
    GLint ok = GL_FALSE;
    glGetProgramiv(program, GL_LINK_STATUS, &ok);
    if (ok != GL_TRUE) throw std::runtime_error("OpenGL cannot link its shaders");
    return program;
}

void check_errors() {
    const GLenum error = glGetError();
    if (error != GL_NO_ERROR) {
        throw std::runtime_error(fmt::format("OpenGL: error {:#x} in drawing item buffers{}", error,
                                             error == GL_OUT_OF_MEMORY ? ": out of memory" : ""));
    }
}

double half_extent_m(const Patches& patches) {
    float largest = 0;
    for (const Float3& v : patches.vertices) {
        largest = std::max({largest, std::abs(v.x), std::abs(v.y), std::abs(v.z)});
    }
    return largest;
}

}  // namespace

/// Objects of OpenGL live and die with the context.
struct OpenGlItemBuffers::Implementation {
    const Patches& patches;
    OpenGlContext context;
    float near_plane_m;
    std::string renderer;
    GLint largest_picture = 0;
    GLuint frame_buffer = 0, colour = 0, depth = 0;
    int picture_size = 0;  ///< of both, square

    explicit Implementation(const Patches& all)
        : patches(all), near_plane_m(static_cast<float>(0x1p-23 * half_extent_m(all))) {
        const OpenGlContext::Current current(context);
        renderer = reinterpret_cast<const char*>(glGetString(GL_RENDERER));
        glGetIntegerv(GL_MAX_RENDERBUFFER_SIZE, &largest_picture);
        glUseProgram(linked_program());
        glUniform1f(kNearPlane, near_plane_m);
        glUniform1ui(kCount, static_cast<GLuint>(patches.count()));
        upload_patches();
        glGenFramebuffers(1, &frame_buffer);
        glBindFramebuffer(GL_FRAMEBUFFER, frame_buffer);
        glClipControl(GL_LOWER_LEFT, GL_ZERO_TO_ONE);
        glEnable(GL_DEPTH_TEST);
        glDepthFunc(GL_GREATER);
        glClearDepth(0);
        check_errors();
    }

    void upload_patches() const {
        GLuint vertex_array = 0;
        std::array<GLuint, 2> buffers{};
        glGenVertexArrays(1, &vertex_array);
        glBindVertexArray(vertex_array);
        glGenBuffers(2, buffers.data());
        const auto upload = [](GLenum target, GLuint buffer, const auto& values) {
            glBindBuffer(target, buffer);
            glBufferData(target, static_cast<GLsizeiptr>(values.size() * sizeof values[0]), values.data(),
                         GL_STATIC_DRAW);
        };
        upload(GL_ARRAY_BUFFER, buffers[0], patches.vertices);
        upload(GL_ELEMENT_ARRAY_BUFFER, buffers[1], patches.corners);
        glEnableVertexAttribArray(0);
        glVertexAttribPointer(0, 3, GL_FLOAT, GL_FALSE, sizeof(Float3), nullptr);
    }

    void resize_pictures(int size) {
        if (size == picture_size) return;
        if (size > largest_picture) {
            throw InputError(
                fmt::format("item buffers of {} pixels are more than the {} that {} can draw. Take "
                            "that many or fewer, or have them filled by rays.",
                            size, largest_picture, renderer));
        }
        const auto replace = [&](GLuint& picture, GLenum attachment, GLenum format) {
            glDeleteRenderbuffers(1, &picture);
            glGenRenderbuffers(1, &picture);
            glBindRenderbuffer(GL_RENDERBUFFER, picture);
            glRenderbufferStorage(GL_RENDERBUFFER, format, size, size);
            glFramebufferRenderbuffer(GL_FRAMEBUFFER, attachment, GL_RENDERBUFFER, picture);
        };
        replace(colour, GL_COLOR_ATTACHMENT0, GL_R32UI);
        replace(depth, GL_DEPTH_ATTACHMENT, GL_DEPTH_COMPONENT32F);
        check_errors();
        picture_size = size;
    }

    void draw(const BufferFace& face, double pixel_size, const Viewpoint& viewpoint) const {
        const Floats eye = in_floats(viewpoint.position - patches.center);
        const std::array<Floats, 3> axes{in_floats(viewpoint.frame.to_world(face.right)),
                                         in_floats(viewpoint.frame.to_world(face.up)),
                                         in_floats(viewpoint.frame.to_world(face.forward))};
        const double width = face.width * pixel_size, height = face.height * pixel_size;
        glUniform3fv(kEye, 1, eye.data());
        glUniform3fv(kAxes, 3, axes[0].data());
        glUniform2f(kScale, static_cast<float>(2 / width), static_cast<float>(2 / height));
        glUniform2f(kShift, static_cast<float>(-2 * face.left / width - 1),
                    static_cast<float>(-2 * face.bottom / height - 1));
        glViewport(0, 0, face.width, face.height);
        constexpr std::array<GLuint, 4> nothing{kNoSide, kNoSide, kNoSide, kNoSide};
        glClearBufferuiv(GL_COLOR, 0, nothing.data());
        glClear(GL_DEPTH_BUFFER_BIT);
        glDrawElements(GL_TRIANGLES, static_cast<GLsizei>(3 * patches.count()), GL_UNSIGNED_INT, nullptr);
    }
};

OpenGlItemBuffers::OpenGlItemBuffers(const Patches& patches)
    : implementation_(std::make_unique<Implementation>(patches)) {}
OpenGlItemBuffers::~OpenGlItemBuffers() = default;

const std::string& OpenGlItemBuffers::renderer() const { return implementation_->renderer; }

void OpenGlItemBuffers::fill(const ItemBufferLayout& layout, const Viewpoint& viewpoint,
                             std::span<std::uint32_t> sides) {
    const OpenGlContext::Current current(implementation_->context);
    implementation_->resize_pictures(layout.resolution());
    for (const BufferFace& face : layout.faces()) {
        implementation_->draw(face, layout.pixel_size(), viewpoint);
        glReadPixels(0, 0, face.width, face.height, GL_RED_INTEGER, GL_UNSIGNED_INT,
                     sides.data() + face.first_pixel);
        for (int y = 0; y < face.height; ++y) {
            std::fill_n(sides.begin() + face.pixel_at(0, y), layout.first_column(face, y), kNoSide);
        }
    }
    check_errors();
}

}  // namespace stilb
