#include "render/vtk/vtk_window.hpp"

#include <stdexcept>

#if MAPPROOF_VTK_HAS_OSMESA
#include <vtkOSOpenGLRenderWindow.h>
#else
#include "render/vtk/osmesa_window.hpp"
#endif

namespace mapproof {

vtkSmartPointer<vtkRenderWindow> make_window() {
#if MAPPROOF_VTK_HAS_OSMESA
  auto window = vtkSmartPointer<vtkOSOpenGLRenderWindow>::New();
  window->SetShowWindow(false);
  window->SetUseOffScreenBuffers(true);
  window->Initialize();
  if (!window->SupportsOpenGL()) throw std::runtime_error("VTK's window has no context of OSMesa");
#else
  auto window = vtkSmartPointer<OsmesaWindow>::New();
  if (!window->open()) throw std::runtime_error(window->problem());
#endif
  return window;
}

}  // namespace mapproof
