#pragma once

#include <optional>
#include <string_view>
#include <vector>

#include "core/missing/ppca.hpp"
#include "core/missing/regularised_pca.hpp"
#include "core/observe/proximities.hpp"

namespace mapproof {

/// What becomes of missing entries before distances are taken.
enum class Filling {
  kCommonSteps,  ///< Nothing: sums run over common steps (see proximities).
  kPpca,         ///< Their expectation under probabilistic PCA, and its variance.
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
  /// kPpca: distances are the expectation of squared distances under the posterior, whose variance
  /// lengthens those of landmarks with many gaps; false: distances of the filled values, which
  /// stand closer together than true ones.
  bool expected_squares = true;
};

/// Proximities with what their filling ended in.
struct FilledProximities {
  Proximities proximities;
  std::vector<Status> statuses;
  int dimensions = 0;  ///< Used: those asked for, or one fewer than landmarks.
};

/// Proximities of all pairs of landmarks, common steps or none, from histories whose gaps are
/// filled. Without gaps, and for kCommonSteps, they are those of proximities().
///
/// @param history  Of landmarks that were all observed (see unseen_landmarks), two or more.
/// @param steps    How many observations to use, from the first.
/// @throws InvalidInput if `steps` or the options are out of bounds.
/// @note kPpca, kPca: see there; and O(M^2 q) for each step, with expected squares.
FilledProximities filled_proximities(const ObservationHistory& history, Eigen::Index steps,
                                     const FillingOptions& options);

}  // namespace mapproof
