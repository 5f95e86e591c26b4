#pragma once

#include <memory>
#include <string>

#include "render/image/image.hpp"
#include "render/scene/scene.hpp"
#include "render/scene/scene_request.hpp"

namespace mapproof {

/// Fixes what the driver's pixels hang on, other than the scene: llvmpipe, with vectors of 128 bits
/// (their width decides how sums are rounded, and follows the processor otherwise), and nothing
/// of the environment but where caches and libraries are and how many threads draw. To be called
/// before anything of OpenGL.
void pin_driver();

/// Draws scenes by VTK in one context of llvmpipe. For one thread.
class SceneRenderer {
 public:
  /// @throws std::runtime_error, in one line, if there is no context, or not of llvmpipe.
  SceneRenderer();
  ~SceneRenderer();

  /// The same pixels for the same scene and request, whatever was drawn before.
  /// @throws InvalidInput if there is no such view; std::runtime_error with VTK's words if it
  ///         reports an error.
  Image draw(const Scene& scene, const SceneRequest& request);

  /// "VTK 9.1.0, OpenGL 4.5 (Core Profile) Mesa 22.3.6, llvmpipe (LLVM 15.0.6, 128 bits)".
  std::string name() const;

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace mapproof
