#pragma once

#include <string>
#include <vector>

#include <GL/osmesa.h>
#include <vtkGenericOpenGLRenderWindow.h>

namespace mapproof {

/// A window of VTK without a screen, for a VTK that was built for X alone: its OpenGL context is
/// OSMesa's, in memory. VTK draws into a framebuffer of its own, so that the context's buffer is
/// never read and stays small.
class OsmesaWindow : public vtkGenericOpenGLRenderWindow {
 public:
  static OsmesaWindow* New();
  vtkTypeMacro(OsmesaWindow, vtkGenericOpenGLRenderWindow)

  /// Makes the context. @return Whether there is one; problem() says why not.
  bool open();
  const std::string& problem() const { return problem_; }

  void MakeCurrent() override;
  bool IsCurrent() override;
  int SupportsOpenGL() override { return 1; }
  vtkTypeBool IsDirect() override { return 0; }
  void Initialize() override { open(); }
  void Finalize() override;

 protected:
  OsmesaWindow();
  ~OsmesaWindow() override;

 private:
  OSMesaContext context_ = nullptr;
  std::vector<unsigned char> buffer_;
  std::string problem_;
};

}  // namespace mapproof
