#pragma once

#include <optional>

#include "core/embed/sde/lagrangian.hpp"

namespace mapproof::unfolding {

/// How far (Y, w) is from optimal, apart from the sign of the slack.
struct KktResiduals {
  double pairs = 0.0;     ///< Norm of the violated distances.
  double gradient = 0.0;  ///< Norm of the slack times Y.

  double sum() const { return pairs + gradient; }
};

KktResiduals kkt_residuals(const Problem& problem, const Rows& Y, const Eigen::VectorXd& w);

/// A change of (Y, w).
struct KktStep {
  Rows Y;
  Eigen::VectorXd w;
};

/// The Newton step on (slack(w) Y, residuals(Y)) = 0, the slack shifted just far enough to be
/// positive definite. Eliminating Y leaves a dense system in w. Steps
/// converge quadratically once the rank of Y is that of the solution.
/// @return Empty if the system could not be solved.
/// @note O(m^3 / 3) time and O(m^2) memory for m pairs.
std::optional<KktStep> kkt_newton_step(const Problem& problem, const Rows& Y,
                                       const Eigen::VectorXd& w);

}  // namespace mapproof::unfolding
