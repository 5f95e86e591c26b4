#include "reports/sections/figures/figure_builders.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <fmt/format.h>

#include "core/base/not_finite.hpp"
#include "core/base/text/number_text.hpp"
#include "core/base/text/words.hpp"
#include "render/figures/maps/error_map.hpp"
#include "render/figures/maps/map.hpp"
#include "render/figures/maps/map_grid.hpp"
#include "render/figures/maps/scatter_map.hpp"
#include "reports/sections/figures/map_scenes.hpp"
#include "reports/sections/figures/method_styles.hpp"
#include "reports/sections/wording.hpp"

namespace mapproof {
namespace {

constexpr std::size_t kWallColumns = 5;

/// "layout 1, pose 2".
std::string words_of(const RunId& run) {
  return fmt::format("layout {}, pose {}", run.layout, run.pose);
}

/// The summary of one setting at the last checkpoint; empty if it was not tried or never scored.
std::optional<SettingSummary> summary_of(const Study& study, const SensorStudy& sensor,
                                         const MethodSetting& setting) {
  for (const SettingSummary& summary : summarize(study, sensor, last_step(sensor)))
    if (summary.setting == setting && summary.scored > 0) return summary;
  return std::nullopt;
}

/// "the median run errs by 0.18 m, the paper's map by 0.14 m"; without scores what is shown.
std::string pair_finding(const MapRecord& nearest, const MapRecord& median, double published_m) {
  if (!nearest.score || !median.score) return "the run nearest to the paper, and the median run";
  if (&nearest == &median)
    return fmt::format("the median run errs by {} (paper: {})", error_text(median.score->mpe_m),
                       error_text(published_m));
  return fmt::format("the median run errs by {}, the run nearest to the paper by {} (paper: {})",
                     error_text(median.score->mpe_m), error_text(nearest.score->mpe_m),
                     error_text(published_m));
}

void add_pair(FigureSource& source, const PaperFigure& wanted, std::vector<Figure>& figures) {
  const Study& study = source.study();
  const SensorStudy* sensor = find_sensor(study.experiment, wanted.sensor);
  if (sensor == nullptr || !wanted.example) return;
  const auto summary = summary_of(study, *sensor, wanted.example->setting);
  if (!summary) return;
  const auto nearest = nearest_run(study, *summary, wanted.example->mpe_m);
  const auto median = median_run(study, *summary);
  if (!nearest || !median) return;
  const auto map_of = [&](const RunId& run) {
    return source.map(run, wanted.sensor, summary->setting, summary->step);
  };
  const MapRecord* first = map_of(*nearest);
  const MapRecord* second = map_of(*median);
  if (first == nullptr || second == nullptr || first->frame != second->frame) return;
  MapGridSpec spec{
      .id = wanted.id,
      .title = fmt::format("{}, {}: {}", title_of(wanted.sensor), short_label(summary->setting),
                           pair_finding(*first, *second, wanted.example->mpe_m)),
      .maps = {{fmt::format("nearest to the paper\n{}", words_of(*nearest)), *first},
               {fmt::format("median run\n{}", words_of(*median)), *second}}};
  if (first == second) {
    spec.maps.pop_back();
    spec.maps.front().title =
        fmt::format("median run, nearest to the paper\n{}", words_of(*median));
  }
  Figure figure = map_pair_figure(spec);
  figure.caption += fmt::format(
      " The paper's example has MPE {:.4g} m and MOE {:.4g} %; the run drawn {}was "
      "chosen by that number, as the one of {} whose MPE is nearest to it: that it is near says "
      "nothing about the method. {}",
      wanted.example->mpe_m, wanted.example->moe_percent, first == second ? "" : "on the left ",
      summary->scored,
      first == second ? "It is the median run, too." : "The run on the right is the median one.");
  figures.push_back(std::move(figure));
}

/// Whether each of the maps has an error somewhere.
bool has_errors(const std::vector<TitledMap>& maps) {
  return std::ranges::all_of(maps, [](const TitledMap& one) {
    return one.map.ground_truth_m && one.map.ground_truth_m->rows() == one.map.estimate.rows() &&
           (*one.map.ground_truth_m - one.map.estimate).rowwise().norm().array().isFinite().any();
  });
}

/// "0.058 m to 0.45 m"; empty unless all have a score.
std::string span_of_errors(const std::vector<TitledMap>& maps) {
  const auto mpe_of = [](const TitledMap& one) {
    return one.map.score ? one.map.score->mpe_m : kNaN;
  };
  if (!std::ranges::all_of(maps, [&](const TitledMap& one) { return std::isfinite(mpe_of(one)); }))
    return "";
  const auto [least, most] = std::ranges::minmax(maps, {}, mpe_of);
  return fmt::format("{} to {}", error_text(mpe_of(least)), error_text(mpe_of(most)));
}

/// The mean errors of all maps in the half of the floor that is nearer to the walls, and in the
/// other one.
std::string where_wrong(const std::vector<TitledMap>& maps, double side_m) {
  const double outer_m = 0.5 * (1.0 - 1.0 / std::numbers::sqrt2) * side_m;
  double sums[2] = {0.0, 0.0}, counts[2] = {0.0, 0.0};
  for (const TitledMap& one : maps) {
    const Points& ground_truth_m = *one.map.ground_truth_m;
    const Eigen::VectorXd errors_m = (ground_truth_m - one.map.estimate).rowwise().norm();
    for (Eigen::Index i = 0; i < errors_m.size(); ++i) {
      if (!std::isfinite(errors_m(i))) continue;
      const double wall_m =
          std::min(ground_truth_m.row(i).minCoeff(), side_m - ground_truth_m.row(i).maxCoeff());
      const std::size_t part = wall_m < outer_m ? 0 : 1;
      sums[part] += errors_m(i);
      counts[part] += 1.0;
    }
  }
  if (counts[0] == 0.0 || counts[1] == 0.0) return "where the maps are wrong";
  return fmt::format(
      "the mean error of {} is {} in the outer half of the floor, {} in the inner one",
      counted(maps.size(), "method"), error_text(sums[0] / counts[0]),
      error_text(sums[1] / counts[1]));
}

/// All methods on one run, the best first: the median run of the best method.
void add_wall(FigureSource& source, const SensorStudy& sensor, std::vector<Figure>& figures) {
  const std::vector<SettingSummary> methods = source.best(sensor);
  const SettingSummary* best = best_of(methods);
  const auto run = best == nullptr ? std::nullopt : median_run(source.study(), *best);
  if (!run) return;
  MapGridSpec spec{.id = fmt::format("maps-{}", name(sensor.sensor.sensor)),
                   .title = fmt::format("{}: all methods on {}, the best first",
                                        title_of(sensor.sensor.sensor), words_of(*run)),
                   .maps = {}};
  for (const SettingSummary& method : methods)
    if (const MapRecord* map = source.map(*run, method.sensor, method.setting, method.step);
        map != nullptr && map->frame == Frame::kGroundTruth)
      spec.maps.push_back({short_label(method.setting), *map});
  if (spec.maps.size() < 2) return;
  // By what the panels print.
  std::ranges::stable_sort(spec.maps, {},
                           [](const TitledMap& one) { return error_or_infinity(one.map); });
  if (const std::string errors = span_of_errors(spec.maps); !errors.empty())
    spec.title = fmt::format("{}, {}: MPE {}, the best first", title_of(sensor.sensor.sensor),
                             words_of(*run), errors);
  Figure figure = map_wall_figure(spec);
  figure.columns = kWallColumns;
  figures.push_back(std::move(figure));
  const double side_m = source.study().experiment.world.side_m;
  if (!has_errors(spec.maps) || !(side_m > 0.0)) return;
  Figure errors =
      error_map_figure({.id = fmt::format("errors-{}", name(sensor.sensor.sensor)),
                        .title = fmt::format("{}, {}: {}", title_of(sensor.sensor.sensor),
                                             words_of(*run), where_wrong(spec.maps, side_m)),
                        .side_m = side_m,
                        .maps = spec.maps});
  errors.columns = kWallColumns;
  figures.push_back(std::move(errors));
}

/// The method of least mean MPE that has maps to show.
std::optional<SettingSummary> best_setting(FigureSource& source, const SensorStudy& sensor) {
  const std::vector<SettingSummary> all = source.best(sensor);
  if (const SettingSummary* best = best_of(all)) return *best;
  return std::nullopt;
}

void add_film(FigureSource& source, const SensorStudy& sensor, const SettingSummary& best,
              std::vector<Figure>& figures) {
  const auto run = median_run(source.study(), best);
  if (!run || sensor.checkpoints.size() < 2) return;
  MapGridSpec spec{.id = fmt::format("forming-{}", name(best.sensor)),
                   .title = fmt::format("{}, {}: a map forming, {}", title_of(best.sensor),
                                        label(best.setting), words_of(*run)),
                   .maps = {}};
  for (const int step : sensor.checkpoints)
    if (const MapRecord* map = source.map(*run, best.sensor, best.setting, step);
        map != nullptr && map->frame == Frame::kGroundTruth)
      spec.maps.push_back({fmt::format("{} steps", step), *map});
  if (spec.maps.empty()) return;
  std::vector<MapRecord> maps;
  for (const auto& panel : spec.maps) maps.push_back(panel.map);
  if (const std::string errors = errors_over_steps(maps); maps.size() > 1 && !errors.empty())
    spec.title = fmt::format("{}, {}, {}: {}", title_of(best.sensor), short_label(best.setting),
                             words_of(*run), errors);
  figures.push_back(film_strip_figure(spec));
}

void add_ellipses(FigureSource& source, const SettingSummary& best, std::vector<Figure>& figures) {
  const Study& study = source.study();
  const auto median = median_run(study, best);
  if (!median) return;
  EllipseMapSpec spec{
      .id = fmt::format("scatter-{}", name(best.sensor)),
      .title = fmt::format("{}, {}: scatter over the poses of layout {}", title_of(best.sensor),
                           label(best.setting), median->layout),
      .names = {},
      .ground_truth_m = {},
      .estimates_m = {},
      .anchors = {},
      .record_ids = {}};
  for (const Run& run : study.runs) {
    if (run.id.layout != median->layout) continue;
    const MapRecord* map = source.map(run.id, best.sensor, best.setting, best.step);
    if (map == nullptr || map->frame != Frame::kGroundTruth || !map->ground_truth_m) continue;
    spec.names = map->names;
    spec.ground_truth_m = *map->ground_truth_m;
    spec.anchors = map->anchors;
    spec.estimates_m.push_back(map->estimate);
    spec.record_ids.push_back(map->id);
  }
  if (spec.estimates_m.size() < 3) return;
  if (const std::string finding = scatter_finding(spec); !finding.empty())
    spec.title = fmt::format("{}, {}, layout {}: {}", title_of(best.sensor),
                             short_label(best.setting), median->layout, finding);
  figures.push_back(ellipse_map_figure(spec));
}

}  // namespace

std::string errors_over_steps(std::span<const MapRecord> maps) {
  const MapRecord &first = maps.front(), &last = maps.back();
  if (!first.score || !last.score) return "";
  const auto off = [](const MapRecord& map) { return map.score ? map.score->mpe_m : 0.0; };
  const MapRecord& worst = *std::ranges::max_element(maps, {}, off);
  const bool is_between = off(worst) > off(first) && off(worst) > off(last);
  return fmt::format("{} off after {} steps, {}{} after {}", error_text(off(first)), first.step,
                     is_between ? fmt::format("{} after {}, ", error_text(off(worst)), worst.step)
                                : "",
                     error_text(off(last)), last.step);
}

std::vector<Figure> map_figures(FigureSource& source) {
  std::vector<Figure> figures;
  for (const SensorStudy& sensor : source.study().experiment.sensors)
    add_wall(source, sensor, figures);
  for (const PaperFigure& figure : source.study().experiment.figures)
    if (figure.kind == FigureKind::kMap) add_pair(source, figure, figures);
  for (const SensorStudy& sensor : source.study().experiment.sensors)
    for (const SettingSummary& best : source.best(sensor))
      if (const auto run = median_run(source.study(), best))
        if (const MapRecord* map = source.map(*run, best.sensor, best.setting, best.step)) {
          figures.push_back(map_figure(
              *map, fmt::format("map-{}-{}", name(best.sensor), info(best.setting.method).name)));
          const double error_m = map->score ? map->score->mpe_m : kNaN;
          if (std::isfinite(error_m))
            figures.back().title =
                fmt::format("{}, {}: {} off after {} steps", title_of(best.sensor),
                            short_label(best.setting), error_text(error_m), best.step);
        }
  return figures;
}

std::vector<Figure> forming_figures(FigureSource& source) {
  std::vector<Figure> figures;
  for (const SensorStudy& sensor : source.study().experiment.sensors)
    if (const auto best = best_setting(source, sensor)) {
      add_film(source, sensor, *best, figures);
      add_ellipses(source, *best, figures);
    }
  return figures;
}

}  // namespace mapproof
