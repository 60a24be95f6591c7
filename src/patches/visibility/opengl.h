// Patches in OpenGL: the common part of all drawings.
#pragma once

#include <initializer_list>
#include <memory>
#include <string>

#include "patches/patches.h"
#include "patches/visibility/bundle.h"
#include "patches/visibility/item_buffer.h"

namespace stilb::patches {

// OpenGL without a window.

/// An OpenGL 4.5 context by EGL: of the first device that has one (a graphics card if there is one), else
/// of Mesa without a device. Functions of OpenGL work in the thread that holds a Current.
class OpenGlContext {
  public:
    /// Throws InputError, with the packages to install, where there is no EGL or none of its drivers has
    /// OpenGL 4.5.
    OpenGlContext();
    ~OpenGlContext();
    OpenGlContext(const OpenGlContext&) = delete;
    OpenGlContext& operator=(const OpenGlContext&) = delete;

    /// During its lifetime, the context is the calling thread's; one at a time.
    class Current {
      public:
        explicit Current(const OpenGlContext& context);
        ~Current();
        Current(const Current&) = delete;
        Current& operator=(const Current&) = delete;

      private:
        void* display_;
    };

  private:
    void* display_ = nullptr;  ///< EGLDisplay; EGL itself keeps it to the end of the program
    void* context_ = nullptr;  ///< EGLContext
};

/// Shaders in GLSL. The vertex shader gets each patch's corners in location 0, relative to Patches::center;
/// the fragment shader identifies the patch by gl_PrimitiveID.
struct ShaderSources {
    const char* vertex;
    const char* fragment;
};

/// A context of OpenGL with copies of the patches and one program, which are active whenever the context is
/// current. Keeps a reference to the patches.
class OpenGlPatches {
  public:
    /// Throws InputError where there is no OpenGL 4.5 (OpenGlContext), std::runtime_error where OpenGL fails.
    OpenGlPatches(const Patches& patches, const ShaderSources& shaders);

    const OpenGlContext& context() const { return context_; }
    const Patches& patches() const { return patches_; }
    /// The renderer, for reports: "llvmpipe (LLVM 15.0.6, 256 bits)".
    const std::string& renderer() const { return renderer_; }
    /// The longest edge of a picture that can be rendered, in pixels.
    int largest_picture() const { return largest_picture_; }

    /// Draws all patches in order. The context must be current.
    void draw() const;

  private:
    const Patches& patches_;
    OpenGlContext context_;
    std::string renderer_;
    int largest_picture_ = 0;
};

/// Throws std::runtime_error where OpenGL has failed since the last check, in the current context.
void check_opengl();

/// Sets a uniform of the active program: vec3 at `location`, or an array of them.
void set_uniform(int location, std::initializer_list<Vec3> vectors);

// Bundles by the graphics card.

/// Draws the patches without perspective, layer behind layer, until no patch is left; without a card
/// by Mesa's software. A pixel's middle is a line. Casts may run in parallel, but draw one after another.
/// Copies of the patches' geometry go to the driver. Distances are accurate to 2^-8 of the spacing, measured
/// across the patch.
class OpenGlBundles : public Bundles {
  public:
    /// Throws InputError where there is no OpenGL 4.5 (OpenGlContext).
    explicit OpenGlBundles(const Patches& patches);
    ~OpenGlBundles() override;

    /// Throws std::runtime_error too, where OpenGL fails (out of memory).
    void cast(const Bundle& bundle, const LineVisitor& visit) const override;

    /// The renderer, for reports: "llvmpipe (LLVM 15.0.6, 256 bits)".
    const std::string& renderer() const;

  private:
    struct Implementation;
    std::unique_ptr<Implementation> implementation_;
};

// Item buffers by the graphics card.

/// Draws the patches with their number as colour, without a window, by Mesa's software if there is no
/// card. One buffer at a time, from any thread. Copies of the patches' geometry go to the driver.
class OpenGlItemBuffers : public ItemBuffers {
  public:
    /// Throws InputError where there is no OpenGL 4.5 (OpenGlContext).
    explicit OpenGlItemBuffers(const Patches& patches);
    ~OpenGlItemBuffers() override;

    /// Throws InputError where the driver does not support pictures of that size, std::runtime_error where
    /// OpenGL fails (out of memory).
    void fill(const ItemBufferLayout& layout, const Viewpoint& viewpoint,
              std::span<std::uint32_t> sides) override;

    /// The renderer, for reports: "llvmpipe (LLVM 15.0.6, 256 bits)".
    const std::string& renderer() const;

  private:
    struct Implementation;
    std::unique_ptr<Implementation> implementation_;
};

}  // namespace stilb::patches
