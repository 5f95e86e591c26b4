#include <algorithm>

#include <fmt/format.h>

#include "core/base/words.hpp"
#include "reports/sections/cells.hpp"
#include "reports/sections/slam/slam_tables.hpp"

namespace mapproof {
namespace {

std::optional<MeanEstimate> known(const MeanEstimate& estimate) {
  return estimate.values > 0 ? std::optional(estimate) : std::nullopt;
}

const RangeHistoryMap* map_of(const RangeHistoryStudy& study, Method method, bool squared) {
  for (const RangeHistoryMap& map : study.maps)
    if (map.setting && map.setting->method == method && map.squared == squared) return &map;
  return nullptr;
}

void add_score(const RangeHistoryMap* map, Row& row) {
  const bool scored = map != nullptr && map->score;
  row.cells.push_back(scored ? Cell{NumberCell{map->score->mpe_all_fitted_m, 4}} : MissingCell{});
  row.cells.push_back(scored ? Cell{NumberCell{map->score->moe_unmirrored_percent, kMoeDecimals}}
                             : MissingCell{});
}

}  // namespace

Table slam_convergence_table(std::span<const ConvergenceCurve> curves) {
  const std::string model = "Error of \u0108", landmarks = "Landmarks", positions = "Positions",
                    angle = "Subspace angle";
  Table table;
  table.id = "slam-convergence";
  table.caption = "Convergence with the number of readings";
  table.columns = {{"Noise", "", "", ""},
                   {"Readings", "", "", "Landmarks times steps."},
                   {"Pairs", "", "", "Random pairs of path and environment."},
                   {"Mean", "", model, "Frobenius norm."},
                   {"95 %", "", model, ""},
                   {"Mean", "m", landmarks, ""},
                   {"95 %", "m", landmarks, ""},
                   {"Mean", "m", positions, ""},
                   {"Sine", "", angle, "Of the largest canonical angle."},
                   {"Bound", "", angle, "Eq. 5, its constant fitted at the first point."}};
  for (const ConvergenceCurve& curve : curves)
    for (const ConvergencePoint& point : curve.points)
      table.rows.push_back(
          {{TextCell{curve.title},
            NumberCell{static_cast<double>(point.steps) * std::max(curve.landmarks, 1), 0},
            NumberCell{static_cast<double>(point.observation.values), 0},
            mean_cell(known(point.observation), 4), interval_cell(known(point.observation), 4),
            mean_cell(known(point.landmarks_m), 4), interval_cell(known(point.landmarks_m), 4),
            mean_cell(known(point.positions_m), 4), mean_cell(known(point.sine), 6),
            point.bound > 0.0 ? Cell{NumberCell{point.bound, 6}} : Cell{MissingCell{}}},
           "convergence/" + curve.id,
           false});
  return table;
}

Table slam_history_table(const RangeHistoryStudy& study) {
  Table table;
  table.id = "slam-histories";
  table.caption = fmt::format("Maps of {} landmarks from {} steps of ranges",
                              study.landmarks_m.rows(), study.steps);
  table.columns = {
      {"Method", "", "", ""},
      {"MPE", "m", "Ranges", "After the affine map that fits all landmarks best."},
      {"MOE", "%", "Ranges", "Landmark triples that turn the wrong way, up to a mirror."},
      {"MPE", "m", "Squared ranges", ""},
      {"MOE", "%", "Squared ranges", ""}};
  for (const MethodInfo& method : all_methods()) {
    const RangeHistoryMap* range = map_of(study, method.method, false);
    const RangeHistoryMap* squared = map_of(study, method.method, true);
    if (range == nullptr && squared == nullptr) continue;
    const RangeHistoryMap& any = range != nullptr ? *range : *squared;
    Row row{{TextCell{label(*any.setting)}}, fmt::format("histories/{}", method.name), false};
    add_score(range, row);
    add_score(squared, row);
    table.rows.push_back(std::move(row));
  }
  for (const RangeHistoryMap& map : study.maps) {
    if (map.setting) continue;
    Row row{{TextCell{"Spectral, no landmark known"}, MissingCell{}, MissingCell{}},
            "histories/spectral",
            false};
    add_score(&map, row);
    table.rows.push_back(std::move(row));
  }
  return table;
}

Table slam_space_table(const SpaceRun& run) {
  Table table;
  table.id = "slam-space";
  table.caption = fmt::format("{} in space from {} steps of ranges",
                              counted(run.landmarks_m.rows(), "landmark"), run.positions_m.rows());
  table.columns = {{"Known landmarks", "", "", ""},
                   {"Landmarks", "m", "Mean error", ""},
                   {"Positions", "m", "Mean error", ""},
                   {"Alignment", "", "", "Before the errors were taken."},
                   {"Range scale", "", "", "Measured range over distance, where it can be told."},
                   {"Condition", "", "", "Of the regression, or of the upgrade."}};
  const auto cell = [](const std::optional<double>& number, int decimals) {
    return number ? Cell{NumberCell{*number, decimals}} : Cell{MissingCell{}};
  };
  for (const SpaceRecord& record : run.records) {
    const bool has_scale = record.knows_landmarks && !record.estimate.empty();
    const std::string known =
        record.knows_landmarks ? fmt::format("{}", run.known.size()) : std::string("none");
    table.rows.push_back(
        {{TextCell{known}, cell(record.landmarks_error_m, 4), cell(record.positions_error_m, 4),
          TextCell{std::string(name(record.alignment))},
          has_scale ? Cell{NumberCell{record.estimate.range_scale, 4}} : Cell{MissingCell{}},
          cell(record.estimate.condition, 1)},
         record.knows_landmarks ? "space/known" : "space/unknown",
         false});
  }
  return table;
}

}  // namespace mapproof
