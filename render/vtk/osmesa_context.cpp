#include <array>
#include <stdexcept>
#include <string_view>

#include <GL/osmesa.h>

#include "render/vtk/gl_context.hpp"

namespace mapproof {
namespace {

// VTK draws into a framebuffer of its own; that of the context is never read.
constexpr int kBufferSide = 16;
constexpr int kBytesAPixel = 4;

}  // namespace

struct GlContext::Parts {
  OSMesaContext context = nullptr;
  std::array<unsigned char, kBufferSide * kBufferSide * kBytesAPixel> buffer{};
};

GlContext::GlContext() : parts_(std::make_unique<Parts>()) {
  // The version and profile that VTK's module RenderingOpenGL2 needs.
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
  parts_->context = OSMesaCreateContextAttribs(wanted.data(), nullptr);
  if (parts_->context == nullptr) throw std::runtime_error("OSMesa makes no context of OpenGL 3.2");
}

GlContext::~GlContext() { OSMesaDestroyContext(parts_->context); }

bool GlContext::make_current() {
  return OSMesaMakeCurrent(parts_->context, parts_->buffer.data(), GL_UNSIGNED_BYTE, kBufferSide,
                           kBufferSide) == GL_TRUE;
}

bool GlContext::is_current() const { return OSMesaGetCurrentContext() == parts_->context; }

GlContext::Function GlContext::function(const char* name) { return OSMesaGetProcAddress(name); }

}  // namespace mapproof

// VTK before 9.4 loads the functions of OpenGL by GLEW, which asks GLX for them. The program
// exports two functions under names of GLX that give those of OSMesa, so that no X library is
// called.
extern "C" {

void* glXGetCurrentDisplay() { return nullptr; }

mapproof::GlContext::Function glXGetProcAddressARB(const unsigned char* name) {
  using mapproof::GlContext;
  const std::string_view wanted(reinterpret_cast<const char*>(name));
  if (wanted == "glXGetCurrentDisplay")
    return reinterpret_cast<GlContext::Function>(&glXGetCurrentDisplay);
  return wanted.starts_with("glX") ? nullptr : GlContext::function(wanted.data());
}
}
