#include <cmath>

#include "core/json/json_cursor.hpp"
#include "reports/diff/diff_outputs.hpp"

namespace mapproof {
namespace {

using Json = nlohmann::ordered_json;

/// JSON has no infinity: what is lost or gained says so by its counts.
Json number(double value) { return std::isfinite(value) ? Json(value) : Json(nullptr); }

template <typename T>
Json optional(const std::optional<T>& value) {
  return value ? number(*value) : Json(nullptr);
}

template <typename List, typename Make>
Json array(const List& list, Make make) {
  Json values = Json::array();
  for (const auto& item : list) values.push_back(make(item));
  return values;
}

Json point(const Point& at) { return Json::array({number(at.x), number(at.y)}); }

Json comparison_json(const Comparison& c) {
  Json json{{"subject", c.subject},
            {"current_subject", c.current_subject},
            {"quantity", c.quantity.id},
            {"outcome", name(c.outcome)},
            {"pairs", c.pairs},
            {"equal", c.equal},
            {"within", c.within},
            {"beyond", c.beyond},
            {"lost", c.lost},
            {"gained", c.gained},
            {"baseline", number(c.baseline_mean)},
            {"current", number(c.current_mean)}};
  json["test"] = nullptr;
  if (c.test)
    json["test"] = {{"unit", c.test->unit},
                    {"pairs", c.test->test.pairs},
                    {"nonzero", c.test->test.nonzero},
                    {"exact", c.test->test.exact},
                    {"p", c.test->test.p},
                    {"p_corrected", c.test->p},
                    {"effect", c.test->test.effect}};
  json["largest"] = array(c.largest, [](const PairedValue& pair) {
    return Json{
        {"run", pair.run}, {"baseline", number(pair.baseline)}, {"current", number(pair.current)}};
  });
  return json;
}

Json points_json(const PointsDiff& p) {
  return {{"record", p.record},
          {"quantity", p.quantity},
          {"points", p.points},
          {"within", p.within},
          {"beyond", p.beyond},
          {"lost", p.lost},
          {"gained", p.gained},
          {"truth_differs", p.truth_differs},
          {"baseline_error", optional(p.baseline_error)},
          {"current_error", optional(p.current_error)},
          {"moves", array(p.moves, [](const PointMove& move) {
             return Json{{"name", move.name},
                         {"baseline", point(move.baseline)},
                         {"current", point(move.current)},
                         {"moved", number(move.moved)},
                         {"baseline_error", optional(move.baseline_error)},
                         {"current_error", optional(move.current_error)}};
           })}};
}

Json setting_json(const SettingChange& change) {
  return {{"pointer", change.pointer}, {"baseline", change.baseline}, {"current", change.current}};
}

Json other_json(const OtherDiff& other) {
  return {
      {"file", other.file},         {"presence", name(other.presence)}, {"numbers", other.numbers},
      {"within", other.within},     {"beyond", other.beyond},           {"first", other.first},
      {"baseline", other.baseline}, {"current", other.current},         {"shape", other.shape}};
}

Json records_json(const RecordDiff& diff) {
  return {{"same_seeds", diff.same_seeds},
          {"values", diff.values},
          {"settings", array(diff.settings, setting_json)},
          {"provenance", array(diff.provenance, setting_json)},
          {"missing_runs", diff.missing_runs},
          {"new_runs", diff.new_runs},
          {"missing_subjects", diff.missing_subjects},
          {"new_subjects", diff.new_subjects},
          {"comparisons", array(diff.comparisons, comparison_json)},
          {"points", array(diff.points, points_json)},
          {"statuses", array(diff.statuses,
                             [](const StatusChange& change) {
                               return Json{{"record", change.record},
                                           {"baseline", change.baseline},
                                           {"current", change.current}};
                             })},
          {"anchors", diff.anchors},
          {"others", array(diff.others, other_json)},
          {"problems", array(diff.problems, [](const RecordProblem& problem) {
             return Json{{"file", problem.file}, {"what", problem.what}};
           })}};
}

Json figure_json(const FigureDiff& diff) {
  return {{"equal", diff.equal},
          {"total_changes", diff.total_changes},
          {"moved", diff.moved},
          {"within", diff.within},
          {"masked", diff.masked},
          {"baseline_error", optional(diff.baseline_error)},
          {"current_error", optional(diff.current_error)},
          {"changes", array(diff.changes,
                            [](const FigureChange& change) {
                              return Json{{"kind", name(change.kind)},
                                          {"place", change.place},
                                          {"what", change.what},
                                          {"baseline", change.baseline},
                                          {"current", change.current}};
                            })},
          {"moves", array(diff.moves, [](const MarkMove& move) {
             return Json{{"place", move.place},
                         {"mark", move.mark},
                         {"landmark", move.landmark},
                         {"curve", move.curve},
                         {"point", move.point},
                         {"baseline", point(move.baseline)},
                         {"current", point(move.current)},
                         {"distance", number(move.distance)},
                         {"unit", move.unit},
                         {"distance_px", optional(move.distance_px)}};
           })}};
}

Json box_json(const PixelBox& box) {
  return {{"x", box.x}, {"y", box.y}, {"width", box.width}, {"height", box.height}};
}

Json pixels_json(const PixelDiff& p) {
  return {{"baseline_size", Json::array({p.baseline.width, p.baseline.height})},
          {"current_size", Json::array({p.current.width, p.current.height})},
          {"differing", p.differing},
          {"changed", p.changed},
          {"antialiased", p.antialiased},
          {"ignored", p.ignored},
          {"changed_share", p.changed_share},
          {"clusters", p.clusters},
          {"largest_cluster", box_json(p.largest_cluster)},
          {"largest_cluster_pixels", p.largest_cluster_pixels},
          {"least_structure", p.least_structure},
          {"least_structure_at", box_json(p.least_structure_at)},
          {"largest_colour_difference", p.largest_colour_difference}};
}

Json svg_json(const SvgDiff& svg) {
  return {{"total", svg.total},
          {"tolerated", svg.tolerated},
          {"geometry", svg.geometry},
          {"style", svg.style},
          {"text", svg.text},
          {"structure", svg.structure},
          {"metadata", svg.metadata},
          {"changes", array(svg.changes, [](const SvgChange& change) {
             return Json{{"element", change.element},           {"what", change.what},
                         {"baseline", change.baseline},         {"current", change.current},
                         {"distance", number(change.distance)}, {"tolerated", change.tolerated}};
           })}};
}

Json picture_json(const PictureFile& file) {
  Json json{{"format", file.format},
            {"baseline_key", file.baseline_key},
            {"baseline", file.baseline.generic_string()},
            {"current", file.current.generic_string()}};
  const bool both = !file.baseline.empty() && !file.current.empty();
  json["state"] = both ? Json(name(file.diff.state)) : Json(nullptr);
  json["reason"] = file.diff.reason;
  json["baseline_bytes"] = file.diff.baseline_bytes;
  json["current_bytes"] = file.diff.current_bytes;
  json["baseline_renderer"] = file.diff.baseline_renderer;
  json["current_renderer"] = file.diff.current_renderer;
  json["pixels"] = file.diff.pixels ? pixels_json(*file.diff.pixels) : Json(nullptr);
  json["svg"] = file.diff.svg ? svg_json(*file.diff.svg) : Json(nullptr);
  return json;
}

Json item_json(const DiffItem& item) {
  Json json{{"id", item.id},
            {"kind", name(item.kind)},
            {"verdict", name(item.judgement.verdict)},
            {"passes", item.passes},
            {"visible", item.judgement.visible},
            {"cause", item.judgement.cause}};
  json["records"] = item.records ? records_json(*item.records) : Json(nullptr);
  json["figure"] = item.figure ? figure_json(*item.figure) : Json(nullptr);
  json["pictures"] = array(item.pictures, picture_json);
  json["documents"] = array(item.documents, other_json);
  return json;
}

}  // namespace

Json diff_json(const DiffResult& result) {
  Json json;
  json["schema"] = schema_value("mapproof.diff");
  json["baseline"] = result.baseline;
  json["current"] = result.current;
  json["verdict"] = name(result.judgement.verdict);
  json["passes"] = result.passes;
  json["cause"] = result.judgement.cause;
  json["allowed"] = array(result.allowed, [](Verdict verdict) { return name(verdict); });
  json["remarks"] = result.remarks;
  const std::vector<int> counts = counts_of(result);
  for (std::size_t v = 0; v < kVerdicts.size(); ++v)
    json["counts"][std::string(name(kVerdicts[v]))] = counts[v];
  json["items"] = array(result.items, item_json);
  return json;
}

}  // namespace mapproof
