#include "core/range_slam/refinement/refine_residuals.hpp"

#include <cmath>

#include <Eigen/Geometry>

namespace mapproof {
namespace {

using RowMajor3 = Eigen::Matrix<double, 3, 3, Eigen::RowMajor>;

/// Below this distance a landmark is in no direction.
constexpr double kNoDirection_m = 1e-9;

/// d(R(angle) v) / d angle.
Eigen::Vector2d turning(double angle, const Eigen::Vector2d& v) {
  const Eigen::Vector2d turned = Eigen::Rotation2Dd(angle) * v;
  return {-turned(1), turned(0)};
}

}  // namespace

bool MotionResidual::Evaluate(double const* const* parameters, double* residuals,
                              double** jacobians) const {
  const Eigen::Map<const Eigen::Vector3d> first(parameters[0]);
  const Eigen::Map<const Eigen::Vector3d> second(parameters[1]);
  const Eigen::Vector2d way = second.head<2>() - first.head<2>();
  const Eigen::Matrix2d R = Eigen::Rotation2Dd(-first(2)).toRotationMatrix();
  Eigen::Vector3d error;
  error.head<2>() = R * way - motion_.step.head<2>();
  error(2) = second(2) - first(2) - motion_.step(2);
  Eigen::Map<Eigen::Vector3d> whitened(residuals);
  whitened = motion_.root_information * error;
  if (jacobians == nullptr) return true;

  if (jacobians[0] != nullptr) {
    Eigen::Matrix3d J = Eigen::Matrix3d::Zero();
    J.topLeftCorner<2, 2>() = -R;
    J.topRightCorner<2, 1>() = -turning(-first(2), way);
    J(2, 2) = -1.0;
    Eigen::Map<RowMajor3> jacobian(jacobians[0]);
    jacobian = motion_.root_information * J;
  }
  if (jacobians[1] != nullptr) {
    Eigen::Matrix3d J = Eigen::Matrix3d::Identity();
    J.topLeftCorner<2, 2>() = R;
    Eigen::Map<RowMajor3> jacobian(jacobians[1]);
    jacobian = motion_.root_information * J;
  }
  return true;
}

bool RangeResidual::Evaluate(double const* const* parameters, double* residuals,
                             double** jacobians) const {
  const Eigen::Map<const Eigen::Vector3d> first(parameters[0]);
  const Eigen::Map<const Eigen::Vector3d> second(parameters[1]);
  const Eigen::Map<const Eigen::Vector2d> landmark(parameters[2]);
  const double scale = parameters[3][0];
  const double offset_m = parameters[4][0];
  const Eigen::Vector2d gap = place_.pose(first, second).head<2>() - landmark;
  const double distance = gap.norm();
  residuals[0] = (scale * distance + offset_m - range_m_) / sigma_m_;
  if (jacobians == nullptr) return true;

  const Eigen::Vector2d direction =
      distance > kNoDirection_m ? Eigen::Vector2d(gap / distance) : Eigen::Vector2d::Zero();
  const Eigen::Vector2d slope = scale / sigma_m_ * direction;
  const auto fill_pose = [&](double* jacobian, double weight, double heading,
                             const Eigen::Vector3d& step) {
    if (jacobian == nullptr) return;
    Eigen::Map<Eigen::RowVector3d> row(jacobian);
    row.head<2>() = weight * slope.transpose();
    row(2) = weight * slope.dot(turning(heading, step.head<2>()));
  };
  fill_pose(jacobians[0], 1.0 - place_.share, first(2), place_.ahead);
  fill_pose(jacobians[1], place_.share, second(2), place_.behind);
  if (jacobians[2] != nullptr) Eigen::Map<Eigen::RowVector2d>{jacobians[2]} = -slope.transpose();
  if (jacobians[3] != nullptr) jacobians[3][0] = distance / sigma_m_;
  if (jacobians[4] != nullptr) jacobians[4][0] = 1.0 / sigma_m_;
  return true;
}

bool OffsetPrior::Evaluate(double const* const* parameters, double* residuals,
                           double** jacobians) const {
  residuals[0] = parameters[0][0] / sigma_m_;
  if (jacobians != nullptr && jacobians[0] != nullptr) jacobians[0][0] = 1.0 / sigma_m_;
  return true;
}

}  // namespace mapproof
