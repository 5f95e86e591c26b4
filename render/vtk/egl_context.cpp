#include <array>
#include <stdexcept>

#include <EGL/egl.h>
#include <EGL/eglext.h>

#include "render/vtk/gl_context.hpp"

namespace mapproof {

struct GlContext::Parts {
  EGLDisplay display = EGL_NO_DISPLAY;
  EGLContext context = EGL_NO_CONTEXT;

  ~Parts() {
    if (context != EGL_NO_CONTEXT) eglDestroyContext(display, context);
    if (display != EGL_NO_DISPLAY) eglTerminate(display);
  }
};

GlContext::GlContext() : parts_(std::make_unique<Parts>()) {
  parts_->display =
      eglGetPlatformDisplay(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, nullptr);
  if (!eglInitialize(parts_->display, nullptr, nullptr) || !eglBindAPI(EGL_OPENGL_API))
    throw std::runtime_error("EGL has no display of Mesa's without a surface");
  // The version and profile that VTK's module RenderingOpenGL2 needs.
  const std::array<EGLint, 7> wanted = {EGL_CONTEXT_MAJOR_VERSION,
                                        3,
                                        EGL_CONTEXT_MINOR_VERSION,
                                        2,
                                        EGL_CONTEXT_OPENGL_PROFILE_MASK,
                                        EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT,
                                        EGL_NONE};
  parts_->context =
      eglCreateContext(parts_->display, EGL_NO_CONFIG_KHR, EGL_NO_CONTEXT, wanted.data());
  if (parts_->context == EGL_NO_CONTEXT)
    throw std::runtime_error("EGL makes no context of OpenGL 3.2");
}

GlContext::~GlContext() {
  if (is_current()) eglMakeCurrent(parts_->display, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
}

bool GlContext::make_current() {
  return eglMakeCurrent(parts_->display, EGL_NO_SURFACE, EGL_NO_SURFACE, parts_->context) ==
         EGL_TRUE;
}

bool GlContext::is_current() const { return eglGetCurrentContext() == parts_->context; }

GlContext::Function GlContext::function(const char* name) { return eglGetProcAddress(name); }

}  // namespace mapproof
