#include "reports/sections/slam/slam_tables.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "core/base/not_finite.hpp"
#include "core/base/text/words.hpp"
#include "render/figures/maps/path_styles.hpp"
#include "render/figures/unit_scale.hpp"
#include "reports/sections/slam/slam_text.hpp"
#include "reports/sections/tables/cells.hpp"
#include "reports/sections/wording.hpp"

namespace mapproof {
namespace {

using Eigen::Index;

Cell optional_cell(const std::optional<double>& value, int decimals) {
  if (!value) return MissingCell{};
  return NumberCell{*value, decimals};
}

Cell count_cell(double count) { return NumberCell{count, 0}; }

std::string method_label(SlamMethod method) {
  return fmt::format("{}{}", info(method).label, info(method).baseline ? " (baseline)" : "");
}

/// Ranges over distances, where the method determined it from the data.
Cell scale_cell(const SlamRecord& record) {
  if (record.estimate.range_scale == 1.0) return MissingCell{};
  return NumberCell{record.estimate.range_scale, 4};
}

void add_error_cells(const TrajectoryError& error, Row& row) {
  for (const double value :
       {error.mean_m, error.rmse_m, error.last_tenth_m, error.best_tenth_m, error.worst_tenth_m})
    row.cells.emplace_back(NumberCell{value, 3});
  row.cells.push_back(optional_cell(error.landmarks_m, 3));
}

Row error_row(const SlamRun& run, const SlamRecord& record) {
  Row row;
  row.source = record_id(run, record);
  row.cells = {
      TextCell{title_of(run), Emphasis::kData}, TextCell{method_label(record.method)},
      TextCell{info(record.method).knows_landmarks ? counted(std::ssize(run.known), "landmark")
                                                   : "none"}};
  if (record.errors.empty()) {
    for (int i = 0; i < 7; ++i) row.cells.emplace_back(MissingCell{});
  } else {
    row.cells.emplace_back(TextCell{alignment_words(record.errors.front().alignment)});
    add_error_cells(record.errors.front(), row);
  }
  row.cells.push_back(scale_cell(record));
  return row;
}

/// The run's record of least mean error among those that are aligned rigidly; null if there is
/// none.
const SlamRecord* best_rigid(const SlamRun& run) {
  const SlamRecord* best = nullptr;
  for (const SlamRecord& record : run.records) {
    if (record.errors.empty() || record.errors.front().alignment != Alignment::kRigid ||
        !std::isfinite(record.errors.front().mean_m))
      continue;
    if (best == nullptr || record.errors.front().mean_m < best->errors.front().mean_m)
      best = &record;
  }
  return best;
}

/// Why the refined paths of one log differ between a study and `mapproof slam`; empty of runs that
/// refine none.
std::string model_words(std::span<const SlamRun* const> runs) {
  const auto is_refined = [](const SlamRun* run) {
    return error_of(*run, SlamMethod::kRefined) != nullptr;
  };
  const auto refined = std::ranges::find_if(runs, is_refined);
  if (refined == runs.end()) return "";
  const bool is_of_fit = (*refined)->fit.has_value();
  if (is_of_fit && (*refined)->known.size() >= 2) return "";  // They tie a refinement of its own.
  return is_of_fit
             ? "Refined, scale free: the map of the test of the fit, whose model of the ranges has "
               "constant errors of landmarks and outliers. Studies such as boots2013 refine "
               "without these, as refined (from odometry) does here, so that their errors on the "
               "same log differ."
             : "Refined: without constant errors of landmarks. `mapproof slam` models these and "
               "outliers in its refined map, so that its errors on the same log differ.";
}

std::optional<MeanEstimate> known(const MeanEstimate& estimate) {
  return estimate.values > 0 ? std::optional(estimate) : std::nullopt;
}

const RangeHistoryMap* map_of(const RangeHistoryStudy& study, Method method, bool squared) {
  for (const RangeHistoryMap& map : study.maps)
    if (map.setting && map.setting->method == method && map.squared == squared) return &map;
  return nullptr;
}

/// The setting of a method's maps, of which one may be missing: "KPCA, Gaussian, σ² = 35000;
/// squared ranges: σ² = 10⁷" where they differ.
std::string history_label(const RangeHistoryMap* range, const RangeHistoryMap* squared) {
  std::string text = label(range != nullptr ? *range->setting : *squared->setting);
  if (range != nullptr && squared != nullptr && *range->setting != *squared->setting)
    text += "; squared ranges: " + parameter_text(*squared->setting);
  return text;
}

void add_score(const RangeHistoryMap* map, Row& row) {
  const bool scored = map != nullptr && map->score;
  row.cells.push_back(scored ? Cell{NumberCell{map->score->mpe_all_fitted_m, 4}} : MissingCell{});
  row.cells.push_back(scored ? Cell{NumberCell{map->score->moe_unmirrored_percent, kMoeDecimals}}
                             : MissingCell{});
}

/// Decimals that give the shortest time two significant digits; at most 3 of seconds, 1 of smaller
/// units.
int time_decimals(const ScaledUnit& unit, double least_s) {
  if (!std::isfinite(least_s)) return 0;
  const int most = unit.unit == "s" ? 3 : 1;
  const int power = static_cast<int>(std::floor(std::log10(unit.factor * least_s)));
  return std::clamp(1 - power, 0, most);
}

}  // namespace

Table slam_error_table(std::string id, std::string caption, std::span<const SlamRun* const> runs) {
  const std::string group = "Position error";
  Table table{std::move(id), std::move(caption), {}, {}, {}};
  table.columns = {
      {"Data set", "", "", ""},
      {"Method", "", "", ""},
      {"Given", "", "", "Landmarks whose true positions the method was given."},
      {"Alignment", "", "", "Of the path to the ground truth, before its error was computed."},
      {"Mean", "m", group, "Over the full path."},
      {"RMSE", "m", group, "Over the full path."},
      {"Last 10 %", "m", group, "Mean over the last tenth of the path."},
      {"Best 10 %", "m", group, "Least mean over a tenth of the path in one piece."},
      {"Worst 10 %", "m", group, "Greatest mean over a tenth of the path in one piece."},
      {"Landmarks", "m", "", "Mean error of the landmarks, under the same alignment."},
      {"Range scale", "", "", "Measured ranges over distances, as estimated."}};
  for (const SlamRun* run : runs) {
    const SlamRecord* best = best_rigid(*run);
    for (const SlamRecord& record : run->records) {
      table.rows.push_back(error_row(*run, record));
      table.rows.back().marked = &record == best;
    }
  }
  table.notes = {
      "An error means nothing without its alignment. Unaligned: compared as it came, tied to the "
      "ground truth by known landmarks or by the start. Rigid: after the best rotation and "
      "translation, "
      "no "
      "scale."};
  if (std::ranges::any_of(table.rows, &Row::marked))
    table.notes.emplace_back("Marked: the least mean of a data set among rigidly aligned paths.");
  if (std::string model = model_words(runs); !model.empty())
    table.notes.push_back(std::move(model));
  return table;
}

std::optional<Table> slam_alignment_table(std::span<const SlamRun* const> runs) {
  Table table;
  table.id = "slam-alignments";
  table.caption = "The same paths under other alignments";
  table.columns = {{"Data set", "", "", ""}, {"Method", "", "", ""}, {"Alignment", "", "", ""},
                   {"Mean", "m", "", ""},    {"RMSE", "m", "", ""},  {"Landmarks", "m", "", ""}};
  for (const SlamRun* run : runs)
    for (const SlamRecord& record : run->records)
      for (std::size_t i = 1; i < record.errors.size(); ++i) {
        const TrajectoryError& error = record.errors[i];
        table.rows.push_back(
            {{TextCell{title_of(*run), Emphasis::kData}, TextCell{method_label(record.method)},
              TextCell{alignment_words(error.alignment)}, NumberCell{error.mean_m, 3},
              NumberCell{error.rmse_m, 3}, optional_cell(error.landmarks_m, 3)},
             record_id(*run, record),
             false});
      }
  if (table.rows.empty()) return std::nullopt;
  return table;
}

Table slam_drive_table(std::span<const SlamRun* const> runs) {
  const bool published =
      std::ranges::any_of(runs, [](const SlamRun* run) { return run->published.has_value(); });
  Table table;
  table.id = "slam-drives";
  table.caption = "What was recorded";
  table.columns = {{"Data set", "", "", ""},
                   {"Landmarks", "", "", ""},
                   {"Length", "km", "", "Of the true path, or of the odometry without one."},
                   {"Poses", "", "", "Of the true path, or of the odometry without one."},
                   {"Range measurements", "", "", ""}};
  if (published)
    for (const char* title : {"Length", "Poses", "Range measurements"})
      table.columns.push_back({title, title[0] == 'L' ? "km" : "", "Paper", ""});
  for (const SlamRun* run : runs) {
    const RangeLog& log = run->log;
    const auto length = length_m(log);
    const auto poses = log.ground_truth ? log.ground_truth->size() : std::ssize(log.odometry) + 1;
    Row row;
    row.source = run->id;
    row.cells = {TextCell{title_of(*run), Emphasis::kData},
                 count_cell(static_cast<double>(log.landmarks.size())),
                 length ? Cell{NumberCell{*length / 1e3, 2}} : Cell{MissingCell{}},
                 count_cell(static_cast<double>(poses)),
                 count_cell(static_cast<double>(log.ranges.size()))};
    if (published && run->published) {
      row.cells.emplace_back(NumberCell{run->published->length_km, 1});
      row.cells.push_back(count_cell(static_cast<double>(run->published->poses)));
      row.cells.push_back(count_cell(static_cast<double>(run->published->measurements)));
    } else if (published) {
      row.cells.insert(row.cells.end(), 3, MissingCell{});
    }
    table.rows.push_back(std::move(row));
  }
  return table;
}

std::optional<Table> slam_landmark_table(const SlamRun& run) {
  const SlamRecord* record = mapped_record(run);
  if (record == nullptr) return std::nullopt;
  const SlamEstimate& estimate = record->estimate;
  const auto& ground_truth = run.log.true_landmarks;
  const int decimals = position_decimals(estimate.landmarks_m);
  const bool has_covariances = std::ssize(estimate.landmark_cov_m2) == estimate.landmarks_m.rows();
  Table table;
  table.id = "slam-landmarks-" + run.id;
  table.caption = fmt::format("Landmarks, {}", info(record->method).label);
  table.columns = {
      {"Landmark", "", "", ""}, {"x", "m", "Map", "", false}, {"y", "m", "Map", "", false}};
  if (has_covariances) {
    table.columns.push_back({"x", "m", "Standard deviation", ""});
    table.columns.push_back({"y", "m", "Standard deviation", ""});
  }
  if (ground_truth) {
    table.columns.push_back({"x", "m", "Ground truth", "", false});
    table.columns.push_back({"y", "m", "Ground truth", "", false});
    table.columns.push_back({"Error", "m", "", "Distance from the true position."});
  }
  for (Index i = 0; i < estimate.landmarks_m.rows(); ++i) {
    Row row;
    row.source = record_id(run, *record);
    row.cells = {TextCell{run.log.landmarks[i], Emphasis::kData},
                 position_cell(estimate.landmarks_m(i, 0), decimals),
                 position_cell(estimate.landmarks_m(i, 1), decimals)};
    if (has_covariances)
      for (Index axis = 0; axis < 2; ++axis)
        row.cells.emplace_back(NumberCell{std::sqrt(estimate.landmark_cov_m2[i](axis, axis)), 3});
    if (ground_truth) {
      for (Index axis = 0; axis < 2; ++axis)
        row.cells.push_back(position_cell((*ground_truth)(i, axis), decimals));
      row.cells.emplace_back(
          NumberCell{(estimate.landmarks_m.row(i) - ground_truth->row(i)).norm(), 3});
    }
    table.rows.push_back(std::move(row));
  }
  return table;
}

std::optional<Table> slam_seconds_table(const SlamStudy& study,
                                        std::span<const SlamTiming> timings) {
  if (timings.empty()) return std::nullopt;
  Table table;
  table.id = "slam-seconds";
  table.caption = "How long the methods took (varies)";
  double least = kInfinity, greatest = 0.0;
  for (const SlamTiming& timing : timings) {
    if (timing.seconds > 0.0) least = std::min(least, timing.seconds);
    greatest = std::max(greatest, timing.seconds);
  }
  const ScaledUnit unit = scaled_unit("s", greatest);
  const int decimals = time_decimals(unit, least);
  table.columns = {{"Data set", "", "", ""}, {"Method", "", "", ""}, {"Time", unit.unit, "", ""}};
  for (const SlamTiming& timing : timings) {
    const auto run = std::ranges::find(study.runs, timing.run, &SlamRun::id);
    table.rows.push_back(
        {{TextCell{run == study.runs.end() ? timing.run : title_of(*run), Emphasis::kData},
          TextCell{method_label(timing.method)},
          NumberCell{.value = unit.factor * timing.seconds,
                     .decimals = decimals,
                     .least = std::pow(10.0, -decimals)}},
         "",
         false});
  }
  table.notes = {
      "A method's own time, without the choice of windows and without the estimate it "
      "starts from.",
      "Times differ from one start of the program to the next and are not part of any comparison."};
  if (std::ranges::any_of(study.runs, [](const SlamRun& run) { return run.fit.has_value(); }))
    table.notes.insert(table.notes.begin() + 1,
                       fmt::format("Where the fit was tested, {} also estimates the noise, which "
                                   "the other methods take from it.",
                                   bracketed(info(SlamMethod::kRefined).label)));
  return table;
}

Table slam_convergence_table(std::span<const ConvergenceCurve> curves) {
  const std::string model = "Error of \u0108", landmarks = "Landmarks", positions = "Positions",
                    angle = "Subspace angle";
  Table table;
  table.id = "slam-convergence";
  table.caption = "Convergence with the number of measurements";
  table.columns = {{"Noise", "", "", ""},
                   {"Measurements", "", "", "Landmarks times steps."},
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
  table.caption =
      fmt::format("Maps of {} from {} of ranges", counted(study.landmarks_m.rows(), "landmark"),
                  counted(study.steps, "step"));
  table.columns = {
      {"Method", "", "", ""},
      {"MPE", "m", "Ranges", "After the affine map that fits all landmarks best."},
      {"MOE", "%", "Ranges", "Landmark triples with the wrong orientation, up to a reflection."},
      {"MPE", "m", "Squared ranges", ""},
      {"MOE", "%", "Squared ranges", ""}};
  for (const MethodInfo& method : all_methods()) {
    const RangeHistoryMap* range = map_of(study, method.method, false);
    const RangeHistoryMap* squared = map_of(study, method.method, true);
    if (range == nullptr && squared == nullptr) continue;
    Row row{
        {TextCell{history_label(range, squared)}}, fmt::format("histories/{}", method.name), false};
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
  table.caption =
      fmt::format("{} in space from {} of ranges", counted(run.landmarks_m.rows(), "landmark"),
                  counted(run.positions_m.rows(), "step"));
  table.columns = {
      {"Known landmarks", "", "", ""},
      {"Landmarks", "m", "Mean error", ""},
      {"Positions", "m", "Mean error", ""},
      {"Alignment", "", "", "Before the errors were taken."},
      {"Range scale", "", "", "Measured range over distance, where it is identifiable."},
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
