#include <dlfcn.h>

#include <GL/osmesa.h>

// GLEW, which loads OpenGL's functions for Debian's VTK, asks GLX for them. The program gives it
// OSMesa's under GLX's names (it must export them), so that no X library is ever called.

namespace {

using Function = void (*)();

Function osmesa_function(const unsigned char* name) {
  return reinterpret_cast<Function>(OSMesaGetProcAddress(reinterpret_cast<const char*>(name)));
}

}  // namespace

extern "C" {

Function glXGetProcAddress(const unsigned char* name) { return osmesa_function(name); }

Function glXGetProcAddressARB(const unsigned char* name) { return osmesa_function(name); }

void* glXGetCurrentDisplay() { return nullptr; }

/// GLEW ends with "no GLX display" after it has loaded every function of OpenGL: here a success.
unsigned glewInit() {
  constexpr unsigned kNoGlxDisplay = 4;
  constexpr unsigned kNoInit = 1;
  auto* real = reinterpret_cast<unsigned (*)()>(dlsym(RTLD_NEXT, "glewInit"));
  if (real == nullptr) return kNoInit;
  const unsigned result = real();
  return result == kNoGlxDisplay ? 0 : result;
}
}
