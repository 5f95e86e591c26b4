#include "core/records/observations/path_motions.hpp"

#include <cmath>

#include "core/base/angle.hpp"
#include "core/base/errors.hpp"

namespace mapproof {
namespace {

constexpr double kShortest_m = 1e-9;

/// The heading at which each step is driven; a step of no length has that of the one before.
Eigen::VectorXd step_headings(const Points& steps_m, const Eigen::VectorXd& signs) {
  Eigen::VectorXd headings(steps_m.rows());
  Eigen::Index first = -1;
  for (Eigen::Index i = 0; i < steps_m.rows(); ++i) {
    if (steps_m.row(i).norm() > kShortest_m) {
      headings(i) = std::atan2(signs(i) * steps_m(i, 1), signs(i) * steps_m(i, 0));
      if (first < 0) first = i;
    } else if (first >= 0) {
      headings(i) = headings(i - 1);
    }
  }
  if (first < 0) return Eigen::VectorXd::Zero(steps_m.rows());
  headings.head(first).setConstant(headings(first));
  return headings;
}

}  // namespace

RecoveredOdometry motions_along(const Trajectory& path, const std::vector<double>& distances_m) {
  const Eigen::Index steps = path.size() - 1;
  if (steps < 1) throw InvalidInput("odometry needs a path of 2 poses or more");
  const Points steps_m = path.positions_m.bottomRows(steps) - path.positions_m.topRows(steps);
  Eigen::VectorXd signs = Eigen::VectorXd::Ones(steps);
  if (static_cast<Eigen::Index>(distances_m.size()) == steps)
    for (Eigen::Index i = 0; i < steps; ++i)
      signs(i) = distances_m[static_cast<std::size_t>(i)] < 0.0 ? -1.0 : 1.0;
  const Eigen::VectorXd headings = step_headings(steps_m, signs);

  RecoveredOdometry odometry{.start = {.time_s = path.time_s(0),
                                       .x_m = path.positions_m(0, 0),
                                       .y_m = path.positions_m(0, 1),
                                       .heading_rad = headings(0)},
                             .motions = {}};
  odometry.motions.reserve(static_cast<std::size_t>(steps));
  for (Eigen::Index i = 0; i < steps; ++i)
    odometry.motions.push_back(
        {.time_s = path.time_s(i + 1),
         .distance_m = signs(i) * steps_m.row(i).norm(),
         .turn_rad = i + 1 < steps ? wrapped(headings(i + 1) - headings(i)) : 0.0});
  return odometry;
}

}  // namespace mapproof
