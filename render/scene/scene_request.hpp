#pragma once

#include <array>
#include <string>
#include <string_view>

#include "render/theme/theme.hpp"

namespace mapproof {

/// How a view of a scene becomes pixels: the line that goes before the scene's own to the
/// program that draws.
struct SceneRequest {
  std::size_t view = 0;
  int width = 0;    ///< 1 to 8192.
  int height = 0;   ///< 1 to 8192.
  int samples = 0;  ///< A pixel, up to 16, next square of it; 0: no antialiasing.
  Colour background = {};
  /// In the order of ThemeColour, whose last one is kSeries10.
  std::array<Colour, static_cast<std::size_t>(ThemeColour::kSeries10) + 1> colours = {};

  bool operator==(const SceneRequest&) const = default;
};

/// In a theme's colours.
SceneRequest scene_request(std::size_t view, int width, int height, int samples,
                           const Theme& theme);

/// On one line, with a line feed at its end.
std::string request_to_line(const SceneRequest& request);

/// @throws IoError with `path` and the JSON pointer of what is wrong.
SceneRequest request_from_line(std::string_view text, const std::string& path);

/// What comes back: this line, then width x height pixels of four bytes as Image has them.
struct SceneReply {
  std::string error = {};  ///< Empty: pixels follow.
  int width = 0;
  int height = 0;
  std::string renderer = {};  ///< What drew, with versions.

  bool operator==(const SceneReply&) const = default;
};

std::string reply_to_line(const SceneReply& reply);

/// @throws IoError as request_from_line.
SceneReply reply_from_line(std::string_view text, const std::string& path);

}  // namespace mapproof
