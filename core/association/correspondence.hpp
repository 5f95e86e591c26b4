#pragma once

#include <vector>

#include <Eigen/Core>

#include "core/model/observation_history.hpp"

namespace mapproof {

/// The column of each row in the assignment of least sum [kuhn1955] [jonker1987].
/// @param costs  n x m, n <= m, finite.
/// @throws InvalidInput if the bounds above are broken.
/// Of equal sums the one with the lower columns for the earlier rows is likely, not
///       promised; the same costs give the same assignment.
std::vector<Eigen::Index> least_assignment(const Eigen::MatrixXd& costs);

/// How the landmark IDs of a history are estimated.
struct CorrespondenceOptions {
  Eigen::Index rank = 10;  ///< Of the observation vectors' model, >= 1; at most M - 1 are used.
  int most_rounds = 60;    ///< >= 1.
  /// Cost of departing from a given ID, in medians of the squared residuals of the measurements
  /// under the given IDs, >= 0; 0: the given IDs of doubtful measurements are ignored.
  double change_cost = 0.0;
  /// So many consecutive steps have the same IDs right and wrong, >= 1.
  Eigen::Index stretch = 1;
};

/// A history under the estimated landmark IDs.
struct Correspondence {
  ObservationHistory history;
  double loss_before = 0.0;  ///< Share of the observation vectors' spread over the landmarks that
  double loss_after = 0.0;   ///< the model does not explain, under the given and the estimated IDs.
  int rounds = 0;
  bool converged = true;  ///< False: IDs still changed when the rounds were used up.
  /// M x N: the row of the input whose measurement a landmark has in a step.
  Eigen::Array<Eigen::Index, Eigen::Dynamic, Eigen::Dynamic> measurement_of = {};
  /// M x N: a doubtful measurement that no exchange with another of its step would make nearly as
  /// likely: each would cost more than 4 median squared residuals.
  Eigen::Array<bool, Eigen::Dynamic, Eigen::Dynamic> clear = {};
};

/// Estimates the data association of a step's doubtful measurements together with the map by
/// minimizing the loss of LPCA [yairi2007, section 5.1]: the residual of the observation vectors'
/// leading principal components. It alternates between components given IDs, and at each step the
/// assignment of the doubtful measurements to the doubtful landmarks that is nearest to the
/// components' predictions.
///
/// Both steps reduce the sum of the loss and the cost of changes. It starts from the given IDs,
/// from those that four components yield, and from the components of the certain entries alone; the
/// start with the lowest final loss is taken.
/// @param doubtful  M x N, true: the measurement may be of any landmark that is doubtful in this
///         stretch of steps; it is then doubtful in all of them.
/// @throws InvalidInput for missing entries, sizes that differ, or options out of bounds.
/// @note O(M^2 N + sum of d^3) per round, d the doubtful entries of a step.
Correspondence estimated_correspondence(
    const ObservationHistory& history,
    const Eigen::Array<bool, Eigen::Dynamic, Eigen::Dynamic>& doubtful,
    const CorrespondenceOptions& options = {});

}  // namespace mapproof
