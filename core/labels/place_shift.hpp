#pragma once

#include <cstdint>
#include <vector>

#include <Eigen/Core>

#include "core/labels/log_blocks.hpp"
#include "core/labels/robust_map.hpp"

namespace mapproof {

/// How a slice of time asks for one landmark's place to be shifted: the cost, near the map's place,
/// is x' H x / 2 - g' x for a shift by x.
struct ShiftSlice {
  Eigen::Matrix2d H = Eigen::Matrix2d::Zero();
  Eigen::Vector2d g = Eigen::Vector2d::Zero();
};

/// Of each slice of time, in order, all robots' together.
std::vector<ShiftSlice> shift_slices(const std::vector<PairItem>& items, const RobustMap& map,
                                     const LogBlocks& blocks, int landmark);

/// The slice with which a second place begins that lowers the cost the most.
std::size_t likeliest_change(const std::vector<ShiftSlice>& slices);

/// Whether the slices ask for one place or for another from some time on.
struct ShiftTest {
  double statistic = 0.0;  ///< The most that a second place lowers the cost, m^2.
  double p = 1.0;          ///< Share of permutations of the slices with as much, itself among them.
};

struct PermutationOptions {
  int count = 1999;
  std::uint64_t seed = 1;
};

/// @note Stops early where p is plainly large, with what was drawn until then.
ShiftTest shift_test(const std::vector<ShiftSlice>& slices, const PermutationOptions& options);

}  // namespace mapproof
