#include "core/range_slam/factors/space_slam.hpp"

#include <algorithm>
#include <limits>

#include "core/base/errors.hpp"
#include "core/range_slam/factors/metric_upgrade.hpp"
#include "core/range_slam/known_landmarks.hpp"
#include "core/range_slam/log_checks.hpp"

namespace mapproof {
namespace {

constexpr Eigen::Index kRankInSpace = 5;
constexpr Eigen::Index kLeastStepsInSpace =
    13;  // All but two coefficients of a quadric of 5 variables.

/// A condition of the factors, squares being squares: from here on the heights, or the other
/// direction that is missing, are ten thousand times less than the extent.
constexpr double kFlatCondition = 1e8;

Factorization factors_of(const Eigen::MatrixXd& Y, const RangeNoise& noise) {
  if (noise.sigma_m > 0.0 || noise.share > 0.0)
    return factorize_without_noise(Y, half_square_variances(Y, noise), kRankInSpace);
  return factorize(Y, kRankInSpace);
}

/// Whether the fifth dimension is there; adds why not. It is not where it has less of the squares
/// than noise has in one direction.
bool spans_space(const Factorization& factors, double noise_square, std::vector<Status>& statuses) {
  const bool is_noise = std::ranges::any_of(
      factors.statuses, [](const Status& s) { return s.code == StatusCode::kRankDeficient; });
  const double least = factors.singular_values(kRankInSpace - 1);
  if (!is_noise && factors.condition < kFlatCondition && least * least > noise_square) return true;
  statuses.push_back(status_of<StatusReason::kFlatInSpace>(factors.condition));
  return false;
}

}  // namespace

SpaceEstimate space_slam(const Eigen::MatrixXd& ranges_m,
                         const std::optional<KnownSpaceLandmarks>& known, const RangeNoise& noise) {
  const Eigen::Index N = ranges_m.rows(), T = ranges_m.cols();
  if (known)
    if (const auto problem = known_problem(known->rows, known->positions_m, N); !problem.empty())
      throw InvalidInput(problem);
  const Eigen::MatrixXd Y = half_squared_ranges(ranges_m, noise);
  SpaceEstimate estimate;
  estimate.positions_m.resize(0, 3);
  estimate.landmarks_m = SpacePoints::Constant(N, 3, std::numeric_limits<double>::quiet_NaN());
  if (N < kRankInSpace || T < kLeastStepsInSpace) {
    estimate.statuses.push_back(
        status_of<StatusReason::kFewCommonRanges>(N, T, kRankInSpace, kLeastStepsInSpace));
    return estimate;
  }
  const Factorization factors = factors_of(Y, noise);
  estimate.singular_values = factors.singular_values;
  if (N > kRankInSpace) estimate.noise_level = factors.noise_floor;
  estimate.statuses = factors.statuses;
  const double noise_square = static_cast<double>(T) * half_square_variances(Y, noise).mean();
  if (!spans_space(factors, noise_square, estimate.statuses)) return estimate;

  const SpectralMap map = known ? map_from_known_places(factors, known->rows, known->positions_m)
                                : metric_upgrade(factors).map;
  estimate.condition = map.condition;
  estimate.range_scale = map.range_scale;
  estimate.statuses = map.statuses;
  if (map.empty()) return estimate;
  estimate.landmarks_m = space_landmarks_of(map.C);
  estimate.positions_m = space_positions_of(map.X);
  return estimate;
}

}  // namespace mapproof
