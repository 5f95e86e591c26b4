// refine() against the same least squares, dense.
#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <cmath>

#include "core/range_slam/refinement/refine.hpp"
#include "tests/core/range_slam/slam_worlds.hpp"

namespace mapproof {
namespace {

using test::ground_truth_as_start;
using test::noisy_world;

/// The same problem written down a second time: dense, numeric Jacobians, Gauss and Newton's steps.
struct DenseProblem {
  const RangeLog& log;
  RefineOptions options;
  Eigen::Index poses = static_cast<Eigen::Index>(log.odometry.size()) + 1;
  Eigen::Index landmarks = static_cast<Eigen::Index>(log.landmarks.size());

  Eigen::Index size() const { return 3 * (poses - 1) + 2 * landmarks + 1; }

  Eigen::VectorXd packed(const SlamEstimate& estimate) const {
    Eigen::VectorXd x(size());
    for (Eigen::Index i = 1; i < poses; ++i)
      x.segment<3>(3 * (i - 1)) << estimate.path.positions_m(i, 0), estimate.path.positions_m(i, 1),
          estimate.path.heading_rad(i);
    for (Eigen::Index n = 0; n < landmarks; ++n)
      x.segment<2>(3 * (poses - 1) + 2 * n) = estimate.landmarks_m.row(n).transpose();
    x(size() - 1) = estimate.range_scale;
    return x;
  }

  Eigen::Vector3d pose(const Eigen::VectorXd& x, Eigen::Index i) const {
    if (i == 0) return {log.start.x_m, log.start.y_m, log.start.heading_rad};
    return x.segment<3>(3 * (i - 1));
  }

  /// Whitened; ranges by the root of Huber's weight at `weighted_at`.
  Eigen::VectorXd residuals(const Eigen::VectorXd& x, const Eigen::VectorXd& weighted_at) const {
    const auto motions = static_cast<Eigen::Index>(log.odometry.size());
    Eigen::VectorXd r(3 * motions + static_cast<Eigen::Index>(log.ranges.size()));
    for (Eigen::Index i = 0; i < motions; ++i) {
      const Motion& motion = log.odometry[static_cast<std::size_t>(i)];
      const Eigen::Vector3d a = pose(x, i);
      const Eigen::Vector3d b = pose(x, i + 1);
      const double dx = b(0) - a(0);
      const double dy = b(1) - a(1);
      r(3 * i) = (std::cos(a(2)) * dx + std::sin(a(2)) * dy - motion.distance_m) / 0.02;
      r(3 * i + 1) = (-std::sin(a(2)) * dx + std::cos(a(2)) * dy - motion.sideways_m) / 0.02;
      r(3 * i + 2) = (b(2) - a(2) - motion.heading_change_rad) / 0.005;
    }
    for (std::size_t k = 0; k < log.ranges.size(); ++k) {
      const double at = range_residual(weighted_at, k);
      const double weight = std::abs(at) > options.huber ? options.huber / std::abs(at) : 1.0;
      r(3 * motions + static_cast<Eigen::Index>(k)) = std::sqrt(weight) * range_residual(x, k);
    }
    return r;
  }

  double range_residual(const Eigen::VectorXd& x, std::size_t k) const {
    const RangeMeasurement& measured = log.ranges[k];
    const Eigen::Vector3d at = pose(x, std::lround(measured.time_s));
    const Eigen::Vector2d position = x.segment<2>(3 * (poses - 1) + 2 * measured.landmark);
    return (x(size() - 1) * (at.head<2>() - position).norm() - measured.range_m) /
           options.range_sigma_m;
  }

  Eigen::MatrixXd jacobian(const Eigen::VectorXd& x) const {
    constexpr double kStep = 1e-6;
    Eigen::MatrixXd J(residuals(x, x).size(), size());
    for (Eigen::Index i = 0; i < size(); ++i) {
      Eigen::VectorXd above = x;
      Eigen::VectorXd below = x;
      above(i) += kStep;
      below(i) -= kStep;
      J.col(i) = (residuals(above, x) - residuals(below, x)) / (2.0 * kStep);
    }
    return J;
  }
};

TEST(Refine, EndsWhereDenseGaussNewtonEnds) {
  const RangeLog log = noisy_world(2, 24);
  const RefineOptions options{.range_sigma_m = 0.2, .covariances = 25};
  const SlamEstimate refined = refine(log, ground_truth_as_start(log), options);
  EXPECT_TRUE(refined.statuses.empty());
  const DenseProblem dense{.log = log, .options = options};
  Eigen::VectorXd x = dense.packed(ground_truth_as_start(log));
  for (int round = 0; round < 100; ++round) {
    const Eigen::MatrixXd J = dense.jacobian(x);
    x -= (J.transpose() * J).ldlt().solve(J.transpose() * dense.residuals(x, x));
  }
  EXPECT_LT((dense.packed(refined) - x).cwiseAbs().maxCoeff(), 1e-4);
}

/// After a rigid fit of the landmarks; against the dense inverse.
TEST(Refine, CovariancesAreTheDenseOnesFreedOfTheFrame) {
  const RangeLog log = noisy_world(2, 24);
  const RefineOptions options{.range_sigma_m = 0.2, .covariances = 25};
  const SlamEstimate refined = refine(log, ground_truth_as_start(log), options);
  const DenseProblem dense{.log = log, .options = options};
  const Eigen::MatrixXd J = dense.jacobian(dense.packed(refined));
  const Eigen::MatrixXd covariance = (J.transpose() * J).inverse();
  // The errors less the rigid motion that fits those of the landmarks best.
  const Eigen::Index first = 3 * (dense.poses - 1);
  Eigen::MatrixXd moves = Eigen::MatrixXd::Zero(dense.size(), 3);
  const auto fill = [&](Eigen::Index row, const Eigen::RowVector2d& position) {
    moves.block<2, 3>(row, 0) << 1, 0, -position(1), 0, 1, position(0);
  };
  for (Eigen::Index i = 1; i < dense.poses; ++i) fill(3 * (i - 1), refined.path.positions_m.row(i));
  for (Eigen::Index n = 0; n < dense.landmarks; ++n)
    fill(first + 2 * n, refined.landmarks_m.row(n));
  const Eigen::MatrixXd G = moves.middleRows(first, 2 * dense.landmarks);
  Eigen::MatrixXd P = Eigen::MatrixXd::Identity(dense.size(), dense.size());
  P.middleCols(first, 2 * dense.landmarks) -= moves * (G.transpose() * G).inverse() * G.transpose();
  const Eigen::MatrixXd freed = P * covariance * P.transpose();
  for (Eigen::Index n = 0; n < dense.landmarks; ++n) {
    const Eigen::Matrix2d expected = freed.block<2, 2>(first + 2 * n, first + 2 * n);
    EXPECT_LT((refined.landmark_cov_m2[static_cast<std::size_t>(n)] - expected).norm(),
              1e-5 * expected.norm());
  }
  ASSERT_EQ(refined.position_cov_rows.size(), 25U);
  for (std::size_t i = 1; i < 25; ++i) {
    const Eigen::Index row = 3 * (refined.position_cov_rows[i] - 1);
    const Eigen::Matrix2d expected = freed.block<2, 2>(row, row);
    EXPECT_LT((refined.position_cov_m2[i] - expected).norm(), 1e-5 * expected.norm());
  }
}

}  // namespace
}  // namespace mapproof
