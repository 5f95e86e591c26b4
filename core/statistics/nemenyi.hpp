#pragma once

#include <span>
#include <vector>

namespace mapproof {

/// The q that the range of `groups` independent standard normal values exceeds with probability
/// `alpha`: the studentized range with infinitely many degrees of freedom, by quadrature and root
/// finding to some 1e-10.
///
/// @param groups  2 to 10,000.
/// @param alpha   1e-12 to .999.
/// @throws InvalidInput if a bound is broken.
double studentized_range_quantile(int groups, double alpha);

/// Methods differ if their mean ranks do by at least this [nemenyi1963] [demsar2006]:
/// q / sqrt(2) * sqrt(k (k + 1) / (6 n)), k methods on n units.
/// @throws InvalidInput as above, or unless units >= 1.
double nemenyi_critical_difference(int methods, int units, double alpha);

/// The largest sets of two or more methods of which no two differ, as the bars of a
/// critical-difference diagram join them: within a set mean ranks differ by less than the critical
/// difference, and no set is part of another.
///
/// @return Sets of indices into `mean_ranks`, each and all of them in ascending order of rank (of
///         equal ranks the lower index first).
/// @throws InvalidInput if a rank is not finite.
std::vector<std::vector<int>> alike_groups(std::span<const double> mean_ranks,
                                           double critical_difference);

}  // namespace mapproof
