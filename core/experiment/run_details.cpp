#include "core/experiment/run_details.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/base/not_finite.hpp"
#include "core/embed/observation_manifold.hpp"
#include "core/observe/proximities.hpp"
#include "core/simulate/sensors.hpp"

namespace mapproof {
namespace {

constexpr Eigen::Index kFirstSteps = 60;
constexpr int kManifoldNeighbours = 5;

/// Counted from 0.
Eigen::Index telling_scan(const SensorStudy& study, const World& world, const Path& path,
                          Eigen::Index steps) {
  Eigen::Index best = 0;
  if (study.sensor.sensor != Sensor::kVisibility) {
    const Eigen::RowVector2d center(world.side_m / 2.0, world.side_m / 2.0);
    (path.positions_m.topRows(steps).rowwise() - center).rowwise().squaredNorm().minCoeff(&best);
    return best;
  }
  std::pair<std::ptrdiff_t, std::ptrdiff_t> most{-1, -1};
  for (Eigen::Index t = 0; t < steps; ++t) {
    const std::vector<View> views = views_from(world, path.positions_m.row(t), study.sensor);
    const std::pair found{std::ranges::count(views, View::kHidden),
                          std::ranges::count(views, View::kVisible)};
    if (found > most) {
      most = found;
      best = t;
    }
  }
  return best;
}

/// The entries above the diagonal, row by row.
Eigen::VectorXd upper_triangle(const Eigen::MatrixXd& squared) {
  const Eigen::Index n = squared.rows();
  Eigen::VectorXd distances(n * (n - 1) / 2);
  Eigen::Index k = 0;
  for (Eigen::Index i = 0; i < n; ++i)
    for (Eigen::Index j = i + 1; j < n; ++j) {
      const double distance = std::sqrt(squared(i, j));
      distances(k++) = std::isfinite(distance) ? distance : kNaN;
    }
  return distances;
}

Eigen::MatrixXd observed_squares(const ObservationHistory& history, Eigen::Index steps) {
  Eigen::MatrixXd squared = proximities(history, steps).squared_distances;
  for (const Eigen::Index i : unseen_landmarks(history, steps)) {
    squared.row(i).setConstant(kNaN);
    squared.col(i).setConstant(kNaN);
  }
  return squared;
}

}  // namespace

SensorDetails sensor_details(const SensorStudy& study, const World& world, const Path& path,
                             const ObservationHistory& history) {
  const int step = study.checkpoints.back();
  const Eigen::MatrixXd squared = observed_squares(history, step);
  const Eigen::Index scan = telling_scan(study, world, path, step);
  SensorDetails details{
      .sensor = study.sensor.sensor,
      .scan_step = static_cast<int>(scan) + 1,
      .views = {},
      .values = history.values.col(scan),
      .first_steps = history.values.leftCols(std::min<Eigen::Index>(kFirstSteps, step)),
      .step = step,
      .distances = upper_triangle(squared),
      .manifold = observation_manifold(squared, kManifoldNeighbours),
      .spectra = {}};
  if (study.sensor.sensor == Sensor::kVisibility) {
    details.reach_m = visibility_reach(world, study.sensor);
    details.views = views_from(world, path.positions_m.row(scan), study.sensor);
  }
  return details;
}

}  // namespace mapproof
