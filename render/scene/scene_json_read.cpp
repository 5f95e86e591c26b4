#include <limits>

#include "core/base/errors.hpp"
#include "core/json/json_cursor.hpp"
#include "core/json/text_input.hpp"
#include "render/plot/figure_json_names.hpp"
#include "render/scene/scene_json.hpp"

namespace mapproof {
namespace {

constexpr double kGreatest = std::numeric_limits<double>::max();
constexpr std::size_t kLongestText = 100'000'000;

std::string text(const JsonCursor& json) { return json.text(kLongestText); }

double number(const JsonCursor& json) { return json.number(-kGreatest, kGreatest); }

std::size_t count(const JsonCursor& json) {
  return static_cast<std::size_t>(json.integer(0, 1'000'000'000));
}

template <typename Read>
auto list(const JsonCursor& json, Read read) {
  std::vector<decltype(read(json))> values;
  for (const JsonCursor& item : json.elements()) values.push_back(read(item));
  return values;
}

Point3 place(const JsonCursor& json) {
  const std::vector<JsonCursor> parts = json.elements(3, 3);
  return {number(parts[0]), number(parts[1]), number(parts[2])};
}

Range range(const JsonCursor& json) {
  const std::vector<JsonCursor> ends = json.elements(2, 2);
  return {number(ends[0]), number(ends[1])};
}

Ink ink(const JsonCursor& json) {
  const std::string given = text(json);
  for (std::size_t i = 0; i < figure_json::kInks.size(); ++i)
    if (given == figure_json::kInks[i]) return static_cast<Ink>(i);
  json.fail(in_quotes(given) + " is unknown");
}

Look look(const JsonCursor& json) {
  json.allow_only({"ink", "share", "opacity", "lit"});
  return {ink(json.at("ink")), number(json.at("share")), number(json.at("opacity")),
          json.at("lit").boolean()};
}

Tones tones(const JsonCursor& json) {
  json.allow_only({"values", "limits"});
  return {json.at("values").numbers_or_null(-kGreatest, kGreatest), range(json.at("limits"))};
}

std::array<std::uint32_t, 3> triangle(const JsonCursor& json) {
  const std::vector<JsonCursor> corners = json.elements(3, 3);
  std::array<std::uint32_t, 3> read{};
  for (std::size_t i = 0; i < 3; ++i) read[i] = static_cast<std::uint32_t>(count(corners[i]));
  return read;
}

/// The keys of each kind beside those of all.
void allow_keys_of(const std::string& kind, const JsonCursor& json) {
  std::vector<std::string_view> keys = {"kind", "label", "look", "tones"};
  const auto also = [&keys](std::initializer_list<std::string_view> more) {
    keys.insert(keys.end(), more);
  };
  if (kind == "surface") also({"points", "triangles", "smooth"});
  if (kind == "tube") also({"points", "radius"});
  if (kind == "rods") also({"from", "to", "radius", "arrow"});
  if (kind == "spheres") also({"at", "radius"});
  if (kind == "field") also({"points", "levels", "contour_radius"});
  json.allow_only(keys);
}

Part part(const JsonCursor& json) {
  const std::string kind = text(json.at("kind"));
  allow_keys_of(kind, json);
  const std::string label = text(json.at("label"));
  const Look surface_look = look(json.at("look"));
  Tones values = tones(json.at("tones"));
  if (kind == "surface")
    return Surface{label,
                   list(json.at("points"), place),
                   list(json.at("triangles"), triangle),
                   json.at("smooth").boolean(),
                   surface_look,
                   std::move(values)};
  if (kind == "tube")
    return Tube{label, list(json.at("points"), place), number(json.at("radius")), surface_look,
                std::move(values)};
  if (kind == "rods")
    return Rods{label,
                list(json.at("from"), place),
                list(json.at("to"), place),
                number(json.at("radius")),
                json.at("arrow").boolean(),
                surface_look,
                std::move(values)};
  if (kind == "spheres")
    return Spheres{label, list(json.at("at"), place), number(json.at("radius")), surface_look,
                   std::move(values)};
  if (kind == "field")
    return Field{label,
                 list(json.at("points"), place),
                 surface_look,
                 std::move(values),
                 list(json.at("levels"), number),
                 number(json.at("contour_radius"))};
  json.at("kind").fail("the kind " + in_quotes(kind) + " is unknown");
}

Camera camera(const JsonCursor& json) {
  json.allow_only({"eye", "target", "up", "parallel", "height", "angle_rad", "aspect"});
  return {place(json.at("eye")),         place(json.at("target")),  place(json.at("up")),
          json.at("parallel").boolean(), number(json.at("height")), number(json.at("angle_rad")),
          number(json.at("aspect"))};
}

SceneLabels labels(const JsonCursor& json) {
  json.allow_only({"at", "text", "ink"});
  return {list(json.at("at"), place), list(json.at("text"), text), ink(json.at("ink"))};
}

Rule rule(const JsonCursor& json) {
  json.allow_only({"from", "to", "range", "label", "away"});
  return {place(json.at("from")), place(json.at("to")), range(json.at("range")),
          text(json.at("label")), place(json.at("away"))};
}

Shot view(const JsonCursor& json) {
  json.allow_only({"title", "camera", "parts", "labels", "rules"});
  return {text(json.at("title")), camera(json.at("camera")), list(json.at("parts"), count),
          list(json.at("labels"), labels), list(json.at("rules"), rule)};
}

Note note(const JsonCursor& json) {
  json.allow_only({"text", "ink"});
  return {text(json.at("text")), ink(json.at("ink"))};
}

Light light(const JsonCursor& json) {
  json.allow_only({"from", "strength"});
  return {place(json.at("from")), number(json.at("strength"))};
}

Scene read_scene(const JsonCursor& json) {
  expect_schema(json, "mapproof.scene");
  json.allow_only({"schema", "id", "title", "caption", "alt", "records", "varies", "notes", "parts",
                   "lights", "views", "columns"});
  Scene scene{
      text(json.at("id")),          text(json.at("title")),         text(json.at("caption")),
      text(json.at("alt")),         list(json.at("records"), text), json.at("varies").boolean(),
      list(json.at("notes"), note), list(json.at("parts"), part),   list(json.at("lights"), light),
      list(json.at("views"), view), count(json.at("columns"))};
  if (const std::string what = problem(scene); !what.empty())
    throw IoError(json.source(), "/" + what);
  return scene;
}

}  // namespace

Scene scene_from_json(std::string_view text, const std::string& path) {
  const JsonDocument document = parse_json(text, path);
  return read_scene(document.cursor());
}

}  // namespace mapproof
