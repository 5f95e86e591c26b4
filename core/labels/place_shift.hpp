#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include <Eigen/Core>

#include "core/labels/log_blocks.hpp"
#include "core/labels/robust_map.hpp"

namespace mapproof {

/// How a slice of time asks for one landmark's place to be shifted: the cost, near the place it is
/// told of, is x' H x / 2 - g' x for a shift by x.
struct ShiftSlice {
  Eigen::Matrix2d H = Eigen::Matrix2d::Zero();
  Eigen::Vector2d g = Eigen::Vector2d::Zero();
};

/// The two places of one landmark, before and after some slice of time, that lower the cost of one
/// the most. Only slices that show the landmark are told of.
struct PlaceChange {
  std::size_t first = 0;  ///< Slice with which the second place begins; 0: it has one alone.
  std::vector<ShiftSlice> asked;     ///< Of the first place, though linear at each slice's own.
  std::vector<ShiftSlice> residual;  ///< Of each slice's own place: what is left to chance.
};

/// Looks for the places where the map has the landmark and on circles about it whose radii double
/// from an eighth of the cost's width to beyond the map, then where the cost is least nearby.
/// @note O(items * places), some 200 places.
PlaceChange best_change(const std::vector<PairItem>& items, const RobustMap& map,
                        const LogBlocks& blocks, int landmark);

/// The most that a second place, on two slices or more, lowers the cost of what slices ask for.
double best_gain(const std::vector<ShiftSlice>& slices);

struct PermutationOptions {
  int count = 1999;
  std::uint64_t seed = 1;
  double inflation = 1.0;  ///< Of what `residual` gains by chance, >= 1.
};

/// How likely chance gains as much by a second place: the greater of two shares, of permutations of
/// `asked`, which is exact where slices err by themselves, and of permutations of `residual`,
/// inflated, for slices whose errors hang together. 1 for fewer than 6 slices.
/// @note Stops early where it is plainly large, with what was drawn until then.
double chance_of(const PlaceChange& change, const PermutationOptions& options);

/// By how much the landmarks' best gains exceed what permutations of their `residual` gain: the
/// median over landmarks, so that a few that moved do not count; >= 1. More than 1 where errors
/// hang together over slices.
double inflation(const std::vector<PlaceChange>& landmarks, std::uint64_t seed);

}  // namespace mapproof
