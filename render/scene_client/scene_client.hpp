#pragma once

#include <sys/types.h>

#include <filesystem>
#include <mutex>
#include <stdexcept>
#include <string>

#include "core/base/descriptor.hpp"
#include "render/image/image.hpp"
#include "render/scene/scene.hpp"
#include "render/theme/theme.hpp"

namespace mapproof {

/// No pixels came: the program that draws is missing, has no context, or ended. One line.
class SceneError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// The program that draws scenes: what the environment's MAPPROOF_SCENES names, else
/// `mapproof-scenes` beside the running program.
std::filesystem::path scenes_program();

/// Draws scenes by a program of its own, so that no other has to load VTK. It is started when the
/// first picture is asked for, draws all of them in one context, and ends with this object. Safe
/// from any thread; pictures are drawn one at a time.
class SceneClient {
 public:
  static constexpr int kLargestSide = 8192;
  static constexpr int kMostSamples = 16;

  explicit SceneClient(std::filesystem::path program = scenes_program());
  ~SceneClient();
  SceneClient(const SceneClient&) = delete;
  SceneClient& operator=(const SceneClient&) = delete;

  /// One view in the theme's colours; the same pixels each time.
  /// @param samples  A pixel, up to 16, taken up to the next square; 0: no antialiasing. Fewer
  ///                 where the whole would have more than 2^27.
  /// @throws InvalidInput if the scene cannot be drawn (see `problem`), a side is not in
  ///         1 to kLargestSide or `samples` not in 0 to kMostSamples; SceneError.
  Image draw(const Scene& scene, std::size_t view, int width, int height, int samples,
             const Theme& theme);

  /// What drew, with versions; empty before the first picture.
  std::string renderer();

 private:
  void start();
  std::string read_line();
  void read_bytes(char* to, std::size_t count);
  [[noreturn]] void give_up();
  [[noreturn]] void fail(const std::string& what);
  std::string ending();

  std::filesystem::path program_;
  std::mutex mutex_;
  pid_t process_ = -1;
  Descriptor socket_{-1};
  Descriptor messages_{-1};  ///< What the program says on its standard error.
  std::string unread_;
  std::string renderer_;
};

}  // namespace mapproof
