#include "tests/support/samples/sample_comparisons.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "core/base/random.hpp"
#include "core/simulate/robot_walk.hpp"
#include "core/simulate/sensors.hpp"
#include "core/simulate/world.hpp"
#include "render/figures/diagrams/fit.hpp"
#include "render/figures/diagrams/method_comparison.hpp"
#include "tests/support/samples/drawn_points.hpp"
#include "tests/support/samples/sample_figures.hpp"

namespace mapproof::test {
namespace {

template <typename Spec>
Spec with_id(Spec spec, const std::string& id) {
  spec.id = id;
  return spec;
}

ErrorLine line(const std::string& label, const std::string& key, const std::vector<double>& x,
               double start, double slope) {
  ErrorLine made{.label = label, .key = key, .x = x, .mean = {}, .low = {}, .high = {}};
  for (const double value : x) {
    const double mean = start + slope * (value - x.front()) / (x.back() - x.front());
    made.mean.push_back(mean);
    made.low.push_back(0.88 * mean);
    made.high.push_back(1.13 * mean);
  }
  return made;
}

void add_ranks(std::vector<Figure>& figures) {
  for (const std::size_t methods : {0u, 2u, 4u, 10u})
    figures.push_back(critical_difference_figure(
        with_id(sample_ranks(methods), fmt::format("ranks-{}", methods))));
  CriticalDifferenceSpec equal = with_id(sample_ranks(6), "ranks-equal");
  for (RankedMethod& method : equal.methods) method.mean_rank = 3.5;
  equal.friedman_p = 1.0;
  figures.push_back(critical_difference_figure(equal));
  CriticalDifferenceSpec few = with_id(sample_ranks(10), "ranks-two-layouts");
  few.critical_difference = 9.58;  // of ten methods on two layouts
  few.units = 2;
  figures.push_back(critical_difference_figure(few));
  CriticalDifferenceSpec names = with_id(sample_ranks(5), "ranks-hostile");
  for (std::size_t i = 0; i < 5; ++i) names.methods[i].label = hostile_names()[i + 1];
  figures.push_back(critical_difference_figure(names));
}

void add_runs(std::vector<Figure>& figures) {
  figures.push_back(ellipse_map_figure(with_id(sample_runs(50, 12), "ellipses-usual")));
  figures.push_back(ellipse_map_figure(with_id(sample_runs(50, 5), "ellipses-few-runs")));
  figures.push_back(ellipse_map_figure(with_id(sample_runs(50, 2), "ellipses-two-runs")));
  figures.push_back(ellipse_map_figure(with_id(sample_runs(0, 5), "ellipses-none")));
  EllipseMapSpec far = with_id(sample_runs(20, 12), "ellipses-far-off");
  far.estimates_m[0].row(3).setConstant(NAN);
  far.estimates_m[1].row(7) << 90.0, -40.0;
  figures.push_back(ellipse_map_figure(far));
}

void add_distances(std::vector<Figure>& figures) {
  figures.push_back(shepard_figure(with_id(sample_distances(10, 50), "shepard-usual")));
  figures.push_back(shepard_figure(with_id(sample_distances(2, 12), "shepard-few")));
  figures.push_back(shepard_figure(with_id(sample_distances(0, 12), "shepard-none")));
  ShepardSpec failed = with_id(sample_distances(4, 50), "shepard-failed");
  for (double& distance : failed.methods[1].mapped_m) distance *= 1e9;
  failed.methods[2].mapped_m.assign(failed.methods[2].mapped_m.size(), NAN);
  failed.methods[3].mapped_m.assign(failed.methods[3].mapped_m.size(), 0.0);
  figures.push_back(shepard_figure(failed));
  figures.push_back(spectrum_figure(with_id(sample_spectra(8), "spectrum-usual")));
  figures.push_back(spectrum_figure(with_id(sample_spectra(0), "spectrum-none")));
}

void add_map_comparisons(std::vector<Figure>& figures) {
  figures.push_back(film_strip_figure(with_id(sample_maps(10), "film-usual")));
  figures.push_back(film_strip_figure(with_id(sample_maps(4), "film-four")));
  figures.push_back(film_strip_figure(with_id(sample_maps(1), "film-one")));
  MapGridSpec far = with_id(sample_maps(3), "film-far-off");
  far.maps[0].map.estimate.row(5) << 100.0, 3.0;
  far.maps[1].map.estimate.row(6).setConstant(NAN);
  figures.push_back(film_strip_figure(far));
  MapGridSpec pair = with_id(sample_maps(2), "pair-usual");
  pair.maps[0].title = "Nearest to the paper, layout 1, pose 3";
  pair.maps[1].title = "Median, layout 4, pose 2";
  figures.push_back(map_pair_figure(pair));
  figures.push_back(idea_figure(with_id(sample_idea(Sensor::kVisibility), "idea-visibility")));
  figures.push_back(idea_figure(with_id(sample_idea(Sensor::kBearing), "idea-bearing")));
}

void add_fits(std::vector<Figure>& figures) {
  const auto spec = [](const std::string& id, std::size_t rows) {
    FitTestsSpec made{.id = id,
                      .title = "Tests of the fit",
                      .verdict = "The data do not fit the map: ranges are stamped 5.02 s late.",
                      .is_alarm = true,
                      .rows = {},
                      .record_ids = {"drive"}};
    for (std::size_t i = 0; i < rows; ++i)
      made.rows.push_back({fmt::format("offset of landmark {}", i), fmt::format("test-{}", i),
                           0.05 * static_cast<double>(1 + 7 * i % 11) * (i == 4 ? 400.0 : 1.0),
                           i == 4});
    return made;
  };
  figures.push_back(fit_tests_figure(spec("fit-usual", 12)));
  figures.push_back(fit_tests_figure(spec("fit-many", 90)));
  figures.push_back(fit_tests_figure(spec("fit-none", 0)));
  FitTestsSpec hostile = spec("fit-hostile", 6);
  for (std::size_t i = 0; i < 5; ++i) hostile.rows[i].label = hostile_names()[i + 1];
  hostile.rows[5].ratio = NAN;
  figures.push_back(fit_tests_figure(hostile));
}

void add_errors(std::vector<Figure>& figures) {
  figures.push_back(anchor_count_figure(with_id(sample_anchor_counts(), "anchors-usual")));
  figures.push_back(level_curve_figure(with_id(sample_levels(8), "levels-usual")));
  figures.push_back(level_curve_figure(with_id(sample_levels(0), "levels-none")));
  HeatMapSpec usual = with_id(sample_heat(5, 4), "heat-usual");
  usual.values[7] = usual.values[19] = NAN;
  figures.push_back(heat_map_figure(usual));
  figures.push_back(heat_map_figure(with_id(sample_heat(30, 24), "heat-many")));
  HeatMapSpec wide = with_id(sample_heat(4, 3), "heat-log");
  for (double& value : wide.values) value = std::pow(10.0, 12.0 * value - 2.0);
  figures.push_back(heat_map_figure(wide));
  HeatMapSpec tiny = with_id(sample_heat(4, 3), "heat-tiny");
  for (double& value : tiny.values) value *= 1e-16;
  tiny.decimals = 6;
  tiny.quantity = "mean distance between the landmarks of two maps made from the same observations";
  tiny.y_label = "greatest distance at which the sensor still observes a landmark [m]";
  figures.push_back(heat_map_figure(tiny));
  HeatMapSpec same = with_id(sample_heat(2, 2), "heat-same");
  same.values.assign(4, 12.5);
  same.unit = "%";
  same.x_names = {hostile_names().front(), std::string(60, 'w')};
  figures.push_back(heat_map_figure(same));
  figures.push_back(pareto_figure(with_id(sample_costs(10), "pareto-usual")));
  figures.push_back(pareto_figure(with_id(sample_costs(40), "pareto-many")));
  figures.push_back(pareto_figure(with_id(sample_costs(0), "pareto-none")));
}

void add_published(std::vector<Figure>& figures) {
  const auto sensor = [](const char* title, std::size_t methods) {
    PublishedErrorsSpec::Sensor made{title, "Someone 2007, Table 1", {}};
    for (std::size_t i = 0; i < methods; ++i) {
      const double mean = 0.05 * std::pow(1.4, static_cast<double>((5 * i) % 11));
      made.methods.push_back({.label = fmt::format("Method {}", i),
                              .key = fmt::format("method-{}", i),
                              .mean_m = mean,
                              .interval = Range{0.9 * mean, 1.1 * mean},
                              .published_m = (i % 3 == 0   ? 1.05
                                              : i % 3 == 1 ? 1.3
                                                           : 0.8) *
                                             mean});
    }
    return made;
  };
  PublishedErrorsSpec spec{"published-usual", {sensor("Visibility maps", 10)}, {"run"}};
  spec.sensors.push_back(sensor("Bearing maps", 9));
  spec.sensors[1].methods[2].published_m.reset();
  spec.sensors[1].methods[4].can_compare = false;
  figures.push_back(published_errors_figure(spec));
  figures.push_back(
      published_errors_figure({"published-one", {sensor("Bearing maps", 3)}, {"run"}}));
  figures.push_back(
      published_errors_figure({"published-none", {sensor("Bearing maps", 0)}, {"run"}}));
  spec.id = "published-hostile";
  for (std::size_t i = 0; i < 5; ++i) spec.sensors[0].methods[i].label = hostile_names()[i + 1];
  spec.sensors[0].methods[5].mean_m = NAN;
  spec.sensors[0].methods[6].mean_m = 1e17;
  spec.sensors[0].methods[7].published_m = INFINITY;
  spec.sensors[1].methods[0].interval.reset();
  figures.push_back(published_errors_figure(spec));
}

}  // namespace

std::vector<std::string> method_labels(std::size_t count) {
  std::vector<std::string> labels = {
      "LPCA",   "SMACOF", "SMACOF, kNN", "KPCA, Gaussian", "KPCA, polynomial",
      "ISOMAP", "LLE",    "LEM",         "HLLE",           "SDE"};
  labels.resize(std::min(count, labels.size()));
  return labels;
}

CriticalDifferenceSpec sample_ranks(std::size_t methods) {
  CriticalDifferenceSpec spec;
  spec.id = "ranks";
  spec.alpha = 0.05;
  spec.title = "Mean ranks of the methods over layouts, visibility";
  const std::vector<double> ranks = {8.2, 6.9, 3.1, 9.0, 9.4, 2.9, 3.8, 6.6, 3.5, 1.6};
  double sum = 0.0;
  for (std::size_t i = 0; i < methods; ++i) sum += ranks[i];
  const auto count = static_cast<double>(methods);
  for (std::size_t i = 0; i < methods; ++i)
    spec.methods.push_back({method_labels(10)[i],
                            std::clamp(ranks[i] * count * (count + 1.0) / 2.0 / sum, 1.0, count)});
  spec.critical_difference = 0.21 * std::max(count, 1.0);
  spec.units = 40;
  spec.friedman_p = 1e-20;
  return spec;
}

EllipseMapSpec sample_runs(int landmarks, int runs) {
  Random random(5);
  EllipseMapSpec spec;
  spec.id = "ellipses";
  spec.title = "ISOMAP, K = 6: the runs of layout 1";
  const MapRecord map = sample_map(landmarks, 0.0, 3);
  spec.names = map.names;
  spec.ground_truth_m = *map.ground_truth_m;
  spec.anchors = map.anchors;
  for (int run = 0; run < runs; ++run) {
    spec.estimates_m.push_back(spec.ground_truth_m);
    Points& points = spec.estimates_m.back();
    for (Eigen::Index i = 0; i < points.rows(); ++i) {
      const double along = 0.05 * random.normal(), across = 0.015 * random.normal();
      const double turn = 0.3 * static_cast<double>(i);
      points.row(i) += Eigen::RowVector2d(0.03 + along * std::cos(turn) - across * std::sin(turn),
                                          along * std::sin(turn) + across * std::cos(turn));
    }
  }
  return spec;
}

ShepardSpec sample_distances(std::size_t methods, int landmarks) {
  Random random(9);
  ShepardSpec spec;
  spec.id = "shepard";
  spec.title = "Map distance against distance of observations, visibility";
  const Points ground_truth = *sample_map(landmarks, 0.0, 4).ground_truth_m;
  for (std::size_t m = 0; m < methods; ++m) {
    ShepardPanel& panel = spec.methods.emplace_back();
    panel.title = method_labels(10)[m];
    for (Eigen::Index i = 0; i < ground_truth.rows(); ++i)
      for (Eigen::Index j = 0; j < i; ++j) {
        const double distance = (ground_truth.row(i) - ground_truth.row(j)).norm();
        panel.observed.push_back(std::sqrt(2.0) * std::sqrt(1.0 - std::exp(-distance)));
        panel.mapped_m.push_back(
            std::abs(distance + 0.05 * static_cast<double>(m + 1) * random.normal()));
      }
  }
  return spec;
}

SpectrumSpec sample_spectra(std::size_t methods) {
  SpectrumSpec spec;
  spec.id = "spectrum";
  spec.title = "Leading eigenvalues, visibility";
  for (std::size_t m = 0; m < methods; ++m) {
    SpectrumPanel& panel = spec.methods.emplace_back();
    panel.title = method_labels(10)[m];
    if (m == 1 || m == 2) continue;  // Iterative.
    const double fall = 0.3 + 0.08 * static_cast<double>(m);
    for (int i = 0; i < (m < 6 ? 10 : 5); ++i)
      panel.eigenvalues.push_back((m < 6 ? 40.0 : 1e-3) * (i == 1 ? 0.8 : std::pow(fall, i)));
    if (m >= 6) std::ranges::reverse(panel.eigenvalues);
  }
  return spec;
}

MapGridSpec sample_maps(std::size_t count) {
  MapGridSpec spec;
  spec.id = "film";
  spec.title = "ISOMAP, K = 6, bearing: a map forms";
  for (std::size_t i = 0; i < count; ++i) {
    TitledMap& one = spec.maps.emplace_back();
    one.title = fmt::format("{} steps", 200 * (i + 1));
    one.map = sample_map(50, 0.3 / std::sqrt(static_cast<double>(i + 1)), 6);
  }
  return spec;
}

AnchorCountSpec sample_anchor_counts() {
  const std::vector<double> counts = {3, 4, 5, 6, 8, 10, 12, 16, 20};
  AnchorCountSpec spec;
  spec.id = "anchors";
  spec.title = "Mean position error over the number of anchors, SDE";
  for (const std::string sensor : {"visibility", "bearing"}) {
    const double scale = sensor == "visibility" ? 1.0 : 0.5;
    spec.panels.push_back({sensor,
                           {line("corners and walls", "walls", counts, 0.22 * scale, -0.08 * scale),
                            line("random", "random", counts, 0.6 * scale, -0.42 * scale),
                            line("clustered", "clustered", counts, 0.9 * scale, -0.3 * scale)}});
  }
  return spec;
}

LevelCurveSpec sample_levels(std::size_t methods) {
  LevelCurveSpec spec;
  spec.id = "levels";
  spec.title = "Mean position error over bearing noise";
  spec.x_label = "standard deviation of bearing noise [°]";
  for (std::size_t m = 0; m < methods; ++m)
    spec.methods.push_back(line(method_labels(10)[m], fmt::format("method-{}", m + 1),
                                {0, 1, 2, 5, 10, 20}, 0.06 + 0.05 * static_cast<double>(m),
                                0.05 + 0.04 * static_cast<double>(m % 3)));
  return spec;
}

HeatMapSpec sample_heat(std::size_t columns, std::size_t rows) {
  HeatMapSpec spec;
  spec.id = "heat";
  spec.title = "Maps from bearing, kNN-SMACOF (K = 8): MPE";
  spec.x_label = "landmarks";
  spec.y_label = "side of the room [m]";
  for (std::size_t i = 0; i < columns; ++i) spec.x_names.push_back(fmt::format("{}", 20 + 15 * i));
  for (std::size_t i = 0; i < rows; ++i)
    spec.y_names.push_back(fmt::format("{}", 1.5 + 0.5 * static_cast<double>(i)));
  for (std::size_t row = 0; row < rows; ++row)
    for (std::size_t column = 0; column < columns; ++column)
      spec.values.push_back(0.04 + 0.06 * static_cast<double>(row + 1) / static_cast<double>(rows) +
                            0.2 / static_cast<double>(column + 1));
  spec.quantity = "MPE";
  spec.unit = "m";
  spec.missing = "no run gave a value";
  return spec;
}

ParetoSpec sample_costs(std::size_t settings) {
  Random random(13);
  ParetoSpec spec;
  spec.id = "pareto";
  spec.title = "Error against seconds a map, visibility";
  for (std::size_t i = 0; i < settings; ++i)
    spec.settings.push_back({fmt::format("{}{}", method_labels(10)[i % 10],
                                         i < 10 ? "" : fmt::format(", K = {}", 4 + i / 10)),
                             1e-3 * std::pow(10.0, 1.5 * random.uniform(-1.0, 1.0)),
                             0.15 + 1.2 * random.uniform() * random.uniform()});
  return spec;
}

IdeaSpec sample_idea(Sensor sensor) {
  Random random(21);
  IdeaSpec spec;
  spec.id = "idea";
  spec.world = scatter_landmarks({}, random);
  const Path path = random_walk(spec.world, {}, 120, random);
  spec.path_m = path.positions_m;
  SensorOptions options;
  options.sensor = sensor;
  spec.history = observe(spec.world, path, options, random);
  spec.map = sample_map(50, 0.06, 2);
  spec.map.ground_truth_m = spec.world.landmarks_m;
  for (Eigen::Index i = 0; i < 50; ++i)
    spec.map.estimate.row(i) =
        spec.world.landmarks_m.row(i) + 0.06 * normal_point(random);
  spec.map.anchors = place_anchors(spec.world, 4, AnchorPlacement::kWalls, random);
  spec.steps = 100;
  return spec;
}

std::vector<Figure> sample_comparison_figures() {
  std::vector<Figure> figures;
  add_ranks(figures);
  add_runs(figures);
  add_distances(figures);
  add_map_comparisons(figures);
  add_errors(figures);
  add_fits(figures);
  add_published(figures);
  return figures;
}

}  // namespace mapproof::test
