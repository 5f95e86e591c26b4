#pragma once

#include <optional>
#include <string_view>
#include <vector>

#include "core/missing/pca.hpp"
#include "core/observe/proximities.hpp"

namespace mapproof {

/// What replaces missing entries before distances are computed.
enum class Filling {
  kCommonSteps,  ///< Nothing: pairwise-complete sums (see proximities).
  kPpca,         ///< Their expectation under probabilistic PCA.
  kPca,          ///< Their position in the plane of PCA with missing data.
  kMean,         ///< The landmark's mean. Fails: it is here for comparison.
};

/// The name used in files and on the command line: "common-steps", "ppca", "pca", "mean".
std::string_view name(Filling filling);

/// The filling of that name; empty if there is none.
std::optional<Filling> filling_named(std::string_view name);

/// How missing data are filled.
struct FillingOptions {
  Filling filling = Filling::kPpca;
  PpcaOptions ppca;
  RegularisedPcaOptions pca;
};

/// Proximities with the model and the statuses of their filling.
struct FilledProximities {
  Proximities proximities;
  std::vector<Status> statuses;
  LowRankModel
      model;  ///< The model of the filling; empty for kCommonSteps and without missing data.
};

/// Which squared distances a model of missing data gives.
enum class GapDistances {
  kOfFilled,  ///< Those of the filled values.
  /// PPCA: their expectation under the posterior, longer by the variance of what was filled in.
  /// Worse maps resulted: the model's noise is the residual of its few dimensions, and that is much
  /// the same for near landmarks, so that short distances become too long.
  kExpected,
};

/// Proximities of histories whose missing data are filled from a model of them (see features).
/// @note O(E q^2 + C q^3) for E observed entries; kExpected also O(M^2 q) for each column.
Proximities filled_from(const Features& matrix, Sensor sensor, const LowRankModel& model,
                        GapDistances distances);

/// Proximities of all pairs of landmarks, co-visible or not, from histories whose missing data are
/// filled. Without missing data, and for kCommonSteps, they are those of proximities().
///
/// @param history  Of landmarks that were all observed (see unseen_landmarks), two or more.
/// @param steps    How many observations to use, from the first.
/// @throws InvalidInput if `steps` or the options are out of bounds.
/// @note kPpca, kPca: see there.
FilledProximities filled_proximities(const ObservationHistory& history, Eigen::Index steps,
                                     const FillingOptions& options);

}  // namespace mapproof
