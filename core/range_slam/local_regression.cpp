#include "core/range_slam/local_regression.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/base/errors.hpp"
#include "core/linalg/decompositions.hpp"

namespace mapproof {
namespace {

constexpr int kRounds = 6;
constexpr double kHuber = 1.5;
/// Median of absolute values of a standard normal, inverted.
constexpr double kMedianToSigma = 1.4826;
/// Of the trace, added to normal equations: a straight stretch has a spread in one direction alone.
constexpr double kRidge = 1e-9;

/// Share of the typical range that is added to each before it is inverted.
constexpr double kNear = 0.05;
/// Share of the squared distances that the others must leave unexplained if they are to tell scale.
constexpr double kLeastBend = 1e-6;

/// Weights of r^2: the inverse of its error, but not without bound where the robot passes a
/// landmark.
Eigen::ArrayXd range_weights(const Eigen::ArrayXd& range_m) {
  const double typical = std::sqrt(range_m.square().mean());
  return typical > 0.0 ? Eigen::ArrayXd((range_m + kNear * typical).inverse())
                       : Eigen::ArrayXd::Ones(range_m.size());
}

double median_of(Eigen::ArrayXd values) {
  const auto middle = values.begin() + values.size() / 2;
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

/// Weighted normal equations and their solution, the last of kRounds.
template <int K>
struct RobustFit {
  using Vector = Eigen::Matrix<double, K, 1>;
  using Square = Eigen::Matrix<double, K, K>;
  Vector solution = Vector::Zero();
  Square normal = Square::Zero();

  RobustFit(const Eigen::Matrix<double, Eigen::Dynamic, K>& A, const Eigen::ArrayXd& y,
            const Eigen::ArrayXd& base) {
    Eigen::ArrayXd weights = base.square();
    for (int round = 0; round < kRounds; ++round) {
      normal = A.transpose() * weights.matrix().asDiagonal() * A;
      normal.diagonal().array() += kRidge * normal.trace();
      const Vector right = A.transpose() * (weights * y).matrix();
      solution = normal.ldlt().solve(right);
      const Eigen::ArrayXd misfit = (base * (y - (A * solution).array())).abs();
      const double limit = kHuber * kMedianToSigma * median_of(misfit);
      if (!(limit > 0.0)) break;
      weights = base.square() * (limit / misfit.max(limit));
    }
  }
};

/// Offsets from their mean, in units of their spread.
struct Frame {
  Eigen::RowVector2d center_m;
  double unit_m;
  Points offsets;

  explicit Frame(const Points& positions) : center_m(positions.colwise().mean()) {
    offsets = positions.rowwise() - center_m;
    unit_m = std::sqrt(offsets.squaredNorm() / static_cast<double>(offsets.rows()));
    if (!(unit_m > 0.0)) unit_m = 1.0;
    offsets /= unit_m;
  }
};

}  // namespace

LandmarkReadings LandmarkReadings::at(const std::vector<Eigen::Index>& rows) const {
  return {.time_s = time_s(rows),
          .positions_m = positions_m(rows, Eigen::all),
          .range_m = range_m(rows)};
}

double LocalRange::squared_range(const Eigen::RowVector2d& position) const {
  const Eigen::RowVector2d offset = position - center_m;
  return squared_scale * offset.squaredNorm() + coefficients(0) +
         offset.dot(coefficients.tail<2>()) / unit_m;
}

double LocalRange::variance(const Eigen::RowVector2d& position) const {
  Eigen::Vector3d row;
  row << 1.0, (position - center_m).transpose() / unit_m;
  return row.dot(covariance * row);
}

LocalRange fit_local_range(const LandmarkReadings& readings, Eigen::Index first, Eigen::Index count,
                           double range_scale) {
  if (count < 4) throw InvalidInput("a regression of ranges needs 4 readings");
  const Frame frame(readings.positions_m.middleRows(first, count));
  const Eigen::ArrayXd range_m = readings.range_m.segment(first, count).array();
  LocalRange local{.center_m = frame.center_m,
                   .unit_m = frame.unit_m,
                   .squared_scale = range_scale * range_scale,
                   .coefficients = Eigen::Vector3d::Zero(),
                   .covariance = Eigen::Matrix3d::Zero()};
  Eigen::MatrixX3d A(count, 3);
  A << Eigen::VectorXd::Ones(count), frame.offsets;
  const double quadratic = local.squared_scale * frame.unit_m * frame.unit_m;
  const RobustFit<3> fit(
      A, range_m.square() - quadratic * frame.offsets.rowwise().squaredNorm().array(),
      range_weights(range_m));
  local.coefficients = fit.solution;
  local.covariance = fit.normal.ldlt().solve(Eigen::Matrix3d::Identity());
  return local;
}

ScaleEvidence local_scale(const LandmarkReadings& readings, Eigen::Index first,
                          Eigen::Index count) {
  if (count < 6) return {};
  const Frame frame(readings.positions_m.middleRows(first, count));
  const Eigen::ArrayXd range_m = readings.range_m.segment(first, count).array();
  Eigen::MatrixX4d A(count, 4);
  A << frame.offsets.rowwise().squaredNorm(), Eigen::VectorXd::Ones(count), frame.offsets;
  const RobustFit<4> fit(A, range_m.square(), range_weights(range_m));
  // What of the first column the others do not explain.
  const Eigen::Matrix3d others = fit.normal.bottomRightCorner<3, 3>();
  const Eigen::Vector3d shared = fit.normal.topRightCorner<1, 3>().transpose();
  const double left = fit.normal(0, 0) - shared.dot(others.ldlt().solve(shared));
  if (!(left > kLeastBend * fit.normal(0, 0))) return {};
  const double unit_square = frame.unit_m * frame.unit_m;
  return {.squared_scale = fit.solution(0) / unit_square,
          .weight = left * unit_square * unit_square};
}

}  // namespace mapproof
