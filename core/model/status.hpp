#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace mapproof {

/// How a solve ended other than well. Data, never an exception: drawn on figures, listed in
/// reports.
enum class StatusCode {
  kBridged,              ///< The neighbour graph was in pieces; joined by the shortest bridges.
  kNotConverged,         ///< The iteration limit came before the stop rule.
  kUnproved,             ///< The answer of a semidefinite program was not proved to be the best.
  kRankDeficient,        ///< Fewer than two dimensions in the data: the map is flat or a point.
  kUndetermined,         ///< Other maps fit equally well; which of them came out is arbitrary.
  kArbitraryNeighbours,  ///< Landmarks with fewer than K others ever seen together with them.
  kLandmarkUnseen,       ///< Landmarks never observed; they are missing from the map.
  kDistancesCompleted,   ///< Pairs without a common step took the shortest path over the others.
  kNotEuclidean,         ///< No points have the observed distances; the nearest that some have were
                         ///< taken.
  kAnchorsMissing,       ///< Too few mapped anchors for an affine map: no score.
  kAnchorsDegenerate,    ///< Anchors nearly on one line in the embedding: the affine map is
                         ///< arbitrary.
  kDegenerateGeometry,   ///< Known landmarks or path in a special position, e.g. on one line or
                         ///< circle: the condition number says so.
  kTooFewObservations,   ///< Fewer steps, landmarks or readings than the method needs.
  kFailed,               ///< No map came out at all; the detail says why.
};

/// One thing that went other than well, with what was done about it.
struct Status {
  StatusCode code;
  std::string detail;  ///< One sentence with the numbers, for a reader.

  bool operator==(const Status&) const = default;
};

/// The name used in files ("bridged", "not_converged", ...).
std::string_view name(StatusCode code);

/// The code of that name; empty if there is none.
std::optional<StatusCode> status_code_named(std::string_view name);

}  // namespace mapproof
