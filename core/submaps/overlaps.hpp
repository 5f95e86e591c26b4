#pragma once

#include <utility>
#include <vector>

#include "core/model/submaps.hpp"
#include "core/submaps/join_fit.hpp"

namespace mapproof {

/// Two sub-maps that can be tied, and the fits of each to the other.
struct Overlap {
  int first = 0;
  int second = 0;
  std::vector<std::pair<Eigen::Index, Eigen::Index>> shared;  ///< Rows in first and second.
  Affine to_first;                                            ///< Takes the second to the first.
  Affine to_second;                                           ///< And back.
  double residual = 0.0;                                      ///< Relative, the mean of both fits'.
  double cost = 0.0;  ///< The less the better: the residual over the root of the count.
};

/// All pairs of sub-maps with 3 landmarks or more in common that are not on one line in either.
std::vector<Overlap> overlaps_of(const std::vector<Submap>& maps, JoinKind kind);

/// Overlaps of least total cost that tie together what can be tied: their indices, ascending.
std::vector<std::size_t> spanning_tree(const std::vector<Overlap>& overlaps, std::size_t maps);

}  // namespace mapproof
