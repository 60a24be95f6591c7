#include "patches/visibility/opengl_context.h"

#include <epoxy/egl.h>
#include <epoxy/gl.h>

#include <array>
#include <stdexcept>
#include <string>
#include <vector>

#include "base/error.h"

namespace stilb::patches {
namespace {

[[noreturn]] void throw_missing(const std::string& what) {
    throw InputError(
        "there is no OpenGL here to draw patches with: " + what +
        " Install a driver (in Debian: libegl1, libgl1 and libgl1-mesa-dri, which needs no graphics card), "
        "or take rays instead.");
}

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

/// EGL_NO_CONTEXT where the display has none that would do.
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
    for (const EGLDisplay display : displays()) {
        const EGLContext context = context_of(display);
        if (context == EGL_NO_CONTEXT) continue;
        display_ = display;
        context_ = context;
        return;
    }
    throw_missing("no driver has OpenGL 4.5 without a window (EGL is there).");
}

OpenGlContext::~OpenGlContext() { eglDestroyContext(display_, context_); }

OpenGlContext::Current::Current(const OpenGlContext& context) : display_(context.display_) {
    eglBindAPI(EGL_OPENGL_API);
    if (eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, context.context_) == EGL_FALSE) {
        throw std::runtime_error("EGL: the OpenGL context could not be made current; another thread uses it");
    }
}

OpenGlContext::Current::~Current() {
    eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
}

}  // namespace stilb::patches
