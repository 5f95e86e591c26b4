#include "reports/sections/slam/slam_figures.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <iterator>

#include <fmt/format.h>

#include "core/base/not_finite.hpp"
#include "core/base/text/number_text.hpp"
#include "core/base/text/words.hpp"
#include "core/model/slam/method_record.hpp"
#include "render/figures/curves/convergence.hpp"
#include "render/figures/curves/refinement_starts.hpp"
#include "render/figures/curves/spectrum.hpp"
#include "render/figures/diagrams/fit.hpp"
#include "render/figures/maps/map_grid.hpp"
#include "render/figures/maps/path_map.hpp"
#include "render/figures/maps/path_styles.hpp"
#include "render/scene/drive_scene.hpp"
#include "render/scene/quadric_scene.hpp"
#include "render/scene/space_scene.hpp"
#include "reports/model/format.hpp"
#include "reports/sections/figures/method_styles.hpp"
#include "reports/sections/fit_section.hpp"
#include "reports/sections/fit_text.hpp"
#include "reports/sections/slam/slam_text.hpp"
#include "reports/sections/wording.hpp"

namespace mapproof {
namespace {

/// The paths that one figure can show, of which the last is the finding: those of the paper in its
/// figures, else the refined one. Lines that lie on each other cannot be distinguished.
std::vector<SlamMethod> shown_methods(const SlamRun& run) {
  const bool unknown = record_of(run, SlamMethod::kSpectral) != nullptr;
  const SlamMethod spectral = unknown ? SlamMethod::kSpectral : SlamMethod::kSpectralKnown;
  if (run.simulated) return {spectral};
  const SlamRecord* refined = record_of(run, SlamMethod::kRefined);
  const bool is_refined =
      run.figure.empty() && refined != nullptr && refined->estimate.path.size() > 0;
  return {SlamMethod::kDeadReckoning, is_refined ? SlamMethod::kRefined : spectral};
}

/// The methods of a drive, the one that is shown first.
constexpr std::array kBestFirst = {SlamMethod::kRefined, SlamMethod::kSpectral,
                                   SlamMethod::kSpectralKnown};

/// "Fig. 1A. " for "fig-1a"; empty for ids that are not the paper's.
std::string numbered(const std::string& id) {
  std::string number = paper_number(id);
  if (number.empty()) return "";
  number.back() = static_cast<char>(std::toupper(static_cast<unsigned char>(number.back())));
  return number + ". ";
}

/// The error of the path that is shown, and what it is compared with, each with its alignment:
/// "Plaza 1: the path is 0.411 m off over 2.0 km (rigid), dead reckoning 9.83 m (unaligned)".
std::string path_title(const SlamRun& run, SlamMethod shown) {
  const std::string name = run.simulated ? "Simulation" : title_of(run);
  const TrajectoryError* off = error_of(run, shown);
  if (off == nullptr || !std::isfinite(off->mean_m))
    return fmt::format("{}: {} from ranges", name,
                       counted(std::ssize(run.log.landmarks), "landmark"));
  const auto length = run.simulated ? std::nullopt : length_m(run.log);
  const std::string title =
      fmt::format("{}: the path is {} off{} ({})", name, error_text(off->mean_m),
                  length ? " over " + length_text(*length) : "", alignment_words(off->alignment));
  for (const auto& [method, words] :
       {std::pair{SlamMethod::kDeadReckoning, "dead reckoning"},
        std::pair{SlamMethod::kSpectralKnown, "with known landmarks"}})
    if (const TrajectoryError* error = error_of(run, method);
        method != shown && error != nullptr && std::isfinite(error->mean_m))
      return title + fmt::format(", {} {} ({})", words, error_text(error->mean_m),
                                 alignment_words(error->alignment));
  return title;
}

/// The same path in the 3-D figure, which shows where its error is.
std::string drive_title(const SlamRun& run, SlamMethod shown) {
  const TrajectoryError* error = error_of(run, shown);
  return error == nullptr || !std::isfinite(error->mean_m)
             ? fmt::format("{}, in 3-D: the path coloured by time", title_of(run))
             : fmt::format("{}, in 3-D: the path coloured by its error, {} on average",
                           title_of(run), error_text(error->mean_m));
}

Figure path_figure(const SlamRun& run) {
  const std::string id = path_figure_id(run);
  const std::vector<SlamMethod> shown = shown_methods(run);
  return path_map_figure({id, numbered(id) + path_title(run, shown.back()), run, shown});
}

/// One panel per rank: known landmarks change nothing about the factorised matrix.
std::optional<Figure> spectrum_figure_of(const SlamRun& run) {
  SingularValuesSpec spec;
  spec.id = "spectrum-" + run.id;
  spec.title = "Singular values of the squared ranges, " + title_of(run);
  const auto add = [&](std::size_t rank, std::initializer_list<SlamMethod> methods) {
    for (const SlamMethod method : methods) {
      const SlamRecord* record = record_of(run, method);
      if (record == nullptr || record->estimate.singular_values.size() == 0) continue;
      const Eigen::VectorXd& values = record->estimate.singular_values;
      spec.panels.push_back({fmt::format("{}-D", rank),
                             {values.data(), values.data() + values.size()},
                             rank,
                             record->estimate.noise_level});
      spec.record_ids.push_back(record_id(run, *record));
      return;
    }
  };
  add(4, {SlamMethod::kSpectral, SlamMethod::kSpectralKnown});
  add(7, {SlamMethod::kSpectral7, SlamMethod::kSpectralKnown7});
  if (spec.panels.empty()) return std::nullopt;
  // What the method rests on: after its rank singular values are small.
  for (const SingularValues& panel : spec.panels) {
    const bool has_next = panel.values.size() > panel.rank && panel.values[panel.rank] > 0.0;
    if (!has_next && !(panel.noise_level && *panel.noise_level > 0.0)) continue;
    const double next = has_next ? panel.values[panel.rank] : *panel.noise_level;
    spec.title = fmt::format("{}: singular value {} is {} times the {}", title_of(run), panel.rank,
                             significant(panel.values[panel.rank - 1] / next, 2),
                             has_next ? "next one" : "noise floor");
    break;
  }
  return singular_values_figure(spec);
}

/// Of two ends, the sentence on the page says all.
constexpr std::size_t kFewestEnds = 3;

/// What the chosen windows predict. They need not have the least error: others may cover less.
std::string windows_title(const SlamRun& run) {
  const WindowCurve& windows = *run.windows;
  const auto chosen = std::ranges::find(windows.lengths_s, windows.chosen_s);
  const double error_m =
      chosen == windows.lengths_s.end()
          ? kNaN
          : windows.held_out_m[static_cast<std::size_t>(chosen - windows.lengths_s.begin())];
  const std::string length = seconds_text(windows.chosen_s);
  return std::isfinite(error_m) ? fmt::format("{}: windows of {} predict other ranges {} off",
                                              title_of(run), length, error_text(error_m))
                                : fmt::format("{}: windows of {}", title_of(run), length);
}

/// What is known of one run.
std::vector<Figure> run_figures(const SlamRun& run) {
  std::vector<Figure> figures;
  if (!run.records.empty()) figures.push_back(path_figure(run));
  if (auto spectrum = spectrum_figure_of(run)) figures.push_back(*std::move(spectrum));
  if (run.windows && !run.windows->lengths_s.empty())
    figures.push_back(
        window_curve_figure({"windows-" + run.id, windows_title(run), *run.windows, run.id}));
  if (const StartEnds ends = start_ends(run.starts); ends.different >= kFewestEnds)
    figures.push_back(refinement_starts_figure(
        {"starts-" + run.id,
         fmt::format("{}: {} of {} end at the same, least cost", title_of(run), ends.at_least,
                     counted(std::ssize(run.starts), "start")),
         run.starts, run.id}));
  return figures;
}

std::vector<Figure> convergence_figures(const SlamStudy& study) {
  std::vector<Figure> figures;
  if (study.convergence.empty()) return figures;
  const ConvergenceCurve& first = study.convergence.front();
  const auto any = [&](MeanEstimate ConvergencePoint::*what) {
    return std::ranges::any_of(first.points,
                               [&](const ConvergencePoint& p) { return (p.*what).values > 0; });
  };
  const std::string id = is_of_paper(study) ? "fig-1b" : "convergence-simulation";
  figures.push_back(convergence_figure(id, first));
  const double slope = convergence_slope(first);
  figures.back().title =
      numbered(id) +
      (std::isfinite(slope)
           ? fmt::format(
                 "The error falls with the power {} of the measurements (theory: \u22121/2)",
                 significant(slope, 2))
           : figures.back().title);
  figures.back().caption += variant_words(study);
  if (any(&ConvergencePoint::sine))
    figures.push_back(subspace_angle_figure("angle-simulation", first));
  if (any(&ConvergencePoint::positions_m))
    figures.push_back(positions_figure("positions-simulation", first));
  if (study.convergence.size() > 1)
    figures.push_back(noise_models_figure("noise-simulation", study.convergence));
  return figures;
}

TitledMap titled_map(const RangeHistoryStudy& study, const RangeHistoryMap& map) {
  TitledMap titled;
  titled.title = map.setting ? short_label(*map.setting) : "Spectral";
  MapRecord& record = titled.map;
  record.id = fmt::format("histories/{}/{}", map.squared ? "squared" : "range",
                          map.setting ? info(map.setting->method).name : "spectral");
  if (map.setting)
    record.origin = FromSensor{Sensor::kRange, *map.setting};
  else
    record.origin = FromRanges{};
  record.step = study.steps;
  const Eigen::Index rows = study.landmarks_m.rows();
  for (Eigen::Index i = 0; i < rows; ++i) record.names.push_back(fmt::format("{}", i + 1));
  record.estimate =
      map.positions_m.rows() == rows ? map.positions_m : Points::Constant(rows, 2, kNaN);
  record.ground_truth_m = study.landmarks_m;
  record.score = map.score;
  return titled;
}

/// The maps of ranges, or of squared ranges, and the spectral map, which is always of squared ones,
/// the best first.
std::vector<Figure> history_figures(const RangeHistoryStudy& study) {
  std::vector<Figure> figures;
  for (const bool squared : {false, true}) {
    MapGridSpec spec;
    spec.id = squared ? "lfmdr-squared-range" : "lfmdr-range";
    spec.title = fmt::format("Mapping methods on {} histories, and the spectral map",
                             squared ? "squared-range" : "range");
    bool any = false;
    for (const RangeHistoryMap& map : study.maps) {
      if (map.setting && map.squared != squared) continue;
      any = any || map.setting;
      spec.maps.push_back(titled_map(study, map));
      if (map.squared != squared) spec.maps.back().title += ", squared ranges";
    }
    if (!any) continue;
    const auto error_of_map = [](const TitledMap& map) {
      const double error = map.map.score ? map.map.score->mpe_all_fitted_m : kNaN;
      return std::isnan(error) ? kInfinity : error;
    };
    std::ranges::stable_sort(spec.maps, {}, error_of_map);
    const TitledMap& best = *std::ranges::find_if(spec.maps, [&](const TitledMap& map) {
      return squared || std::holds_alternative<FromSensor>(map.map.origin);
    });
    if (std::isfinite(error_of_map(best)))
      spec.title =
          fmt::format("On {} {} has the lowest error, {}", squared ? "squared ranges" : "ranges",
                      best.title, error_text(error_of_map(best)));
    figures.push_back(map_wall_figure(spec));
  }
  return figures;
}

/// The drive from above by the best method that has a path, and how the metric upgrade changed the
/// states, where these are known.
std::vector<Scene> run_scenes(const SlamRun& run) {
  std::vector<Scene> scenes;
  for (const SlamMethod method : kBestFirst) {
    if (run.simulated || !has_drive_scene(run, method)) continue;
    scenes.push_back(drive_scene({.id = "scene-drive-" + run.id,
                                  .title = drive_title(run, method),
                                  .run = run,
                                  .method = method,
                                  .record_ids = {run.id}}));
    break;
  }
  if (run.upgrade && has_quadric_scene(*run.upgrade))
    scenes.push_back(quadric_scene(
        {.id = "scene-quadric-" + run.id,
         .title = fmt::format(
             "{}: the states of the path are {} % of their extent off the fitted quadric",
             title_of(run), significant(100.0 * quadric_deviation(run.upgrade->before), 2)),
         .name = title_of(run),
         .clouds = *run.upgrade,
         .record_ids = {run.id}}));
  return scenes;
}

/// The errors of landmarks in space, with and without known ones.
std::string space_title(const SpaceRun& run) {
  std::string title;
  for (const SpaceRecord& record : run.records)
    if (record.landmarks_error_m)
      title += fmt::format("{}{} off with {} known", title.empty() ? "Landmarks in space: " : ", ",
                           error_text(*record.landmarks_error_m),
                           record.knows_landmarks ? fmt::format("{}", run.known.size()) : "none");
  return title.empty() ? "Landmarks in space, from ranges alone" : title;
}

/// What shows whether the data of a run fit its map.
std::vector<Figure> fit_figures(const SlamRun& run) {
  if (!run.fit) return {};
  std::vector<Figure> figures = {fit_figure(*run.fit, "fit-" + run.id, {run.id})};
  if (!run.fitted_ranges.empty())
    figures.push_back(fit_residuals_figure(
        {.id = "fit-residuals-" + run.id,
         .title = fmt::format("{}: {}", title_of(run), far_residuals_text(run.fitted_ranges)),
         .ranges = run.fitted_ranges,
         .landmarks = run.log.landmarks,
         .verdict = verdict_text(*run.fit),
         .is_alarm = run.fit->verdict != FitVerdict::kFits,
         .record_id = run.id}));
  return figures;
}

}  // namespace

std::string slam_run_group(const SlamRun& run) { return kSlamRun + run.id; }

std::string slam_fit_group(const SlamRun& run) { return kSlamFit + run.id; }

StudyFigures slam_figures(const SlamStudy& study, const SlamTimings& timings) {
  StudyFigures figures;
  const auto add = [&](std::string id, std::string title, std::string words,
                       std::vector<Figure> group, std::vector<Scene> scenes = {}) {
    if (!group.empty() || !scenes.empty())
      figures.groups.push_back(
          {std::move(id), std::move(title), std::move(words), std::move(group), std::move(scenes)});
  };
  for (const SlamRun& run : study.runs)
    add(slam_fit_group(run), "Range-only SLAM: do the data fit the map? " + title_of(run), "",
        fit_figures(run));
  std::vector<Figure> simulation;
  std::vector<Scene> upgrades;
  for (const SlamRun& run : study.runs)
    if (run.simulated) {
      std::ranges::move(run_figures(run), std::back_inserter(simulation));
      std::ranges::move(run_scenes(run), std::back_inserter(upgrades));
    }
  std::ranges::move(convergence_figures(study), std::back_inserter(simulation));
  add(kSlamSimulation, "Range-only SLAM: simulation",
      "A simulated robot among landmarks; every step hears all of them. Squared ranges factor into "
      "a map and a path of rank 4.",
      std::move(simulation), std::move(upgrades));
  for (const SlamRun& run : study.runs)
    if (!run.simulated)
      add(slam_run_group(run), "Range-only SLAM: " + title_of(run),
          "Paths and landmarks as the methods recovered them, and what they rest on.",
          run_figures(run), run_scenes(run));
  if (study.space && has_space_scene(*study.space))
    add(kSlamSpace, "Range-only SLAM: landmarks in space",
        "A simulated flight over landmarks at various heights. In space squared ranges have rank "
        "5, and the same factorisation, regression and metric upgrade hold.",
        {},
        {space_scene({.id = "scene-space",
                      .title = space_title(*study.space),
                      .run = *study.space,
                      .record_ids = {"space"}})});
  if (study.histories)
    add(kSlamHistories, "Range-only SLAM: mapping without a path",
        "The mapping methods on the ranges and the squared ranges of one simulated world, each by "
        "the affine map that fits all landmarks best, compared with the spectral map of the same "
        "data.",
        history_figures(*study.histories));
  if (!timings.factorization.empty())
    add(kSlamCost, "Range-only SLAM: cost",
        "Seconds differ from one start of the program to the next.",
        {factorization_cost_figure("factorization-cost", timings.factorization)});
  return figures;
}

}  // namespace mapproof
