#pragma once

#include <optional>
#include <vector>

#include <Eigen/Core>

#include "core/model/certificate.hpp"
#include "core/model/points.hpp"
#include "core/model/status.hpp"

namespace mapproof {

/// Coordinates that a mapping method gives the landmarks, before any alignment.
struct Embedding {
  Points coordinates;  ///< M x 2, arbitrary frame; NaN rows where a landmark has no position.
  std::vector<Status> statuses;  ///< Empty if all went well.
  /// Eigenvalues, those of the map's columns first: descending, but for LLE, LEM and HLLE
  /// ascending, without the constant's; empty for iterative methods.
  Eigen::VectorXd spectrum;
  int iterations = 0;            ///< Of an iterative method; 0 otherwise.
  std::optional<double> stress;  ///< Raw stress [yairi2007, eq. 6] over sum of w * delta^2.
  std::optional<Certificate> certificate;  ///< Of a semidefinite program.
};

}  // namespace mapproof
