#include "core/evaluate/time_association.hpp"

#include <algorithm>
#include <cmath>

#include "core/base/errors.hpp"

namespace mapproof {
namespace {

/// The first of the nearest times, which do not descend.
Eigen::Index nearest(const Eigen::VectorXd& times_s, double time_s) {
  const auto after = std::lower_bound(times_s.begin(), times_s.end(), time_s);
  if (after == times_s.begin()) return 0;
  const auto gap_after = after == times_s.end() ? HUGE_VAL : std::abs(*after - time_s);
  const double before_s = *(after - 1);
  if (gap_after < std::abs(before_s - time_s)) return after - times_s.begin();
  return std::lower_bound(times_s.begin(), after, before_s) - times_s.begin();
}

}  // namespace

std::vector<PosePair> associate_times(const Eigen::VectorXd& ground_truth_s,
                                      const Eigen::VectorXd& estimate_s,
                                      const TimeAssociation& association) {
  if (!(association.largest_gap_s >= 0.0) || !std::isfinite(association.largest_gap_s))
    throw InvalidInput("the largest gap in time must be a number of seconds >= 0");
  if (!std::isfinite(association.offset_s))
    throw InvalidInput("the offset in time must be a finite number of seconds");
  const bool estimate_is_longer = estimate_s.size() > ground_truth_s.size();
  const Eigen::VectorXd& few = estimate_is_longer ? ground_truth_s : estimate_s;
  const Eigen::VectorXd many = estimate_is_longer
                                   ? Eigen::VectorXd(estimate_s.array() + association.offset_s)
                                   : Eigen::VectorXd(ground_truth_s.array() - association.offset_s);
  std::vector<PosePair> pairs;
  if (many.size() == 0) return pairs;
  for (Eigen::Index i = 0; i < few.size(); ++i) {
    const Eigen::Index k = nearest(many, few(i));
    if (!(std::abs(many(k) - few(i)) <= association.largest_gap_s)) continue;
    pairs.push_back(estimate_is_longer ? PosePair{i, k} : PosePair{k, i});
  }
  return pairs;
}

}  // namespace mapproof
