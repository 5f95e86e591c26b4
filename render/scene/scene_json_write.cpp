#include <cmath>

#include <nlohmann/json.hpp>

#include "core/json/json_cursor.hpp"
#include "core/json/json_text.hpp"
#include "render/plot/figure_json_names.hpp"
#include "render/scene/scene_json.hpp"

namespace mapproof {
namespace {

using Json = nlohmann::ordered_json;

Json ink_json(Ink ink) { return figure_json::kInks[static_cast<std::size_t>(ink)]; }

Json number_json(double value) { return std::isnan(value) ? Json() : Json(value); }

Json place_json(const Point3& p) { return {p.x(), p.y(), p.z()}; }

Json range_json(const Range& range) { return {range.low, range.high}; }

Json places_json(const std::vector<Point3>& points) {
  Json list = Json::array();
  for (const Point3& point : points) list.push_back(place_json(point));
  return list;
}

Json numbers_json(const std::vector<double>& values) {
  Json list = Json::array();
  for (const double value : values) list.push_back(number_json(value));
  return list;
}

Json look_json(const Look& look) {
  return {{"ink", ink_json(look.ink)},
          {"share", look.share},
          {"opacity", look.opacity},
          {"lit", look.lit}};
}

Json tones_json(const Tones& tones) {
  return {{"values", numbers_json(tones.values)}, {"limits", range_json(tones.limits)}};
}

Json part_json(const Surface& part) {
  return {{"kind", "surface"},
          {"label", part.label},
          {"points", places_json(part.points)},
          {"triangles", part.triangles},
          {"smooth", part.smooth},
          {"look", look_json(part.look)},
          {"tones", tones_json(part.tones)}};
}

Json part_json(const Tube& part) {
  return {
      {"kind", "tube"},        {"label", part.label},          {"points", places_json(part.points)},
      {"radius", part.radius}, {"look", look_json(part.look)}, {"tones", tones_json(part.tones)}};
}

Json part_json(const Rods& part) {
  return {{"kind", "rods"},
          {"label", part.label},
          {"from", places_json(part.from)},
          {"to", places_json(part.to)},
          {"radius", part.radius},
          {"arrow", part.arrow},
          {"look", look_json(part.look)},
          {"tones", tones_json(part.tones)}};
}

Json part_json(const Spheres& part) {
  return {
      {"kind", "spheres"},     {"label", part.label},          {"at", places_json(part.at)},
      {"radius", part.radius}, {"look", look_json(part.look)}, {"tones", tones_json(part.tones)}};
}

Json part_json(const Field& part) {
  return {{"kind", "field"},
          {"label", part.label},
          {"points", places_json(part.points)},
          {"look", look_json(part.look)},
          {"tones", tones_json(part.tones)},
          {"levels", numbers_json(part.levels)},
          {"contour_radius", part.contour_radius}};
}

Json camera_json(const Camera& camera) {
  return {{"eye", place_json(camera.eye)}, {"target", place_json(camera.target)},
          {"up", place_json(camera.up)},   {"parallel", camera.parallel},
          {"height", camera.height},       {"angle_rad", camera.angle_rad},
          {"aspect", camera.aspect}};
}

Json view_json(const Shot& view) {
  Json labels = Json::array();
  for (const SceneLabels& one : view.labels)
    labels.push_back({{"at", places_json(one.at)}, {"text", one.text}, {"ink", ink_json(one.ink)}});
  Json rules = Json::array();
  for (const Rule& rule : view.rules)
    rules.push_back({{"from", place_json(rule.from)},
                     {"to", place_json(rule.to)},
                     {"range", range_json(rule.range)},
                     {"label", rule.label},
                     {"away", place_json(rule.away)}});
  return {{"title", view.title},
          {"camera", camera_json(view.camera)},
          {"parts", view.parts},
          {"labels", std::move(labels)},
          {"rules", std::move(rules)}};
}

Json scene_json(const Scene& scene) {
  Json notes = Json::array();
  for (const Note& note : scene.notes)
    notes.push_back({{"text", note.text}, {"ink", ink_json(note.ink)}});
  Json parts = Json::array();
  for (const Part& part : scene.parts)
    parts.push_back(std::visit([](const auto& one) { return part_json(one); }, part));
  Json lights = Json::array();
  for (const Light& light : scene.lights)
    lights.push_back({{"from", place_json(light.from)}, {"strength", light.strength}});
  Json views = Json::array();
  for (const Shot& view : scene.views) views.push_back(view_json(view));
  return {{"schema", schema_value("mapproof.scene")},
          {"id", scene.id},
          {"title", scene.title},
          {"caption", scene.caption},
          {"alt", scene.alt},
          {"records", scene.record_ids},
          {"varies", scene.varies},
          {"notes", std::move(notes)},
          {"parts", std::move(parts)},
          {"lights", std::move(lights)},
          {"views", std::move(views)},
          {"columns", scene.columns}};
}

}  // namespace

std::string scene_to_json(const Scene& scene) { return json_text(scene_json(scene)); }

std::string scene_to_line(const Scene& scene) { return json_line(scene_json(scene)); }

}  // namespace mapproof
