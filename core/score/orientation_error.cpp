#include "core/score/orientation_error.hpp"

#include <cstdint>
#include <limits>

#include "core/base/errors.hpp"

namespace mapproof {
namespace {

/// The sine of an angle that rounding alone may have opened.
constexpr double kStraight = 1e-12;

}  // namespace

double orientation_error_percent(const Points& truth, const Points& estimate) {
  const Eigen::Index n = truth.rows();
  if (estimate.rows() != n) throw InvalidInput("truth and estimate differ in size");
  std::int64_t judged = 0;
  std::int64_t wrong = 0;
  for (Eigen::Index i = 0; i < n; ++i) {
    // Of length one, so that each turn is a sine; NaN where two points coincide.
    const Points t = (truth.bottomRows(n - i - 1).rowwise() - truth.row(i)).rowwise().normalized();
    const Points e = estimate.bottomRows(n - i - 1).rowwise() - estimate.row(i);
    for (Eigen::Index j = 0; j < t.rows(); ++j) {
      const auto rest = t.rows() - j - 1;
      const auto turn =
          t(j, 0) * t.col(1).tail(rest).array() - t(j, 1) * t.col(0).tail(rest).array();
      const auto found =
          e(j, 0) * e.col(1).tail(rest).array() - e(j, 1) * e.col(0).tail(rest).array();
      const auto counts = turn.abs() > kStraight;
      judged += counts.count();
      wrong += (counts && !((turn > 0.0 && found > 0.0) || (turn < 0.0 && found < 0.0))).count();
    }
  }
  if (judged == 0) return std::numeric_limits<double>::quiet_NaN();
  return 100.0 * static_cast<double>(wrong) / static_cast<double>(judged);
}

}  // namespace mapproof
