#include "core/statistics/nemenyi.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <numeric>

#include <boost/math/tools/roots.hpp>

#include "core/base/errors.hpp"

namespace mapproof {
namespace {

constexpr int kMostGroups = 10'000;
constexpr double kLeastAlpha = 1e-12;
constexpr double kMostAlpha = 0.999;
constexpr double kFarthest = 40.0;  ///< No range reaches it with kLeastAlpha.

double density(double z) { return std::exp(-0.5 * z * z) / std::sqrt(2.0 * std::numbers::pi); }

double below(double z) { return 0.5 * std::erfc(-z / std::numbers::sqrt2); }

/// P(range of k standard normal values > q)
///   = k * integral of density(z) * (below(z)^(k-1) - (below(z) - below(z - q))^(k-1)),
/// z being the largest of them. Written as one difference, a small probability keeps its digits;
/// the trapezoidal rule converges exponentially for such integrands.
double range_exceeds(double q, int groups) {
  constexpr double kLow = -9.0;
  constexpr double kHigh = 12.0;
  constexpr int kIntervals = 420;
  const double power = groups - 1.0;
  double sum = 0.0;
  for (int i = 0; i <= kIntervals; ++i) {
    const double z = kLow + (kHigh - kLow) * i / kIntervals;
    const double all = below(z);
    const double share = below(z - q) / all;  // of those below z, more than q below.
    sum += density(z) * std::pow(all, power) * -std::expm1(power * std::log1p(-share));
  }
  return groups * sum * (kHigh - kLow) / kIntervals;
}

}  // namespace

double studentized_range_quantile(int groups, double alpha) {
  if (groups < 2 || groups > kMostGroups)
    throw InvalidInput("studentized_range_quantile: 2 to 10000 groups are needed");
  if (!(alpha >= kLeastAlpha && alpha <= kMostAlpha))
    throw InvalidInput("studentized_range_quantile: alpha must lie between 1e-12 and .999");
  std::uintmax_t steps = 200;
  const auto [low, high] = boost::math::tools::toms748_solve(
      [&](double q) { return std::log(range_exceeds(q, groups) / alpha); }, 1e-9, kFarthest,
      boost::math::tools::eps_tolerance<double>(45), steps);
  return 0.5 * (low + high);
}

double nemenyi_critical_difference(int methods, int units, double alpha) {
  if (units < 1) throw InvalidInput("nemenyi_critical_difference: at least one unit is needed");
  const double k = methods;
  return studentized_range_quantile(methods, alpha) / std::numbers::sqrt2 *
         std::sqrt(k * (k + 1.0) / (6.0 * units));
}

std::vector<std::vector<int>> alike_groups(std::span<const double> mean_ranks,
                                           double critical_difference) {
  if (!std::ranges::all_of(mean_ranks, [](double rank) { return std::isfinite(rank); }))
    throw InvalidInput("alike_groups: a rank is not finite");
  std::vector<int> order(mean_ranks.size());
  std::iota(order.begin(), order.end(), 0);
  const auto rank = [&](int method) { return mean_ranks[static_cast<std::size_t>(method)]; };
  std::ranges::stable_sort(order, {}, rank);

  std::vector<std::vector<int>> groups;
  auto reached = order.begin();  // End of the set before: a set that ends there is part of it.
  for (auto first = order.begin(); first != order.end(); ++first) {
    const auto end = std::find_if(first, order.end(), [&](int method) {
      return method != *first && rank(method) - rank(*first) >= critical_difference;
    });
    if (end - first >= 2 && end > reached) groups.emplace_back(first, end);
    reached = std::max(reached, end);
  }
  return groups;
}

}  // namespace mapproof
