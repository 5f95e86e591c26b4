// Figures, scenes, images and drawings.
#include <cstdint>
#include <cstdlib>

#include "render/image/png.hpp"
#include "render/image/png_read.hpp"
#include "render/plot/figure_json.hpp"
#include "render/plot/layout.hpp"
#include "render/scene/scene_json.hpp"
#include "render/scene/scene_request.hpp"
#include "render/svg/svg.hpp"
#include "reports/diff/svg/svg_diff.hpp"
#include "reports/diff/svg/svg_parser.hpp"
#include "tests/fuzz/properties.hpp"
#include "tests/fuzz/target.hpp"

namespace mapproof::fuzz {
namespace {

const Added kFigure({.name = "figure", .run = [](auto bytes) {
                       round_trip(bytes, figure_from_json, figure_to_json);
                     }});

/// What can be read can be drawn, and the drawing be read by the strict reader of SVG.
void draw(std::string_view bytes) {
  static const Theme theme = report_theme();
  const std::string svg = to_svg(lay_out(figure_from_json(bytes, kSource), theme));
  try {
    parse_svg(svg);
  } catch (const std::exception& error) {
    found("a drawing is read", error.what());
  }
}
const Added kDrawn({.name = "figure-drawn", .run = draw, .memory = std::size_t{128} << 20});

const Added kScene({.name = "scene",
                    .run = [](auto bytes) { round_trip(bytes, scene_from_json, scene_to_json); }});
const Added kSceneRequest({.name = "scene-request", .run = [](auto bytes) {
                             round_trip(bytes, request_from_line, request_to_line);
                           }});
const Added kSceneReply({.name = "scene-reply", .run = [](auto bytes) {
                           round_trip(bytes, reply_from_line, reply_to_line);
                         }});

/// What is read is written as a file of the same pixels.
void read_image(std::string_view bytes) {
  read_png_remarks(bytes);
  const PngFile file = read_png(bytes);
  if (file.image.pixels.size() > 10'000) return;
  const PngFile again = read_png(encode_png(file.image));
  if (again.image.width != file.image.width ||
      again.image.pixels.size() != file.image.pixels.size())
    found("an image keeps its size", "");
  for (std::size_t i = 0; i < file.image.pixels.size(); ++i) {
    const std::uint32_t was = file.image.pixels[i], is = again.image.pixels[i];
    for (const int shift : {0, 8, 16}) {
      const int moved = static_cast<int>(was >> shift & 255) - static_cast<int>(is >> shift & 255);
      if (std::abs(moved) > kMostColourShift) found("an image keeps its colours", "");
    }
  }
}
// Rows unpack to a thousand times their bytes.
const Added kPng(
    {.name = "png", .run = read_image, .memory = std::size_t{64} << 20, .memory_per_byte = 16'384});

/// A file, or two of them with a line "===" between.
void read_drawing(std::string_view bytes) {
  constexpr std::string_view kBetween = "\n===\n";
  const std::size_t at = bytes.find(kBetween);
  const SvgTree first = parse_svg(bytes.substr(0, at));
  const SvgDiff same = svg_diff(first, first);
  if (same.total != 0) found("a drawing equals itself", same.changes.front().element);
  if (at == std::string_view::npos) return;
  const SvgTree second = parse_svg(bytes.substr(at + kBetween.size()));
  const SvgDiff there = svg_diff(first, second), back = svg_diff(second, first);
  if ((there.total == 0) != (back.total == 0))
    found("two drawings differ in both directions", std::to_string(there.total));
}
const Added kSvg({.name = "svg", .run = read_drawing});

}  // namespace
}  // namespace mapproof::fuzz
