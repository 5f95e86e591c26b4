#include <cmath>

#include <gtest/gtest.h>
#include <Eigen/LU>

#include "core/align/rigid.hpp"
#include "core/base/random.hpp"
#include "core/range_slam/fit/log_fit.hpp"
#include "core/simulate/range_world.hpp"

namespace mapproof {
namespace {

constexpr double kEllipse95 = 5.991464547107979;  // Chi-squared of 2 degrees of freedom.

/// A drive among 4 to 7 landmarks; each noise is a third to three times the usual one, and the
/// errors of every other drive are correlated in time.
RangeDriveOptions noisy_drive(Random& random, double offset_sigma_m) {
  RangeDriveOptions options;
  options.landmarks = 4 + static_cast<int>(4.0 * random.uniform());
  const auto factor = [&] { return std::exp(random.uniform(-1.0986, 1.0986)); };
  options.forward_sigma_m *= factor();
  options.heading_change_sigma_rad *= factor();
  options.range_sigma_m *= factor();
  options.range_scale = random.uniform(0.95, 1.07);
  if (random.uniform() < 0.5) options.correlation = 0.5;
  options.offset_sigma_m = offset_sigma_m;
  return options;
}

struct EllipseCounts {
  double drives = 0.0, alarms = 0.0;
  double landmarks = 0.0, inside = 0.0, squared = 0.0;  ///< Of drives that fit.

  double inside_percent() const { return 100.0 * inside / landmarks; }
  double nees() const { return squared / landmarks; }
};

void count_ellipses(const LogFit& fit, const Points& true_landmarks_m, EllipseCounts& counts) {
  const Points& mapped = fit.estimate.landmarks_m;
  const Points in_map =
      Points(fit_similarity(true_landmarks_m, mapped, Alignment::kRigid)(true_landmarks_m));
  for (Eigen::Index n = 0; n < mapped.rows(); ++n) {
    const Eigen::Vector2d error = (mapped.row(n) - in_map.row(n)).transpose();
    const Eigen::Matrix2d& C = fit.estimate.landmark_cov_m2[static_cast<std::size_t>(n)];
    const double squared = error.dot(C.inverse() * error);
    counts.landmarks += 1.0;
    counts.inside += squared <= kEllipse95 ? 1.0 : 0.0;
    counts.squared += squared;
  }
}

EllipseCounts counts_of(double offset_sigma_m, std::uint64_t drives) {
  LogFitOptions options;
  options.test_keys = options.final_keys = 120;
  options.odometry_scale_sigma = 0.0;
  EllipseCounts counts;
  for (std::uint64_t drive = 0; drive < drives; ++drive) {
    Random random(derive_seed(77, {drive}));
    const RangeLog log = simulate_drive(noisy_drive(random, offset_sigma_m), {}, random);
    const LogFit fit = fit_log(log, {}, options);
    counts.drives += 1.0;
    if (fit.fit.verdict == FitVerdict::kFits)
      count_ellipses(fit, *log.true_landmarks, counts);
    else
      counts.alarms += 1.0;
  }
  return counts;
}

// The bounds are those of docs/methods/measurements.md over 200 drives, and what 40 drives vary.
TEST(LogCoverage, HoldsWhateverTheNoise) {
  const EllipseCounts counts = counts_of(0.0, 40);
  EXPECT_LE(counts.alarms, 0.1 * counts.drives);
  EXPECT_GE(counts.inside_percent(), 91.0);
  EXPECT_LE(counts.inside_percent(), 99.0);
  EXPECT_GE(counts.nees(), 1.4);
  EXPECT_LE(counts.nees(), 2.6);
}

TEST(LogCoverage, HoldsWithOffsetsThatAreTooSmallToBeSeen) {
  const EllipseCounts counts = counts_of(0.1, 40);
  EXPECT_GE(counts.inside_percent(), 90.0);
  EXPECT_LE(counts.nees(), 2.7);
}

}  // namespace
}  // namespace mapproof
