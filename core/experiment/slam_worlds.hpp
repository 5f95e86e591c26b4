#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "core/model/points.hpp"
#include "core/model/slam/slam_experiment.hpp"
#include "core/model/slam/slam_study.hpp"
#include "core/range_slam/factors/squared_ranges.hpp"
#include "core/simulate/range_world.hpp"

namespace mapproof {

/// Canonical angles between the column spaces of A and B, ascending, in [0, pi/2] rad: small ones
/// by their sine, large ones by their cosine, so that all are accurate.
/// @param A, B  n x k with independent columns, finite, k <= n.
/// @throws InvalidInput if a bound is broken.
Eigen::VectorXd canonical_angles(const Eigen::MatrixXd& A, const Eigen::MatrixXd& B);

/// The bound on the sine of the largest canonical angle between the learned subspace and the true
/// one, N c sqrt(2 log(T) / T) / gamma [boots2013, eq. 5]; it falls as T^-1/2, so that an error
/// zeta takes some 1 / zeta^2 steps.
/// @param landmarks            N >= 1.
/// @param steps                T >= 2.
/// @param noise_constant       c, of the distribution of errors, >= 0.
/// @param smallest_eigenvalue  gamma, the smallest that is not zero of the true covariance Y Y'/T,
///                             > 0, in the unit of c.
/// @throws InvalidInput if a bound is broken.
double subspace_error_bound(Eigen::Index landmarks, Eigen::Index steps, double noise_constant,
                            double smallest_eigenvalue);

/// A world with its ranges, with which a map is compared.
struct TrueRanges {
  Points landmarks_m;        ///< N x 2.
  Points positions_m;        ///< T x 2.
  Eigen::MatrixXd ranges_m;  ///< N x T, noisy.
  RangeNoise noise;          ///< Of the ranges.
};

struct ModelErrorOptions {
  Eigen::Index known = 4;          ///< The first so many landmarks are given: 4 to N.
  bool subtract_variances = true;  ///< By factorize_without_noise(); else the plain SVD, as the
                                   ///< paper says, whose error does not fall below a floor.
};

/// Errors of a map made from the first steps of a world [boots2013, figure 1B].
struct ModelError {
  Eigen::Index steps = 0;
  double observation = 0.0;  ///< Frobenius norm of C-hat - C.
  double landmarks_m =
      0.0;  ///< Mean distance of landmarks from their true positions, known ones too.
  double positions_m = 0.0;  ///< Mean distance of positions, by localise(), from theirs.
  double condition = 1.0;  ///< Of the known landmarks (see map_from_known_landmarks()): where they
                           ///< happen to lie near a circle errors are great, and so their mean.
  double sine = 0.0;       ///< Of the largest canonical angle between U and C.
};

/// Maps the world from its first steps and the positions of known landmarks, for each number of
/// steps.
/// @param steps  Each 4 to T.
/// @return One error for each number of steps for which a map was found.
/// @throws InvalidInput if a bound is broken.
/// @note O(N^2) time per step.
std::vector<ModelError> model_errors(const TrueRanges& world, std::span<const Eigen::Index> steps,
                                     const ModelErrorOptions& options = {});

/// The simulator's options for so many landmarks and steps.
RangeWorldOptions range_world_options(const SlamWorldOptions& world, const RangeNoiseModel& noise,
                                      int landmarks, int steps);

/// The standard deviations of a noise model.
RangeNoise range_noise(const RangeNoiseModel& noise);

/// The run of an experiment's example: all landmarks ranged to at every second, no odometry.
/// @throws InvalidInput if it has no example.
SlamRun make_example(const SlamExperiment& experiment, std::vector<SlamTiming>& timings);

/// Errors as measurements come in, over all pairs; these run in parallel, and share their worlds,
/// walks and random numbers over the noise models. A pair without a map at some number of steps
/// does not count there.
ConvergenceCurve make_convergence(const SlamExperiment& experiment, const RangeNoiseModel& noise);

/// Every mapping method on ranges and on squared ranges of one world, and the spectral map.
/// @throws InvalidInput if the experiment has no such part.
RangeHistoryStudy make_histories(const SlamExperiment& experiment);

/// The maps of the ranges of one flight in space, with landmarks known and with none.
/// @throws InvalidInput if the experiment has no such part.
SpaceRun make_space_run(const SlamExperiment& experiment);

/// Seconds of factorisation and upgrade over the experiment's grid, the least of five times each.
std::vector<FactorizationCost> time_factorization(const SlamExperiment& experiment);

}  // namespace mapproof
