#pragma once

#include <vector>

#include <Eigen/Core>

#include "core/model/observation_history.hpp"

namespace mapproof {

/// The column of each row in the assignment of least sum [kuhn1955] [jonker1987].
/// @param costs  n x m, n <= m, finite.
/// @throws InvalidInput if the bounds above are broken.
/// @note O(n^2 m). Of equal sums that with the lower columns for the earlier rows is likely, not
///       promised; the same costs give the same assignment.
std::vector<Eigen::Index> least_assignment(const Eigen::MatrixXd& costs);

/// How labels of a history are estimated.
struct CorrespondenceOptions {
  Eigen::Index rank = 10;  ///< Of the observation vectors' model, >= 1; at most M - 1 are used.
  int most_rounds = 60;    ///< >= 1.
  /// What it costs to depart from a given label, in medians of what readings under the given labels
  /// are off, squared, >= 0; 0: the given labels of doubtful readings mean nothing.
  double change_cost = 0.0;
  /// So many steps on end have the same labels right and wrong, >= 1.
  Eigen::Index stretch = 1;
};

/// A history under the labels found.
struct Correspondence {
  ObservationHistory history;
  double loss_before = 0.0;  ///< Share of the observation vectors' spread over the landmarks that
  double loss_after = 0.0;   ///< the model does not explain, under the labels given and found.
  int rounds = 0;
  bool settled = true;  ///< False: labels still changed when the rounds were used up.
  /// M x N: the row whose reading, as it was given, a landmark has in a step.
  Eigen::Array<Eigen::Index, Eigen::Dynamic, Eigen::Dynamic> reading_of = {};
  /// M x N: a doubtful reading that no exchange with another of its step would make nearly as
  /// likely: each would cost more than 4 median squared residuals.
  Eigen::Array<bool, Eigen::Dynamic, Eigen::Dynamic> clear = {};
};

/// Which of its entries a step's doubtful readings are, estimated together with the map by lowering
/// the loss of LPCA [yairi2007, section 5.1]: what the leading principal components of the
/// observation vectors leave. In turn components from labels, and at each step the assignment of
/// the doubtful readings to the doubtful landmarks that is nearest to what the components say.
///
/// Both turns lower the loss and what is paid for changes. It is started from the given labels,
/// from those that four components make of them, and from the components of the certain entries
/// alone; the start that ends lowest is taken.
/// @param doubtful  M x N, true: the reading may be of any landmark that is doubtful in this
/// stretch
///                  of steps; it is then doubtful in all of them.
/// @throws InvalidInput for missing entries, sizes that differ, or options out of bounds.
/// @note O(M^2 N + sum of d^3) a round, d the doubtful entries of a step.
Correspondence estimated_correspondence(
    const ObservationHistory& history,
    const Eigen::Array<bool, Eigen::Dynamic, Eigen::Dynamic>& doubtful,
    const CorrespondenceOptions& options = {});

}  // namespace mapproof
