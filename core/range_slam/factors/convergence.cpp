#include "core/range_slam/factors/convergence.hpp"

#include <cmath>
#include <numbers>

#include "core/base/errors.hpp"
#include "core/linalg/decompositions.hpp"
#include "core/linalg/planarity.hpp"
#include "core/range_slam/known_landmarks.hpp"
#include "core/range_slam/localise.hpp"

namespace mapproof {
namespace {

Eigen::MatrixXd orthonormal(const Eigen::MatrixXd& A) {
  const Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr(A);
  if (qr.rank() < A.cols()) throw InvalidInput("a subspace needs independent columns");
  return leading_columns(qr.householderQ(), A.cols());
}

void check(const TrueRanges& world, Eigen::Index known, std::span<const Eigen::Index> steps) {
  if (world.ranges_m.rows() != world.landmarks_m.rows() ||
      world.ranges_m.cols() != world.positions_m.rows())
    throw InvalidInput("a world needs a range for each landmark and position");
  if (known < 4 || known > world.landmarks_m.rows())
    throw InvalidInput("4 landmarks or more, and no more than there are, must be known");
  for (const Eigen::Index count : steps)
    if (count < 4 || count > world.positions_m.rows())
      throw InvalidInput("a map needs 4 steps or more, and no more than there are");
}

double mean_distance(const Points& found, const Points& expected) {
  return (found - expected).rowwise().norm().mean();
}

}  // namespace

Eigen::VectorXd canonical_angles(const Eigen::MatrixXd& A, const Eigen::MatrixXd& B) {
  if (A.rows() != B.rows() || A.cols() != B.cols() || A.cols() < 1 || A.cols() > A.rows())
    throw InvalidInput("canonical angles need two subspaces of one dimension in one space");
  if (!A.allFinite() || !B.allFinite()) throw InvalidInput("a subspace needs finite columns");
  const Eigen::MatrixXd P = orthonormal(A), Q = orthonormal(B);
  const Eigen::MatrixXd common = P.transpose() * Q;
  const Eigen::VectorXd cosines = Eigen::JacobiSVD<Eigen::MatrixXd>(common).singularValues();
  const Eigen::VectorXd sines =
      Eigen::JacobiSVD<Eigen::MatrixXd>(Eigen::MatrixXd(Q - P * common)).singularValues().reverse();
  Eigen::VectorXd angles(A.cols());
  for (Eigen::Index i = 0; i < angles.size(); ++i)
    angles(i) = cosines(i) > std::numbers::sqrt2 / 2.0 ? std::asin(std::min(1.0, sines(i)))
                                                       : std::acos(std::min(1.0, cosines(i)));
  return angles;
}

double subspace_error_bound(Eigen::Index landmarks, Eigen::Index steps, double noise_constant,
                            double smallest_eigenvalue) {
  if (landmarks < 1 || steps < 2 || !(noise_constant >= 0.0) || !(smallest_eigenvalue > 0.0))
    throw InvalidInput("the bound needs landmarks, two steps, c >= 0 and gamma > 0");
  const double T = static_cast<double>(steps);
  return static_cast<double>(landmarks) * noise_constant * std::sqrt(2.0 * std::log(T) / T) /
         smallest_eigenvalue;
}

std::vector<ModelError> model_errors(const TrueRanges& world, std::span<const Eigen::Index> steps,
                                     const ModelErrorOptions& options) {
  const Eigen::Index known = options.known;
  check(world, known, steps);
  const Eigen::MatrixXd C = landmark_states(world.landmarks_m);
  const Eigen::MatrixXd Y = half_squared_ranges(world.ranges_m, world.noise);
  KnownLandmarks given{.rows = {}, .positions_m = world.landmarks_m.topRows(known)};
  for (Eigen::Index n = 0; n < known; ++n) given.rows.push_back(n);

  std::vector<ModelError> errors;
  for (const Eigen::Index count : steps) {
    const Eigen::MatrixXd first = Y.leftCols(count);
    const Factorization factors =
        options.subtract_variances
            ? factorize_without_noise(first, half_square_variances(first, world.noise), 4)
            : factorize(first, 4);
    const SpectralMap map = map_from_known_landmarks(factors, given);
    if (map.empty()) continue;
    const Points landmarks_m = landmarks_of(map.C);
    if (!(planarity(landmarks_m) > kFlatPlanarity)) continue;
    const Points positions_m = localise(landmarks_m, first);
    errors.push_back({.steps = count,
                      .observation = (map.C - C).norm(),
                      .landmarks_m = mean_distance(landmarks_m, world.landmarks_m),
                      .positions_m = mean_distance(positions_m, world.positions_m.topRows(count)),
                      .condition = map.condition.value(),
                      .sine = std::sin(canonical_angles(factors.U, C).maxCoeff())});
  }
  return errors;
}

}  // namespace mapproof
