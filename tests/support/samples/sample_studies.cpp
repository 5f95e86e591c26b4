#include "tests/support/samples/sample_studies.hpp"

#include <algorithm>
#include <cmath>
#include <functional>

#include <fmt/format.h>

#include "core/base/random.hpp"
#include "core/simulate/robot_walk.hpp"
#include "core/simulate/sensors.hpp"
#include "core/simulate/world.hpp"
#include "render/figures/diagrams/measurement.hpp"

namespace mapproof::test {
namespace {

/// Where a curve is least, and how steep it is around.
struct Valley {
  double least, best, steepness;
};

/// A line that is least at `best` of `x`.
ErrorLine valley(const std::string& label, const std::string& key, const std::vector<double>& x,
                 const Valley& of) {
  const auto [least, best, steepness] = of;
  ErrorLine line{.label = label, .key = key, .x = x, .mean = {}, .low = {}, .high = {}};
  for (const double value : x) {
    const double off = std::log(value / best);
    const double mean = least * (1.0 + steepness * off * off);
    line.mean.push_back(mean);
    line.low.push_back(0.9 * mean);
    line.high.push_back(1.12 * mean);
  }
  return line;
}

void add_measurements(std::vector<Figure>& figures) {
  const auto add = [&figures](const std::string& id, Sensor sensor, int landmarks,
                              const std::function<void(Measurement&)>& change) {
    Measurement measurement = sample_measurement(sensor, landmarks);
    change(measurement);
    figures.push_back(measurement_figure(measurement, "measurement-" + id));
  };
  add("visibility", Sensor::kVisibility, 50, [](Measurement&) {});
  add("bearing", Sensor::kBearing, 50, [](Measurement&) {});
  add("visibility-empty", Sensor::kVisibility, 1, [](Measurement& m) {
    m.path_m.resize(0, 2);
    m.views = {View::kOutOfReach};
  });
  add("bearing-missing", Sensor::kBearing, 8, [](Measurement& m) {
    m.bearings_rad.tail(5).setConstant(NAN);
    m.path_m.resize(0, 2);
  });
  add("visibility-corner", Sensor::kVisibility, 50,
      [](Measurement& m) { m.robot_m << 0.05, 2.45; });
}

void add_parameters(std::vector<Figure>& figures) {
  const auto add = [&figures](const std::string& id,
                              const std::function<void(ErrorByParameterSpec&)>& change) {
    ErrorByParameterSpec spec = sample_parameters();
    change(spec);
    spec.id = "parameter-" + id;
    figures.push_back(error_by_parameter_figure(spec));
  };
  add("usual", [](ErrorByParameterSpec&) {});
  add("one-kind", [](ErrorByParameterSpec& spec) { spec.groups.resize(1); });
  add("none", [](ErrorByParameterSpec& spec) { spec.groups.clear(); });
  add("unknown", [](ErrorByParameterSpec& spec) {
    spec.groups.resize(1);
    for (ParameterLine& method : spec.groups[0].methods)
      method.line.mean.assign(method.line.x.size(), NAN);
  });
}

}  // namespace

Measurement sample_measurement(Sensor sensor, int landmarks) {
  Random random(12);
  WorldOptions room;
  room.landmarks = landmarks;
  SensorOptions options;
  options.sensor = sensor;
  Measurement m;
  m.sensor = sensor;
  m.run = {2, 3};
  m.world = scatter_landmarks(room, random);
  const Path path = random_walk(m.world, {}, 200, random);
  const ObservationHistory history = observe(m.world, path, options, random);
  m.reach_m = room.landmark_diameter_m / 2.0 / std::sin(options.visual_angle_rad / 2.0);
  // The first step from the tenth on at which a landmark is hidden, if there is any.
  for (m.step = 10; m.step < 200; ++m.step) {
    m.robot_m = path.positions_m.row(m.step - 1);
    m.heading_rad = path.headings_rad(m.step - 1);
    m.path_m = path.positions_m.topRows(m.step);
    m.bearings_rad = history.values.col(m.step - 1);
    m.views.clear();
    for (int i = 0; i < landmarks; ++i) {
      const double distance = (m.world.landmarks_m.row(i) - m.robot_m).norm();
      m.views.push_back(distance > m.reach_m       ? View::kOutOfReach
                        : m.bearings_rad(i) == 1.0 ? View::kVisible
                                                   : View::kHidden);
    }
    if (sensor == Sensor::kBearing || std::ranges::count(m.views, View::kHidden) > 0) break;
  }
  return m;
}

ErrorByParameterSpec sample_parameters() {
  const std::vector<double> K = {4, 5, 6, 7, 8, 9, 10}, width = {0.1, 0.2, 0.5, 1, 2, 5},
                            degree = {2, 3, 4, 6, 8, 10};
  ErrorByParameterSpec spec;
  spec.id = "parameter";
  spec.title = "Mean position error over each method's parameter, visibility";
  const auto method = [](ErrorLine line, double ours, double paper, double printed) {
    return ParameterLine{std::move(line), ParameterValue{ours, NAN},
                         ParameterValue{paper, printed}};
  };
  spec.groups = {{"K", "neighbours", Scale::kLinear, true, {}},
                 {"σ²", "Gaussian kernel", Scale::kLog, false, {}},
                 {"d", "polynomial kernel", Scale::kLinear, true, {}}};
  spec.groups[0].methods = {
      method(valley("SMACOF, kNN", "smacof-knn", K, {0.215, 6, 2.0}), 6, 5, 0.206),
      method(valley("ISOMAP", "isomap", K, {0.219, 6.5, 1.4}), 6, 6, 0.177),
      method(valley("LLE", "lle", K, {0.247, 8, 2.5}), 8, 8, 0.241),
      method(valley("Laplacian eigenmap", "lem", K, {0.397, 5, 0.5}), 5, 6, 0.352),
      method(valley("Hessian LLE", "hlle", {6, 7, 8, 9, 10}, {0.231, 8.5, 2.0}), 8, 8, 0.192),
      method(valley("SDE", "sde", K, {0.167, 5, 1.0}), 5, 7, 0.138)};
  spec.groups[1].methods = {
      method(valley("KPCA, Gaussian", "kpca-gauss", width, {1.244, 1, 0.1}), 1, 0.5, 0.926)};
  spec.groups[2].methods = {
      method(valley("KPCA, polynomial", "kpca-poly", degree, {1.236, 2, 0.2}), 2, 8, 0.953)};
  spec.record_ids = {"layout-1-pose-1"};
  return spec;
}

std::vector<Figure> sample_study_figures() {
  std::vector<Figure> figures;
  add_measurements(figures);
  add_parameters(figures);
  return figures;
}

}  // namespace mapproof::test
