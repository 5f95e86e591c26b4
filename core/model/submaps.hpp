#pragma once

#include <vector>

#include <Eigen/Core>

#include "core/model/points.hpp"

namespace mapproof {

/// A map of some landmarks, made without the others.
struct Submap {
  std::vector<Eigen::Index> landmarks;  ///< Rows of the whole map, ascending.
  Points positions;                     ///< One of each; in the frame of the whole map if placed.
  bool placed = true;                   ///< False: nothing ties it to the others.
};

/// An overlap by which two sub-maps can be tied.
struct SubmapJoin {
  int first = 0;  ///< Indices of sub-maps, first < second.
  int second = 0;
  int shared = 0;         ///< Landmarks of both.
  double residual = 0.0;  ///< RMS distance of the positions that both give the shared landmarks,
                          ///< over the RMS radius of these; NaN if one of them is not placed.
  bool in_tree = false;   ///< Of the spanning tree that the joining started from.
};

/// Sub-maps joined into one map.
struct JoinedSubmaps {
  Points positions;  ///< M x 2; NaN rows: in no placed sub-map.
  std::vector<Submap> submaps;
  std::vector<SubmapJoin> joins;
};

}  // namespace mapproof
