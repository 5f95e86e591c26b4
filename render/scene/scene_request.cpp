#include "render/scene/scene_request.hpp"

#include <charconv>

#include <nlohmann/json.hpp>

#include "core/json/json_cursor.hpp"
#include "core/json/json_document.hpp"
#include "core/json/json_text.hpp"
#include "core/json/text_input.hpp"

namespace mapproof {
namespace {

constexpr int kLargestSide = 8192;
constexpr int kMostSamples = 16;

/// "#rrggbb".
Colour read_colour(const JsonCursor& json) {
  const std::string given = json.text();
  std::uint32_t rgb = 0;
  const char* end = given.data() + given.size();
  if (given.size() != 7 || given[0] != '#' ||
      std::from_chars(given.data() + 1, end, rgb, 16).ptr != end)
    json.fail(in_quotes(given) + " is not a colour #rrggbb");
  return colour(rgb);
}

}  // namespace

SceneRequest scene_request(std::size_t view, int width, int height, int samples,
                           const Theme& theme) {
  SceneRequest request{view, width, height, samples, theme.background, {}};
  for (std::size_t i = 0; i < request.colours.size(); ++i)
    request.colours[i] = theme.of(static_cast<ThemeColour>(i));
  return request;
}

std::string request_to_line(const SceneRequest& request) {
  nlohmann::ordered_json colours = nlohmann::ordered_json::array();
  for (const Colour colour : request.colours) colours.push_back(hex(colour));
  return json_line({{"schema", schema_value("mapproof.scene-request")},
                    {"view", request.view},
                    {"width", request.width},
                    {"height", request.height},
                    {"samples", request.samples},
                    {"background", hex(request.background)},
                    {"colours", std::move(colours)}});
}

SceneRequest request_from_line(std::string_view text, const std::string& path) {
  const JsonDocument document = parse_json(text, path);
  const JsonCursor json = document.cursor();
  expect_schema(json, "mapproof.scene-request");
  SceneRequest request;
  request.view = static_cast<std::size_t>(json.at("view").integer(0, 1'000'000));
  request.width = json.at("width").integer32(1, kLargestSide);
  request.height = json.at("height").integer32(1, kLargestSide);
  request.samples = json.at("samples").integer32(0, kMostSamples);
  request.background = read_colour(json.at("background"));
  std::size_t i = 0;
  constexpr std::size_t kColours = std::tuple_size_v<decltype(request.colours)>;
  for (const JsonCursor& colour : json.at("colours").elements(kColours, kColours))
    request.colours[i++] = read_colour(colour);
  return request;
}

std::string reply_to_line(const SceneReply& reply) {
  return json_line({{"schema", schema_value("mapproof.scene-reply")},
                    {"error", reply.error},
                    {"width", reply.width},
                    {"height", reply.height},
                    {"renderer", reply.renderer}});
}

SceneReply reply_from_line(std::string_view text, const std::string& path) {
  const JsonDocument document = parse_json(text, path);
  const JsonCursor json = document.cursor();
  expect_schema(json, "mapproof.scene-reply");
  return {json.at("error").text(), json.at("width").integer32(0, kLargestSide),
          json.at("height").integer32(0, kLargestSide), json.at("renderer").text()};
}

}  // namespace mapproof
