#pragma once

#include <optional>
#include <string_view>
#include <vector>

#include "core/missing/pca.hpp"
#include "core/observe/proximities.hpp"

namespace mapproof {

/// What becomes of missing entries before distances are taken.
enum class Filling {
  kCommonSteps,  ///< Nothing: sums run over common steps (see proximities).
  kPpca,         ///< Their expectation under probabilistic PCA.
  kPca,          ///< Their place in the plane of PCA with missing data.
  kMean,         ///< The landmark's mean. Fails: it is here to be compared with.
};

/// The name used in files and on the command line: "common-steps", "ppca", "pca", "mean".
std::string_view name(Filling filling);

/// The filling of that name; empty if there is none.
std::optional<Filling> filling_named(std::string_view name);

/// How the gaps are filled.
struct FillingOptions {
  Filling filling = Filling::kPpca;
  PpcaOptions ppca;
  RegularisedPcaOptions pca;
};

/// Proximities with what their filling ended in.
struct FilledProximities {
  Proximities proximities;
  std::vector<Status> statuses;
  LowRankModel model;  ///< That the gaps were filled from; empty for kCommonSteps and without gaps.
};

/// Which squared distances a model of the gaps gives.
enum class GapDistances {
  kOfFilled,  ///< Those of the filled values.
  /// PPCA: their expectation under the posterior, longer by the variance of what was filled in.
  /// Worse maps came of it: the noise of the model is what its few dimensions leave over, and
  /// that is much the same for near landmarks, so that short distances become too long.
  kExpected,
};

/// Proximities of histories whose gaps are filled from a model of them (see features).
/// @note O(E q^2 + C q^3) for E observed entries; kExpected O(M^2 q) for each column beside it.
Proximities filled_from(const Features& matrix, Sensor sensor, const LowRankModel& model,
                        GapDistances distances);

/// Proximities of all pairs of landmarks, common steps or none, from histories whose gaps are
/// filled. Without gaps, and for kCommonSteps, they are those of proximities().
///
/// @param history  Of landmarks that were all observed (see unseen_landmarks), two or more.
/// @param steps    How many observations to use, from the first.
/// @throws InvalidInput if `steps` or the options are out of bounds.
/// @note kPpca, kPca: see there.
FilledProximities filled_proximities(const ObservationHistory& history, Eigen::Index steps,
                                     const FillingOptions& options);

}  // namespace mapproof
