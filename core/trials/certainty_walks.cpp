#include "core/trials/certainty_walks.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/base/random.hpp"
#include "core/linalg/decompositions.hpp"
#include "core/simulate/robot_walk.hpp"
#include "core/simulate/sensors.hpp"

namespace mapproof {
namespace {

/// Whether a point is in the ellipse about a place.
bool covers(const MapCertainty& certainty, Eigen::Index i, const Eigen::RowVector2d& place,
            const Eigen::RowVector2d& point) {
  const Eigen::Matrix2d& C = certainty.covariances[static_cast<std::size_t>(i)];
  const Eigen::RowVector2d off = point - place;
  const Eigen::Matrix2d adjugate =
      (Eigen::Matrix2d() << C(1, 1), -C(0, 1), -C(1, 0), C(0, 0)).finished();
  return C.allFinite() &&
         off * adjugate * off.transpose() <= certainty.squared_radius * C.determinant();
}

/// Where a landmark lies on average over the maps that have it; NaN if none has.
Points mean_map(const std::vector<Points>& maps, Eigen::Index landmarks) {
  Points mean = Points::Zero(landmarks, 2);
  Eigen::VectorXd counts = Eigen::VectorXd::Zero(landmarks);
  for (const Points& map : maps)
    for (Eigen::Index i = 0; i < landmarks; ++i)
      if (map.row(i).allFinite()) {
        mean.row(i) += map.row(i);
        counts(i) += 1.0;
      }
  return mean.array().colwise() / counts.array();
}

}  // namespace

std::vector<ObservationHistory> walked_histories(const World& world, const WalkOptions& walk,
                                                 Sensor sensor, int steps, int walks,
                                                 std::uint64_t seed) {
  std::vector<ObservationHistory> histories;
  SensorOptions options;
  options.sensor = sensor;
  for (int w = 0; w < walks; ++w) {
    Random random(derive_seed(seed, {static_cast<std::uint64_t>(w)}));
    const Path path = random_walk(world, walk, steps, random);
    histories.push_back(observe(world, path, options, random));
  }
  return histories;
}

std::vector<Points> walked_maps(const std::vector<ObservationHistory>& histories,
                                Eigen::Index steps, const CertaintyFrame& frame,
                                const HistoryCertaintyOptions& options) {
  std::vector<Points> maps;
  for (const ObservationHistory& history : histories) {
    HistoryEmbedder embedder(history, steps, options.embedder);
    const Points coordinates = embedder.embed(options.setting).coordinates;
    const Points nowhere =
        Points::Constant(coordinates.rows(), 2, std::numeric_limits<double>::quiet_NaN());
    maps.push_back(in_frame(coordinates, frame, options.fit).value_or(nowhere));
  }
  return maps;
}

Coverage coverage(const std::vector<Points>& maps, const std::vector<MapCertainty>& certainties,
                  const CertaintyFrame& frame) {
  const Eigen::Index M = frame.positions_m.rows();
  const Points mean = mean_map(maps, M);
  double judged = 0.0, places = 0.0, landmarks = 0.0;
  Coverage sum;
  for (Eigen::Index i = 0; i < M; ++i) {
    if (std::ranges::find(frame.anchors, i) != frame.anchors.end()) continue;
    if (!mean.row(i).allFinite()) continue;
    const Eigen::RowVector2d truth = frame.positions_m.row(i);
    sum.bias_m += (mean.row(i) - truth).norm();
    landmarks += 1.0;
    for (const Points& map : maps)
      if (map.row(i).allFinite()) {
        sum.spread_m += (map.row(i) - mean.row(i)).squaredNorm();
        places += 1.0;
      }
    for (std::size_t w = 0; w < certainties.size(); ++w) {
      const MapCertainty& certainty = certainties[w];
      if (!certainty.covariances[static_cast<std::size_t>(i)].allFinite()) continue;
      if (!maps[w].row(i).allFinite()) continue;
      sum.told_m += certainty.covariances[static_cast<std::size_t>(i)].trace();
      sum.mean_percent += covers(certainty, i, maps[w].row(i), mean.row(i)) ? 100.0 : 0.0;
      sum.truth_percent += covers(certainty, i, maps[w].row(i), truth) ? 100.0 : 0.0;
      judged += 1.0;
    }
  }
  // Without anything to judge these are 0 / 0, NaN.
  return {.mean_percent = sum.mean_percent / judged,
          .truth_percent = sum.truth_percent / judged,
          .bias_m = sum.bias_m / landmarks,
          .spread_m = std::sqrt(sum.spread_m / places),
          .told_m = std::sqrt(sum.told_m / judged)};
}

}  // namespace mapproof
