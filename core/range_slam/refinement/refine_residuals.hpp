#pragma once

#include <ceres/sized_cost_function.h>

#include "core/range_slam/refinement/key_poses.hpp"

namespace mapproof {

/// What a motion of the odometry says about the poses before and after it, whitened.
class MotionResidual : public ceres::SizedCostFunction<3, 3, 3> {
 public:
  explicit MotionResidual(const KeyMotion& motion) : motion_(motion) {}
  bool Evaluate(double const* const* parameters, double* residuals,
                double** jacobians) const override;

 private:
  KeyMotion motion_;
};

/// What a range says about the two key poses around it, the landmark, the scale and the landmark's
/// offset: (scale * distance + offset - range) / sigma.
class RangeResidual : public ceres::SizedCostFunction<1, 3, 3, 2, 1, 1> {
 public:
  RangeResidual(const BetweenPoses& place, double range_m, double sigma_m)
      : place_(place), range_m_(range_m), sigma_m_(sigma_m) {}
  bool Evaluate(double const* const* parameters, double* residuals,
                double** jacobians) const override;

 private:
  BetweenPoses place_;
  double range_m_;
  double sigma_m_;
};

/// What is known of a landmark's offset beforehand: offset / sigma.
class OffsetPrior : public ceres::SizedCostFunction<1, 1> {
 public:
  explicit OffsetPrior(double sigma_m) : sigma_m_(sigma_m) {}
  bool Evaluate(double const* const* parameters, double* residuals,
                double** jacobians) const override;

 private:
  double sigma_m_;
};

}  // namespace mapproof
