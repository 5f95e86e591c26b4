#pragma once

#include <memory>
#include <string>

#include "render/image/image.hpp"
#include "render/scene/scene.hpp"
#include "render/scene/scene_request.hpp"

namespace mapproof {

/// Fixes what the pixels depend on besides the scene. The driver is llvmpipe with vectors of 128
/// bits; otherwise their width depends on the processor and decides how sums are rounded. EGL takes
/// Mesa, never a graphics card. Of the environment only the variables remain that say where caches
/// and libraries are and how many threads draw. Call it before any function of OpenGL.
void pin_driver();

/// Draws scenes by VTK in one context of llvmpipe. Not safe for several threads.
class SceneRenderer {
 public:
  /// @throws std::runtime_error, in one line, if there is no context or its driver is not llvmpipe.
  SceneRenderer();
  ~SceneRenderer();

  /// The same pixels for the same scene and request, whatever was drawn before.
  /// @throws InvalidInput if there is no such view; std::runtime_error with VTK's message if VTK
  ///         reports an error.
  Image draw(const Scene& scene, const SceneRequest& request);

  /// "VTK 9.1.0, OpenGL 4.5 (Core Profile) Mesa 22.3.6, llvmpipe (LLVM 15.0.6, 128 bits)".
  std::string name() const;

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace mapproof
