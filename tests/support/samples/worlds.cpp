#include "tests/support/samples/worlds.hpp"

#include <algorithm>

#include <Eigen/QR>
#include <Eigen/SVD>

#include "core/base/random.hpp"

namespace mapproof::test {

Points grid(Eigen::Index rows, Eigen::Index columns) {
  Points points(rows * columns, 2);
  for (Eigen::Index i = 0; i < points.rows(); ++i)
    points.row(i) << static_cast<double>(i % columns), static_cast<double>(i / columns);
  return points;
}

Points scattered(Eigen::Index n, std::uint64_t seed) {
  Random random(seed);
  Points points(n, 2);
  for (Eigen::Index i = 0; i < n; ++i) points.row(i) << random.uniform(), random.uniform();
  return points;
}

Eigen::MatrixXd distances_of(const Points& points) {
  Eigen::MatrixXd distances(points.rows(), points.rows());
  for (Eigen::Index i = 0; i < points.rows(); ++i)
    distances.col(i) = (points.rowwise() - points.row(i)).rowwise().norm();
  return distances;
}

double procrustes_gap(const Points& points, const Points& estimate) {
  const Points A = points.rowwise() - points.colwise().mean();
  const Points B = estimate.rowwise() - estimate.colwise().mean();
  const Eigen::Matrix2d product = B.transpose() * A;
  const Eigen::JacobiSVD<Eigen::Matrix2d> svd(product, Eigen::ComputeFullU | Eigen::ComputeFullV);
  return (B * (svd.matrixU() * svd.matrixV().transpose()) - A).rowwise().norm().maxCoeff();
}

double affine_gap(const Points& points, const Points& estimate) {
  Eigen::MatrixX3d A(estimate.rows(), 3);
  A << estimate / std::max(estimate.norm(), 1e-300), Eigen::VectorXd::Ones(estimate.rows());
  const Points fitted = A * A.colPivHouseholderQr().solve(points);
  return (fitted - points).rowwise().norm().maxCoeff();
}

Experiment small_experiment() {
  Experiment experiment;
  experiment.name = "small";
  experiment.title = "A small study";
  experiment.seed = 7;
  experiment.layouts = 2;
  experiment.poses = 2;
  experiment.world.side_m = 1.5;
  experiment.world.landmarks = 12;
  for (const Sensor sensor : {Sensor::kVisibility, Sensor::kBearing}) {
    SensorStudy study;
    study.sensor.sensor = sensor;
    study.checkpoints = {100, 200};
    for (const MethodInfo& method : all_methods()) {
      if (method.approximates) continue;
      MethodGrid grid{.method = method.method, .parameters = {}};
      if (method.parameter) grid.parameters = {6, 7};
      study.methods.push_back(grid);
    }
    experiment.sensors.push_back(study);
  }
  return experiment;
}

}  // namespace mapproof::test
