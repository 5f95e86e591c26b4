#include "render/vtk/offscreen_window.hpp"

#include <memory>
#include <stdexcept>
#include <string>
#include <utility>

#include <vtkVersionMacros.h>
#if VTK_VERSION_NUMBER < VTK_VERSION_CHECK(9, 4, 0)
#include <vtk_glew.h>
#endif
#include <vtkGenericOpenGLRenderWindow.h>
#include <vtkObjectFactory.h>

#include "render/vtk/gl_context.hpp"

namespace mapproof {
namespace {

/// A window that owns an OpenGL context, in which VTK draws into a framebuffer of its own.
class OffscreenWindow : public vtkGenericOpenGLRenderWindow {
 public:
  static OffscreenWindow* New();
  vtkTypeMacro(OffscreenWindow, vtkGenericOpenGLRenderWindow)

      /// Makes the context.
      void Initialize() override;
  void Finalize() override;
  void MakeCurrent() override;
  bool IsCurrent() override;
#ifdef GLEW_OK
  void OpenGLInitContext() override;
#endif
  int SupportsOpenGL() override { return 1; }
  vtkTypeBool IsDirect() override { return 0; }

 protected:
  OffscreenWindow();
  ~OffscreenWindow() override;

 private:
  std::unique_ptr<GlContext> context_;
};

vtkStandardNewMacro(OffscreenWindow);

OffscreenWindow::OffscreenWindow() {
  SetShowWindow(false);
  SetUseOffScreenBuffers(true);
  SetFrameBlitModeToNoBlit();
  SetOwnContext(1);
  SetReadyForRendering(true);
#ifndef GLEW_OK
  SetOpenGLSymbolLoader([](void*, const char* name) { return GlContext::function(name); }, nullptr);
#endif
}

OffscreenWindow::~OffscreenWindow() { Finalize(); }

void OffscreenWindow::Initialize() {
  if (context_ != nullptr) return;
  auto context = std::make_unique<GlContext>();
  if (!context->make_current()) throw std::runtime_error("the context cannot be made current");
  context_ = std::move(context);
  OpenGLInit();
}

void OffscreenWindow::Finalize() {
  if (context_ == nullptr) return;
  MakeCurrent();
  Superclass::Finalize();
  context_.reset();
}

void OffscreenWindow::MakeCurrent() {
  if (context_ != nullptr && !context_->is_current()) context_->make_current();
}

bool OffscreenWindow::IsCurrent() { return context_ != nullptr && context_->is_current(); }

#ifdef GLEW_OK
/// As the base class does it, but a missing GLX display is not an error: GLEW looks for one only
/// after it has loaded every function of OpenGL.
void OffscreenWindow::OpenGLInitContext() {
  ContextCreationTime.Modified();
  if (Initialized) return;
  const GLenum result = glewInit();
  GlewInitValid = result == GLEW_OK || result == GLEW_ERROR_NO_GLX_DISPLAY;
  if (!GlewInitValid)
    throw std::runtime_error(std::string("GLEW: ") +
                             reinterpret_cast<const char*>(glewGetErrorString(result)));
  Initialized = true;
}
#endif

}  // namespace

vtkSmartPointer<vtkRenderWindow> make_window() {
  auto window = vtkSmartPointer<OffscreenWindow>::New();
  window->Initialize();
  return window;
}

}  // namespace mapproof
