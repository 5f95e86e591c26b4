#include "reports/sections/slam/slam_figures.hpp"

#include <algorithm>
#include <cctype>
#include <iterator>

#include <fmt/format.h>

#include "core/base/not_finite.hpp"
#include "core/base/text/words.hpp"
#include "render/figures/curves/convergence.hpp"
#include "render/figures/curves/refinement_starts.hpp"
#include "render/figures/curves/spectrum.hpp"
#include "render/figures/diagrams/fit.hpp"
#include "render/figures/maps/map_grid.hpp"
#include "render/figures/maps/path_map.hpp"
#include "render/figures/number_text.hpp"
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

/// The paths that one figure can show side by side: the paper's, and the refined one.
std::vector<SlamMethod> shown_methods(const SlamRun& run) {
  if (run.simulated) return {SlamMethod::kSpectralKnown, SlamMethod::kSpectral};
  const bool unknown = record_of(run, SlamMethod::kSpectral) != nullptr;
  return {SlamMethod::kDeadReckoning, unknown ? SlamMethod::kSpectral : SlamMethod::kSpectralKnown,
          SlamMethod::kRefined};
}

/// "Fig. 1A. " for "fig-1a"; empty for ids that are not the paper's.
std::string numbered(const std::string& id) {
  std::string number = paper_number(id);
  if (number.empty()) return "";
  number.back() = static_cast<char>(std::toupper(static_cast<unsigned char>(number.back())));
  return number + ". ";
}

/// How far a method's path is off: "0.19 m off"; empty without ground truth.
std::string off_words(const SlamRun& run, SlamMethod method) {
  const TrajectoryError* error = error_of(run, method);
  return error == nullptr || !std::isfinite(error->mean_m) ? ""
                                                           : error_text(error->mean_m, 2) + " off";
}

/// The error of the best path, and what it is compared with.
std::string path_title(const SlamRun& run) {
  const std::string name = run.simulated ? "Simulation" : title_of(run);
  for (const SlamMethod method :
       {SlamMethod::kRefined, SlamMethod::kSpectral, SlamMethod::kSpectralKnown}) {
    const std::string off = off_words(run, method);
    if (off.empty()) continue;
    const std::string plain = off_words(run, SlamMethod::kDeadReckoning);
    const auto length = length_m(run.log);
    return fmt::format("{}: the {} path is {}{}{}", name, info(method).label, off,
                       length ? fmt::format(" over {:.0f} m", *length) : "",
                       plain.empty() ? "" : ", dead reckoning " + plain);
  }
  return fmt::format("{}: {} from ranges", name,
                     counted(std::ssize(run.log.landmarks), "landmark"));
}

Figure path_figure(const SlamRun& run) {
  const std::string id = path_figure_id(run);
  const std::string title = path_title(run);
  return path_map_figure({id, numbered(id) + title, run, shown_methods(run)});
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
  const SingularValues& first = spec.panels.front();
  if (first.values.size() > first.rank && first.values[first.rank] > 0.0)
    spec.title =
        fmt::format("{}: singular value {} is {} times the next one", title_of(run), first.rank,
                    significant(first.values[first.rank - 1] / first.values[first.rank], 2));
  return singular_values_figure(spec);
}

/// How many starts end at the least cost.
std::string starts_words(const std::vector<RefinementStart>& starts) {
  constexpr double kSame = 1.01;  // Of the cost.
  double least = kInfinity;
  for (const RefinementStart& start : starts)
    if (start.cost < least) least = start.cost;
  const auto same = std::ranges::count_if(
      starts, [&](const RefinementStart& start) { return start.cost <= kSame * least; });
  return fmt::format("{} of {} end at the same, least cost", same,
                     counted(std::ssize(starts), "start"));
}

/// What is known of one run.
std::vector<Figure> run_figures(const SlamRun& run) {
  std::vector<Figure> figures;
  if (!run.records.empty()) figures.push_back(path_figure(run));
  if (auto spectrum = spectrum_figure_of(run)) figures.push_back(*std::move(spectrum));
  if (run.windows && !run.windows->lengths_s.empty())
    figures.push_back(
        window_curve_figure({"windows-" + run.id,
                             fmt::format("{}: windows of {} predict ranges best", title_of(run),
                                         format_duration(run.windows->chosen_s)),
                             *run.windows, run.id}));
  if (!run.starts.empty())
    figures.push_back(refinement_starts_figure(
        {"starts-" + run.id, title_of(run) + ": " + starts_words(run.starts), run.starts, run.id}));
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

/// The maps of ranges, or of squared ranges, with the spectral map last.
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
    }
    if (!any) continue;
    const auto error_of_map = [](const TitledMap& map) {
      const double error = map.map.score ? map.map.score->mpe_all_fitted_m : kNaN;
      return std::isnan(error) ? kInfinity : error;
    };
    const auto best = std::ranges::min_element(spec.maps, {}, error_of_map);
    if (std::isfinite(error_of_map(*best)))
      spec.title =
          fmt::format("On {} {} has the lowest error, {}", squared ? "squared ranges" : "ranges",
                      best->title, error_text(error_of_map(*best)));
    figures.push_back(map_wall_figure(spec));
  }
  return figures;
}

/// How the metric upgrade changed the states of one run, where that is known.
std::vector<Scene> run_scenes(const SlamRun& run) {
  if (!run.upgrade || !has_quadric_scene(*run.upgrade)) return {};
  return {quadric_scene({.id = "scene-quadric-" + run.id,
                         .title = "Metric upgrade, " + title_of(run),
                         .name = title_of(run),
                         .clouds = *run.upgrade,
                         .record_ids = {run.id}})};
}

/// What shows whether the data of a run fit its map.
std::vector<Figure> fit_figures(const SlamRun& run) {
  if (!run.fit) return {};
  std::vector<Figure> figures = {fit_figure(*run.fit, "fit-" + run.id, {run.id})};
  if (!run.fitted_ranges.empty())
    figures.push_back(fit_residuals_figure({.id = "fit-residuals-" + run.id,
                                            .title = "Residuals, " + title_of(run),
                                            .ranges = run.fitted_ranges,
                                            .landmarks = run.log.landmarks,
                                            .verdict = verdict_text(*run.fit),
                                            .is_alarm = run.fit->verdict != FitVerdict::kFits,
                                            .record_id = run.id}));
  return figures;
}

}  // namespace

std::string slam_run_group(const SlamRun& run) { return "slam-run-" + run.id; }

std::string slam_fit_group(const SlamRun& run) { return "slam-fit-" + run.id; }

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
                      .title = "Landmarks in space, from ranges alone",
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
        "Seconds differ from one run of the program to the next.",
        {factorization_cost_figure("factorization-cost", timings.factorization)});
  return figures;
}

}  // namespace mapproof
