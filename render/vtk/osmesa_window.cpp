#include "render/vtk/osmesa_window.hpp"

#include <array>

#include <vtkObjectFactory.h>

namespace mapproof {
namespace {

constexpr int kBufferSide = 16;
constexpr int kBytesAPixel = 4;

}  // namespace

vtkStandardNewMacro(OsmesaWindow);

OsmesaWindow::OsmesaWindow() {
  SetShowWindow(false);
  SetUseOffScreenBuffers(true);
  SetFrameBlitModeToNoBlit();
  SetOwnContext(1);
  SetReadyForRendering(true);
}

OsmesaWindow::~OsmesaWindow() { Finalize(); }

bool OsmesaWindow::open() {
  if (context_ != nullptr) return true;
  // What VTK's OpenGL 2 back end asks for.
  const std::array<int, 13> wanted = {OSMESA_FORMAT,
                                      OSMESA_RGBA,
                                      OSMESA_DEPTH_BITS,
                                      24,
                                      OSMESA_STENCIL_BITS,
                                      8,
                                      OSMESA_PROFILE,
                                      OSMESA_CORE_PROFILE,
                                      OSMESA_CONTEXT_MAJOR_VERSION,
                                      3,
                                      OSMESA_CONTEXT_MINOR_VERSION,
                                      2,
                                      0};
  context_ = OSMesaCreateContextAttribs(wanted.data(), nullptr);
  if (context_ == nullptr) {
    problem_ = "OSMesa makes no context of OpenGL 3.2";
    return false;
  }
  buffer_.resize(kBufferSide * kBufferSide * kBytesAPixel);
  MakeCurrent();
  if (problem_.empty()) OpenGLInit();
  return problem_.empty();
}

void OsmesaWindow::MakeCurrent() {
  if (context_ == nullptr || IsCurrent()) return;
  if (!OSMesaMakeCurrent(context_, buffer_.data(), GL_UNSIGNED_BYTE, kBufferSide, kBufferSide))
    problem_ = "OSMesa's context cannot be made current";
}

bool OsmesaWindow::IsCurrent() {
  return context_ != nullptr && OSMesaGetCurrentContext() == context_;
}

void OsmesaWindow::Finalize() {
  if (context_ == nullptr) return;
  MakeCurrent();
  Superclass::Finalize();
  OSMesaDestroyContext(context_);
  context_ = nullptr;
}

}  // namespace mapproof
