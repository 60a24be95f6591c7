// Patches in OpenGL: what all drawings of them share.
#pragma once

#include <initializer_list>
#include <string>

#include "patches/patches.h"
#include "patches/visibility/opengl_context.h"

namespace stilb::patches {

/// Shaders in GLSL. The vertex shader gets each patch's corners in location 0, relative to Patches::center;
/// the fragment shader knows the patch by gl_PrimitiveID.
struct ShaderSources {
    const char* vertex;
    const char* fragment;
};

/// A context of OpenGL with copies of the patches and one program, which are in use wherever the context is
/// current. Keeps a reference to the patches.
class OpenGlPatches {
  public:
    /// Throws InputError where there is no OpenGL 4.5 (OpenGlContext), std::runtime_error where OpenGL fails.
    OpenGlPatches(const Patches& patches, const ShaderSources& shaders);

    const OpenGlContext& context() const { return context_; }
    const Patches& patches() const { return patches_; }
    /// Who draws, for reports: "llvmpipe (LLVM 15.0.6, 256 bits)".
    const std::string& renderer() const { return renderer_; }
    /// The longest edge of a picture that can be drawn to, in pixels.
    int largest_picture() const { return largest_picture_; }

    /// Draws all, in the order of their numbers. The context must be current.
    void draw() const;

  private:
    const Patches& patches_;
    OpenGlContext context_;
    std::string renderer_;
    int largest_picture_ = 0;
};

/// Throws std::runtime_error where OpenGL has failed since it was asked last, in the current context.
void check_opengl();

/// Of the program in use: vec3 at `location`, or an array of them.
void set_uniform(int location, std::initializer_list<Vec3> vectors);

}  // namespace stilb::patches
