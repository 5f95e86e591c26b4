#pragma once

#include <chrono>
#include <filesystem>
#include <mutex>
#include <optional>
#include <stdexcept>
#include <string>

#include "core/base/child_process.hpp"
#include "core/base/files/descriptor.hpp"
#include "render/image/image.hpp"
#include "render/scene/scene.hpp"
#include "render/scene/scene_request.hpp"

namespace mapproof {

/// A scene could not be drawn: the program that draws is missing, has no context, or ended. One
/// line.
class SceneError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// The program that draws scenes: the one that the environment variable MAPPROOF_SCENES names, else
/// `mapproof-scenes` beside the running program.
std::filesystem::path scenes_program();

/// Draws scenes by a separate program, so that no other loads VTK. The first draw() starts it; it
/// draws all images in one context and ends with this object. Safe for several threads; images are
/// drawn one at a time.
class SceneClient {
 public:
  static constexpr int kLargestSide = 8192;  ///< Pixels.
  static constexpr int kMostSamples = 16;    ///< Per pixel.

  /// @param patience  For each answer; far longer than the largest image takes.
  explicit SceneClient(std::filesystem::path program = scenes_program(),
                       std::chrono::seconds patience = std::chrono::minutes(10));
  ~SceneClient();
  SceneClient(const SceneClient&) = delete;
  SceneClient& operator=(const SceneClient&) = delete;

  /// @throws InvalidInput if a side of an image is not in 1 to kLargestSide.
  static void require_size(const Scene& scene, int width, int height);

  /// One view; the same pixels each time.
  /// @param request  Sides in 1 to kLargestSide; samples in 0 to kMostSamples, fewer where the
  /// image
  ///                 would have more than 2^27, or 16384 along a side.
  /// @throws InvalidInput if the scene is not valid (see require_valid()), has no such view, or a
  ///         number is out of its bounds; SceneError.
  Image draw(const Scene& scene, const SceneRequest& request);

  /// The names and versions of what drew the last image; empty before the first.
  std::string renderer();

 private:
  /// @throws SceneError, ProcessError.
  Image ask(const SceneRequest& request, const Scene& scene);
  void start();
  std::string read_line();
  void read_bytes(char* to, std::size_t count);
  [[noreturn]] void give_up();
  [[noreturn]] void fail(const std::string& what);
  std::string ending();

  std::filesystem::path program_;
  std::chrono::seconds patience_;
  std::mutex mutex_;
  std::optional<ChildProcess> process_;
  Descriptor socket_{-1};
  Descriptor messages_{-1};  ///< The standard error of the program, as a file in memory.
  std::string unread_;
  std::string renderer_;
};

}  // namespace mapproof
