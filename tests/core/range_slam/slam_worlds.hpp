#pragma once

#include "core/model/range_log.hpp"
#include "core/model/slam/slam.hpp"

namespace mapproof::test {

struct SlamWorldOptions {
  Eigen::Index steps = 60;
  Eigen::Index landmarks = 4;
  double range_sigma_m = 0.0;
  double distance_sigma_m = 0.0;
  double heading_change_sigma_rad = 0.0;
  double range_scale = 1.0;
  bool is_straight = false;
};

/// A drive on a wavy round of half-metre steps, with a measurement of one landmark in turn at each
/// pose. Odometry errs by the sigmas given; the ground truth is kept.
RangeLog slam_world(std::uint64_t seed, const SlamWorldOptions& options = {});

/// One with noise, and ranges 5 % long.
RangeLog noisy_world(std::uint64_t seed, Eigen::Index steps = 60);

/// slam_world(2) of a robot that heads `direction` away from where it drives: it slides sideways,
/// or drives backwards, along the same path.
RangeLog turned_world(double direction_rad);

SlamEstimate ground_truth_as_start(const RangeLog& log);

}  // namespace mapproof::test
