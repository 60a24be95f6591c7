// Depth. The depth value is near / z, z being the distance along the face's axis, in single precision and
// with nearer being larger: a relative precision of 2^-24 at every distance, whatever the near plane is
// [Upchurch, Desbrun 2012, Tightening the precision of perspective rendering]. So the near plane can lie
// closer than any viewpoint is to a surface: a viewpoint on a surface is lifted by 2^-19 of the scene's size
// (item_buffer.h), the near plane is at 2^-23.
//
// Agreement with rays. Both see a pixel's middle from the same viewpoint, with the same rounding of viewpoint
// and vertices. OpenGL rounds vertices once more on the screen, usually to 1/256 of a pixel: the middle of a
// pixel that is nearer than that to an edge may fall to the other side of it.
#include <epoxy/gl.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string>

#include "patches/visibility/opengl.h"
#include "stilb/error.h"

namespace stilb::patches {
namespace {

/// `axes` are the face's right, up and forward; the window maps the picture's plane to [-1, 1]^2.
constexpr const char* kVertexShader = R"(#version 450 core
layout(location = 0) in vec3 position;
layout(location = 0) uniform vec3 viewpoint;
layout(location = 1) uniform vec3 axes[3];
layout(location = 4) uniform vec2 scale;
layout(location = 5) uniform vec2 shift;
layout(location = 6) uniform float near_plane;
void main() {
    vec3 offset = position - viewpoint;
    vec3 seen = vec3(dot(axes[0], offset), dot(axes[1], offset), dot(axes[2], offset));
    gl_Position = vec4(scale * seen.xy + shift * seen.z, near_plane, seen.z);
}
)";

constexpr const char* kFragmentShader = R"(#version 450 core
layout(location = 7) uniform uint count;
layout(location = 0) out uint side;
void main() { side = uint(gl_PrimitiveID) + (gl_FrontFacing ? 0u : count); }
)";

constexpr GLint kViewpoint = 0, kAxes = 1, kScale = 4, kShift = 5, kNearPlane = 6, kCount = 7;

}  // namespace

struct OpenGlItemBuffers::Implementation {
    OpenGlPatches drawing;
    GLuint frame_buffer = 0, colour = 0, depth = 0;
    int picture_size = 0;  ///< of both, square

    explicit Implementation(const Patches& patches) : drawing(patches, {kVertexShader, kFragmentShader}) {
        const OpenGlContext::Current current(drawing.context());
        glUniform1f(kNearPlane, static_cast<float>(0x1p-23 * bounds_of(patches).half_extent()));
        glUniform1ui(kCount, static_cast<GLuint>(patches.count()));
        glGenFramebuffers(1, &frame_buffer);
        glBindFramebuffer(GL_FRAMEBUFFER, frame_buffer);
        glDepthFunc(GL_GREATER);
        glClearDepth(0);
        check_opengl();
    }

    void resize_pictures(int size) {
        if (size == picture_size) return;
        if (size > drawing.largest_picture()) {
            throw InputError(
                fmt::format("item buffers of {} pixels exceed the limit of {} pixels of {}. Use "
                            "a lower resolution, or visibility by rays.",
                            size, drawing.largest_picture(), drawing.renderer()));
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
        check_opengl();
        picture_size = size;
    }

    void draw(const BufferFace& face, double pixel_size, const Viewpoint& viewpoint) const {
        const auto world = [&](const Vec3& axis) { return viewpoint.frame.to_world(axis); };
        set_uniform(kViewpoint, {viewpoint.position - drawing.patches().center});
        set_uniform(kAxes, {world(face.right), world(face.up), world(face.forward)});
        const double width = face.width * pixel_size, height = face.height * pixel_size;
        glUniform2f(kScale, static_cast<float>(2 / width), static_cast<float>(2 / height));
        glUniform2f(kShift, static_cast<float>(-2 * face.left / width - 1),
                    static_cast<float>(-2 * face.bottom / height - 1));
        glViewport(0, 0, face.width, face.height);
        constexpr std::array<GLuint, 4> nothing{kNoSide, kNoSide, kNoSide, kNoSide};
        glClearBufferuiv(GL_COLOR, 0, nothing.data());
        glClear(GL_DEPTH_BUFFER_BIT);
        drawing.draw();
    }
};

OpenGlItemBuffers::OpenGlItemBuffers(const Patches& patches)
    : implementation_(std::make_unique<Implementation>(patches)) {}
OpenGlItemBuffers::~OpenGlItemBuffers() = default;

const std::string& OpenGlItemBuffers::renderer() const { return implementation_->drawing.renderer(); }

void OpenGlItemBuffers::fill(const ItemBufferLayout& layout, const Viewpoint& viewpoint,
                             std::span<std::uint32_t> sides) {
    const OpenGlContext::Current current(implementation_->drawing.context());
    implementation_->resize_pictures(layout.resolution());
    for (const BufferFace& face : layout.faces()) {
        implementation_->draw(face, layout.pixel_size(), viewpoint);
        glReadPixels(0, 0, face.width, face.height, GL_RED_INTEGER, GL_UNSIGNED_INT,
                     sides.data() + face.first_pixel);
        for (int y = 0; y < face.height; ++y) {
            std::fill_n(sides.begin() + face.pixel_at(0, y), layout.first_column(face, y), kNoSide);
        }
    }
    check_opengl();
}

}  // namespace stilb::patches
