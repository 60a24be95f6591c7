// OpenGL without a window.
#pragma once

namespace stilb::patches {

/// An OpenGL 4.5 context by EGL: of the first device that has one (a graphics card where there is one), else
/// of Mesa without a device. Functions of OpenGL work in the thread that holds a Current.
class OpenGlContext {
  public:
    /// Throws InputError, with what to install, where there is no EGL or none of its drivers has OpenGL 4.5.
    OpenGlContext();
    ~OpenGlContext();
    OpenGlContext(const OpenGlContext&) = delete;
    OpenGlContext& operator=(const OpenGlContext&) = delete;

    /// While it lives, the context is the calling thread's; one at a time.
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

}  // namespace stilb::patches
