#include "core/score/orientation_error.hpp"

#include <cmath>
#include <cstdint>
#include <limits>

#include "core/base/errors.hpp"
#include "core/base/vectorised.hpp"

namespace mapproof {
namespace {

/// The sine of an angle that rounding alone may have opened.
constexpr double kStraight = 1e-12;

/// The points behind one, as seen from it: coordinates apart, so that they fill vectors.
struct Offsets {
  const double* x;
  const double* y;
};

struct Count {
  std::int64_t judged = 0;
  std::int64_t wrong = 0;
};

/// Of the triples that the offset `first` forms with all after it.
MAPPROOF_VECTORISED Count count_turns(Offsets truth, Offsets estimate, Eigen::Index first,
                                      Eigen::Index count) {
  const double tx = truth.x[first], ty = truth.y[first];
  const double ex = estimate.x[first], ey = estimate.y[first];
  std::int64_t judged = 0;
  std::int64_t wrong = 0;
  for (Eigen::Index k = first + 1; k < count; ++k) {
    const double turn = tx * truth.y[k] - ty * truth.x[k];
    const double found = ex * estimate.y[k] - ey * estimate.x[k];
    const bool counts = std::abs(turn) > kStraight;
    const bool right = ((turn > 0.0) & (found > 0.0)) | ((turn < 0.0) & (found < 0.0));
    judged += counts;
    wrong += counts & !right;
  }
  return {judged, wrong};
}

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
    const Offsets to_truth{t.col(0).data(), t.col(1).data()};
    const Offsets to_estimate{e.col(0).data(), e.col(1).data()};
    for (Eigen::Index j = 0; j < t.rows(); ++j) {
      const Count found = count_turns(to_truth, to_estimate, j, t.rows());
      judged += found.judged;
      wrong += found.wrong;
    }
  }
  if (judged == 0) return std::numeric_limits<double>::quiet_NaN();
  return 100.0 * static_cast<double>(wrong) / static_cast<double>(judged);
}

}  // namespace mapproof
