#pragma once

#include <numbers>
#include <string>
#include <string_view>

#include "render/plot/figure_fields.hpp"
#include "render/scene/scene.hpp"

namespace mapproof {

// The fields of a scene in files (core/json/fields.hpp).

namespace scene_rules {

inline constexpr FieldRule kLength = {.minimum = 0.0, .maximum = 1e9, .above_minimum = true};

}  // namespace scene_rules

template <typename Visitor>
void fields(Visitor& v, Style& style) {
  v.type("style");
  v.field("colour", style.colour);
  v.field("share", style.share, {.minimum = 0.0, .maximum = 1.0});
  v.field("opacity", style.opacity, {.minimum = 0.0, .maximum = 1.0, .above_minimum = true});
  v.field("lit", style.lit);
}

template <typename Visitor>
void fields(Visitor& v, Tones& tones) {
  v.type("tones");
  v.field("values", tones.values,
          {.description = "One per point, rod or sphere, or none; null: the style's colour.",
           .nullable = true});
  v.field("limits", tones.limits);
  v.field("bar_label", tones.bar_label,
          {.description = "Of a colour bar beside each view of the part. Missing: there is none.",
           .max_bytes = figure_rules::kLongestText,
           .key = Key::kIfAny});
}

template <typename Visitor>
void fields(Visitor& v, Surface& surface) {
  v.tag("kind", "surface");
  v.field("label", surface.label, figure_rules::kText);
  v.field("points", surface.points);
  v.field("triangles", surface.triangles, {.maximum = 1e9});
  v.field("smooth", surface.smooth);
  v.field("style", surface.style);
  v.field("tones", surface.tones);
}

template <typename Visitor>
void fields(Visitor& v, Tube& tube) {
  v.tag("kind", "tube");
  v.field("label", tube.label, figure_rules::kText);
  v.field("points", tube.points);
  v.field("radius", tube.radius, scene_rules::kLength);
  v.field("style", tube.style);
  v.field("tones", tube.tones);
}

template <typename Visitor>
void fields(Visitor& v, Rods& rods) {
  v.tag("kind", "rods");
  v.field("label", rods.label, figure_rules::kText);
  v.field("from", rods.from);
  v.field("to", rods.to);
  v.field("radius", rods.radius, scene_rules::kLength);
  v.field("arrow", rods.arrow);
  v.field("style", rods.style);
  v.field("tones", rods.tones);
}

template <typename Visitor>
void fields(Visitor& v, Spheres& spheres) {
  v.tag("kind", "spheres");
  v.field("label", spheres.label, figure_rules::kText);
  v.field("at", spheres.at);
  v.field("radius", spheres.radius, scene_rules::kLength);
  v.field("style", spheres.style);
  v.field("tones", spheres.tones);
}

template <typename Visitor>
void fields(Visitor& v, Field& field) {
  v.tag("kind", "field");
  v.field("label", field.label, figure_rules::kText);
  v.field("points", field.points, {.min_items = 3});
  v.field("style", field.style);
  v.field("tones", field.tones);
  v.field("levels", field.levels);
  v.field("contour_radius", field.contour_radius, scene_rules::kLength);
}

template <typename Visitor>
void fields(Visitor& v, Camera& camera) {
  v.type("camera");
  v.field("eye", camera.eye);
  v.field("target", camera.target);
  v.field("up", camera.up);
  v.field("parallel", camera.parallel);
  v.field("height", camera.height, scene_rules::kLength);
  v.field("angle_rad", camera.angle_rad,
          {.minimum = 0.0, .maximum = std::numbers::pi, .above_minimum = true});
  v.field("aspect", camera.aspect, {.minimum = 0.2, .maximum = 5.0});
}

template <typename Visitor>
void fields(Visitor& v, SceneLabels& labels) {
  v.field("at", labels.at);
  v.field("text", labels.text, figure_rules::kText);
  v.field("colour", labels.colour);
}

template <typename Visitor>
void fields(Visitor& v, Rule& rule) {
  v.field("from", rule.from);
  v.field("to", rule.to);
  v.field("range", rule.range);
  v.field("label", rule.label, figure_rules::kText);
  v.field("away", rule.away);
}

template <typename Visitor>
void fields(Visitor& v, Shot& view) {
  v.type("view");
  v.field("title", view.title, figure_rules::kText);
  v.field("camera", view.camera);
  v.field("parts", view.parts,
          {.description = "Those that are shown; empty: all.", .maximum = 1e9});
  v.field("labels", view.labels);
  v.field("rules", view.rules);
}

template <typename Visitor>
void fields(Visitor& v, Light& light) {
  v.field("from", light.from);
  v.field("strength", light.strength, {.minimum = 0.0, .maximum = 10.0});
}

template <typename Visitor>
void fields(Visitor& v, Scene& scene) {
  using namespace figure_rules;
  v.file("mapproof.scene",
         "A scene as a value: what is drawn, not how. Written by mapproof as ID.scene.json.");
  v.field("id", scene.id, {.form = &kFigureId});
  v.field("title", scene.title, kText);
  v.field("caption", scene.caption, kText);
  v.field("alt", scene.alt, described(kText, "What the scene shows, in words with numbers."));
  v.field("records", scene.record_ids, kText);
  v.field("varies", scene.varies);
  v.field("notes", scene.notes);
  v.field("parts", scene.parts);
  v.field("lights", scene.lights, {.max_items = 8});
  v.field("views", scene.views, {.min_items = 1});
  v.field("columns", scene.columns, kCount);
}

/// The scene as JSON (docs/schemas/scene.schema.json): doubles round-trip, NaN is null, a line feed
/// at the end. The same scene gives the same bytes.
std::string scene_to_json(const Scene& scene);

/// The scene that such JSON holds. @throws IoError with `path` and the JSON pointer of what is
/// wrong.
Scene scene_from_json(std::string_view text, const std::string& path);

/// The same on one line.
std::string scene_to_line(const Scene& scene);

}  // namespace mapproof
