#pragma once

#include <vector>

#include <Eigen/Core>

namespace mapproof {

/// The column of each row in the assignment of least sum [kuhn1955] [jonker1987].
/// @param costs  n x m, n <= m, finite.
/// @throws InvalidInput if the bounds above are broken.
/// @note O(n^2 m). Of equal sums that with the lower columns for the earlier rows is likely, not
///       promised; the same costs give the same assignment.
std::vector<Eigen::Index> least_assignment(const Eigen::MatrixXd& costs);

}  // namespace mapproof
