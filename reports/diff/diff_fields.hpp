#pragma once

#include <optional>
#include <string>
#include <tuple>
#include <vector>

#include "core/json/fields.hpp"
#include "reports/diff/diff_result.hpp"

namespace mapproof {

// The fields of the JSON output of a comparison (core/json/fields.hpp), which is only written.
// JSON has no infinity: counts show what is lost or gained.

inline EnumNames enum_names(Verdict) { return names_up_to(Verdict::kUnreadable, "verdict"); }
inline EnumNames enum_names(Outcome) { return names_up_to(Outcome::kChanged, "outcome"); }
inline EnumNames enum_names(Presence) { return names_up_to(Presence::kCurrent, "presence"); }
inline EnumNames enum_names(ChangeKind) { return names_up_to(ChangeKind::kData, "change"); }
inline EnumNames enum_names(ItemKind) { return names_up_to(ItemKind::kDocument, "item_kind"); }
inline EnumNames enum_names(ImageState) {
  return names_up_to(ImageState::kUnreadable, "image_state");
}

inline auto as_tuple(Point& at) { return std::tie(at.x, at.y); }
inline auto as_tuple(ImageSize& size) { return std::tie(size.width, size.height); }

namespace record_rules {

inline constexpr FieldRule kMany = {.minimum = 0};
inline constexpr FieldRule kFinite = {.nullable = true};

}  // namespace record_rules

template <typename Visitor>
void fields(Visitor& v, PairedValue& pair) {
  v.field("run", pair.run);
  v.field("baseline", pair.baseline, record_rules::kFinite);
  v.field("current", pair.current, record_rules::kFinite);
}

template <typename Visitor>
void fields(Visitor& v, PairedTest& paired) {
  using namespace record_rules;
  v.field("unit", paired.unit, {.description = "layout, group or run."});
  v.field("pairs", paired.change.units, kMany);
  v.field("nonzero", paired.change.ranks.nonzero, kMany);
  v.field("by_ranks", paired.change.by_ranks,
          {.description = "Wilcoxon's signed-rank test; else Student's t test."});
  v.field("equal", paired.change.equal,
          {.description = "The changes are equal: Student's t test has no p, p is 0."});
  v.field("exact", paired.change.ranks.exact, {.description = "The p of the signed-rank test."});
  v.field("p", paired.change.p, {.minimum = 0.0, .maximum = 1.0});
  v.field("p_corrected", paired.p, {.minimum = 0.0, .maximum = 1.0});
  v.field("effect", paired.change.ranks.effect, {.minimum = -1.0, .maximum = 1.0});
}

template <typename Visitor>
void fields(Visitor& v, Comparison& comparison) {
  using namespace record_rules;
  v.type("comparison");
  v.field("subject", comparison.subject);
  v.field("current_subject", comparison.current_subject);
  v.field("quantity", comparison.quantity.id);
  v.field("outcome", comparison.outcome);
  v.field("pairs", comparison.pairs, kMany);
  v.field("equal", comparison.equal, kMany);
  v.field("within", comparison.within, kMany);
  v.field("beyond", comparison.beyond, kMany);
  v.field("lost", comparison.lost, kMany);
  v.field("gained", comparison.gained, kMany);
  v.field("baseline", comparison.baseline_mean, kFinite);
  v.field("current", comparison.current_mean, kFinite);
  v.field("test", comparison.test);
  v.field("largest", comparison.largest);
}

template <typename Visitor>
void fields(Visitor& v, PointMove& move) {
  using namespace record_rules;
  v.field("name", move.name);
  v.field("baseline", move.baseline, kFinite);
  v.field("current", move.current, kFinite);
  v.field("moved", move.moved, kFinite);
  v.field("baseline_error", move.baseline_error, kFinite);
  v.field("current_error", move.current_error, kFinite);
}

template <typename Visitor>
void fields(Visitor& v, PointsDiff& points) {
  using namespace record_rules;
  v.type("points");
  v.field("record", points.record);
  v.field("quantity", points.quantity);
  v.field("points", points.points, kMany);
  v.field("within", points.within, kMany);
  v.field("beyond", points.beyond, kMany);
  v.field("lost", points.lost, kMany);
  v.field("gained", points.gained, kMany);
  v.field("ground_truth_differs", points.ground_truth_differs);
  v.field("transform", points.transform);
  v.field("renamed", points.renamed);
  v.field("moved_ground_truth", points.moved_ground_truth);
  v.field("baseline_error", points.baseline_error, kFinite);
  v.field("current_error", points.current_error, kFinite);
  v.field("moves", points.moves);
}

template <typename Visitor>
void fields(Visitor& v, SettingChange& change) {
  v.type("setting");
  v.field("pointer", change.pointer);
  v.field("baseline", change.baseline);
  v.field("current", change.current);
}

template <typename Visitor>
void fields(Visitor& v, StatusChange& change) {
  v.field("record", change.record);
  v.field("baseline", change.baseline);
  v.field("current", change.current);
}

template <typename Visitor>
void fields(Visitor& v, OtherDiff& other) {
  using namespace record_rules;
  v.type("other");
  v.field("file", other.file);
  v.field("presence", other.presence);
  v.field("numbers", other.numbers, kMany);
  v.field("within", other.within, kMany);
  v.field("beyond", other.beyond, kMany);
  v.field("first", other.first);
  v.field("baseline", other.baseline);
  v.field("current", other.current);
  v.field("shape", other.shape);
}

template <typename Visitor>
void fields(Visitor& v, RecordProblem& problem) {
  v.field("file", problem.file);
  v.field("what", problem.what);
}

template <typename Visitor>
void fields(Visitor& v, RecordDiff& diff) {
  v.type("records");
  v.field("same_seeds", diff.same_seeds);
  v.field("values", diff.values, record_rules::kMany);
  v.field("settings", diff.settings);
  v.field("provenance", diff.provenance);
  v.field("missing_runs", diff.missing_runs);
  v.field("new_runs", diff.new_runs);
  v.field("missing_subjects", diff.missing_subjects);
  v.field("new_subjects", diff.new_subjects);
  v.field("comparisons", diff.comparisons);
  v.field("points", diff.points);
  v.field("statuses", diff.statuses);
  v.field("anchors", diff.anchors);
  v.field("others", diff.others);
  v.field("problems", diff.problems);
}

template <typename Visitor>
void fields(Visitor& v, FigureChange& change) {
  v.field("kind", change.kind);
  v.field("location", change.location);
  v.field("what", change.what);
  v.field("baseline", change.baseline);
  v.field("current", change.current);
}

template <typename Visitor>
void fields(Visitor& v, MarkMove& move) {
  using namespace record_rules;
  v.field("location", move.location);
  v.field("mark", move.mark);
  v.field("landmark", move.landmark);
  v.field("curve", move.curve);
  v.field("point", move.point);
  v.field("baseline", move.baseline, kFinite);
  v.field("current", move.current, kFinite);
  v.field("distance", move.distance, kFinite);
  v.field("unit", move.unit);
  v.field("distance_px", move.distance_px, kFinite);
}

template <typename Visitor>
void fields(Visitor& v, FigureDiff& diff) {
  using namespace record_rules;
  v.type("figure");
  v.field("equal", diff.equal);
  v.field("total_changes", diff.total_changes, kMany);
  v.field("moved", diff.moved, kMany);
  v.field("within", diff.within, kMany);
  v.field("masked", diff.masked, kMany);
  v.field("baseline_error", diff.baseline_error, kFinite);
  v.field("current_error", diff.current_error, kFinite);
  v.field("changes", diff.changes);
  v.field("transforms", diff.transforms);
  v.field("moves", diff.moves);
}

template <typename Visitor>
void fields(Visitor& v, PixelBox& box) {
  v.type("box");
  v.field("x", box.x);
  v.field("y", box.y);
  v.field("width", box.width);
  v.field("height", box.height);
}

template <typename Visitor>
void fields(Visitor& v, PixelDiff& pixels) {
  using namespace record_rules;
  v.type("pixels");
  v.field("baseline_size", pixels.baseline);
  v.field("current_size", pixels.current);
  v.field("differing", pixels.differing, kMany);
  v.field("changed", pixels.changed, kMany);
  v.field("antialiased", pixels.antialiased, kMany);
  v.field("ignored", pixels.ignored, kMany);
  v.field("changed_share", pixels.changed_share);
  v.field("clusters", pixels.clusters, kMany);
  v.field("largest_cluster", pixels.largest_cluster);
  v.field("largest_cluster_pixels", pixels.largest_cluster_pixels, kMany);
  v.field("least_structure", pixels.least_structure);
  v.field("least_structure_at", pixels.least_structure_at);
  v.field("largest_colour_difference", pixels.largest_colour_difference);
}

template <typename Visitor>
void fields(Visitor& v, SvgChange& change) {
  v.field("element", change.element);
  v.field("what", change.what);
  v.field("baseline", change.baseline);
  v.field("current", change.current);
  v.field("distance", change.distance, record_rules::kFinite);
  v.field("tolerated", change.tolerated);
}

template <typename Visitor>
void fields(Visitor& v, SvgDiff& svg) {
  using namespace record_rules;
  v.type("svg");
  v.field("total", svg.total, kMany);
  v.field("tolerated", svg.tolerated, kMany);
  v.field("geometry", svg.geometry, kMany);
  v.field("style", svg.style, kMany);
  v.field("text", svg.text, kMany);
  v.field("structure", svg.structure, kMany);
  v.field("metadata", svg.metadata, kMany);
  v.field("changes", svg.changes);
}

template <typename Visitor>
void fields(Visitor& v, ImageFile& file) {
  v.type("image");
  std::string baseline = file.baseline.generic_string(), current = file.current.generic_string();
  std::optional<ImageState> state;
  if (!baseline.empty() && !current.empty()) state = file.diff.state;
  v.field("format", file.format, {.description = "png, svg or pdf."});
  v.field("baseline_key", file.baseline_key);
  v.field("baseline", baseline);
  v.field("current", current);
  v.field("state", state);
  v.field("reason", file.diff.reason);
  v.field("baseline_bytes", file.diff.baseline_bytes);
  v.field("current_bytes", file.diff.current_bytes);
  v.field("baseline_renderer", file.diff.baseline_renderer);
  v.field("current_renderer", file.diff.current_renderer);
  v.field("pixels", file.diff.pixels);
  v.field("svg", file.diff.svg);
}

template <typename Visitor>
void fields(Visitor& v, DiffItem& item) {
  v.type("item");
  v.field("id", item.id);
  v.field("kind", item.kind);
  v.field("verdict", item.judgement.verdict);
  v.field("passes", item.passes);
  v.field("visible", item.judgement.visible);
  v.field("cause", item.judgement.cause);
  v.field("shared_cause", item.judgement.shared_cause);
  v.field("stale", item.is_stale);
  v.field("records", item.records);
  v.field("figure", item.figure);
  v.field("images", item.images);
  v.field("documents", item.documents);
}

template <typename Visitor>
void fields(Visitor& v, SharedCause& shared) {
  v.field("cause", shared.cause);
  v.field("verdict", shared.verdict);
  v.field("ids", shared.ids);
}

template <typename Visitor>
void fields(Visitor& v, DiffResult& result) {
  v.file("mapproof.diff",
         "What mapproof diff found. A number that would be infinite or is missing is null.");
  v.field("baseline", result.baseline);
  v.field("current", result.current);
  v.field("verdict", result.judgement.verdict);
  v.field("passes", result.passes);
  v.field("cause", result.judgement.cause);
  v.field("allowed", result.allowed);
  v.field("remarks", result.remarks);
  v.field("shared_causes", result.shared);
  v.group("counts", [&](auto& counts) {
    std::vector<int> of_verdict = counts_of(result);
    for (std::size_t i = 0; i < kVerdicts.size(); ++i)
      counts.field(name(kVerdicts[i]), of_verdict[i], record_rules::kMany);
  });
  v.field("items", result.items);
}

}  // namespace mapproof
