#include "core/range_slam/factors/synchronous_slam.hpp"

#include <algorithm>

#include "core/base/errors.hpp"
#include "core/base/not_finite.hpp"
#include "core/linalg/planarity.hpp"
#include "core/range_slam/factors/metric_upgrade.hpp"
#include "core/range_slam/known_landmarks.hpp"
#include "core/range_slam/localise.hpp"
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
  estimate.landmarks_m = SpacePoints::Constant(N, 3, kNaN);
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

  const SpectralMap map = known ? map_from_known_positions(factors, known->rows, known->positions_m)
                                : metric_upgrade(factors).map;
  estimate.condition = map.condition;
  estimate.range_scale = map.range_scale;
  estimate.statuses = map.statuses;
  if (map.empty()) return estimate;
  estimate.landmarks_m = space_landmarks_of(map.C);
  estimate.positions_m = space_positions_of(map.X);
  return estimate;
}

SynchronousRanges synchronous_ranges(const std::vector<RangeMeasurement>& ranges,
                                     Eigen::Index landmarks) {
  SynchronousRanges common;
  std::vector<double> times;
  std::vector<Eigen::VectorXd> columns;
  for (std::size_t i = 0; i < ranges.size();) {
    const double time_s = ranges[i].time_s;
    Eigen::VectorXd column = Eigen::VectorXd::Constant(landmarks, kNaN);
    for (; i < ranges.size() && ranges[i].time_s == time_s; ++i) {
      if (ranges[i].landmark < 0 || ranges[i].landmark >= landmarks)
        throw InvalidInput("a measurement of no landmark");
      column(ranges[i].landmark) = ranges[i].range_m;
    }
    if (column.allFinite()) {
      times.push_back(time_s);
      columns.push_back(std::move(column));
    } else {
      ++common.incomplete;
    }
  }
  const auto T = static_cast<Eigen::Index>(times.size());
  common.time_s = Eigen::Map<const Eigen::VectorXd>(times.data(), T);
  common.ranges_m.resize(landmarks, T);
  for (Eigen::Index t = 0; t < T; ++t)
    common.ranges_m.col(t) = columns[static_cast<std::size_t>(t)];
  return common;
}

SynchronousSlam synchronous_slam(const SynchronousRanges& ranges,
                                 const std::optional<KnownLandmarks>& known,
                                 const RangeNoise& noise) {
  const Eigen::Index N = ranges.ranges_m.rows();
  const Eigen::Index T = ranges.ranges_m.cols();
  SynchronousSlam found;
  SlamEstimate& estimate = found.estimate;
  estimate.path.positions_m.resize(0, 2);
  estimate.landmarks_m = Points::Constant(N, 2, kNaN);
  if (N < 4 || T < 8) {
    estimate.statuses.push_back(status_of<StatusReason::kFewCommonRanges>(N, T, 4, 8));
    return found;
  }
  Eigen::MatrixXd Y = half_squared_ranges(ranges.ranges_m, noise);
  const Factorization factors = noise.sigma_m > 0.0 || noise.share > 0.0
                                    ? factorize_without_noise(Y, half_square_variances(Y, noise), 4)
                                    : factorize(Y, 4);
  if (!known) found.upgrade = metric_upgrade(factors);
  const SpectralMap map = known ? map_from_known_landmarks(factors, *known) : found.upgrade.map;
  estimate.singular_values = factors.singular_values;
  if (N > 4) estimate.noise_level = factors.noise_floor;
  estimate.condition = map.condition;
  estimate.range_scale = map.range_scale;
  estimate.statuses = factors.statuses;
  estimate.statuses.insert(estimate.statuses.end(), map.statuses.begin(), map.statuses.end());
  if (map.empty()) return found;
  const Points landmarks_m = landmarks_of(map.C);
  if (!(planarity(landmarks_m) > kFlatPlanarity)) {
    estimate.statuses.push_back(status_of<StatusReason::kMappedOnALine>());
    return found;
  }
  Y /= map.range_scale * map.range_scale;
  estimate.landmarks_m = landmarks_m;
  estimate.path = {
      .time_s = ranges.time_s, .positions_m = localise(landmarks_m, Y), .heading_rad = {}};
  return found;
}

}  // namespace mapproof
