#pragma once

#include <vector>

#include <Eigen/Core>

namespace mapproof {

/// Whether methods that were tried on the same units differ at all.
struct FriedmanTest {
  int units = 0;
  int methods = 0;
  std::vector<double> mean_ranks;  ///< One per method; 1 is the rank of the least value.
  double chi_square = 0.0;         ///< Friedman's, corrected for ties; 0 if all values tie.
  double chi_square_p = 1.0;       ///< Of at least that, if no method differs.
  double f = 0.0;    ///< Iman and Davenport's, less conservative; infinite if all units agree.
  double f_p = 1.0;  ///< 0 if all units agree.
};

/// Ranks of values from the least, 1 to their number; ties share the mean of their ranks.
/// @throws InvalidInput if a value is not finite.
Eigen::RowVectorXd ranks(const Eigen::RowVectorXd& values);

/// The test of Friedman in the form of Conover for ties [conover1999], and with the
/// statistic of Iman and Davenport [iman1980], as [demsar2006] recommends. Both p are those of the
/// limiting distributions, chi-square with k - 1 and F with k - 1 and (k - 1)(n - 1) degrees of
/// freedom.
///
/// @param values  n x k, finite: one row per unit, one column per method. Rows must be independent.
/// @throws InvalidInput unless n >= 2, k >= 2 and all is finite.
/// @note O(n k log k).
FriedmanTest friedman(Eigen::MatrixXd values);

}  // namespace mapproof
