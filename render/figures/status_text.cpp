#include "render/figures/status_text.hpp"

#include <algorithm>
#include <cmath>
#include <string_view>

#include <fmt/format.h>

#include "core/base/text/words.hpp"

namespace mapproof {
namespace {

constexpr std::size_t kMostLandmarksNamed = 10;

std::string plural(double count, std::string_view noun) {
  return counted(std::llround(count), noun);
}

std::string listed_names(const Status& status) {
  return listed(status.names, kMostLandmarksNamed + 1);
}

std::string residual_words(double residual) {
  return fmt::format("The squared distances to be kept are off by up to {:.1e} of the largest.",
                     residual);
}

/// A sentence on a bound, and that of the residual where it is more than it may be.
std::string with_residual(const std::string& sentence, double residual) {
  return residual > 0.0 ? sentence + " " + residual_words(residual) : sentence;
}

std::string_view extent(double dimensions) { return dimensions == 2.0 ? "the plane" : "space"; }

/// "condition number 3.2e+04"; no number where there is none.
std::string condition_text(double condition) {
  return std::isfinite(condition) ? fmt::format("condition number {:.3g}", condition)
                                  : "infinite condition number";
}

std::string nearly_on_a_line(std::string_view what, std::string_view of_what, double condition) {
  return fmt::format(
      "{} nearly on one line, {}: the side of it on which {} lies is hardly determined.", what,
      condition_text(condition), of_what);
}

std::string reason_words(const Status& status) {
  const auto v = [&](std::size_t i) { return status.values.at(i); };
  switch (status.reason) {
    case StatusReason::kSameObservations:
      return "The observations of all landmarks are the same: the map is a point.";
    case StatusReason::kGroupsNeverTogether:
      return fmt::format(
          "The landmarks are in {} groups never seen together: how these lie to each other is "
          "arbitrary.",
          v(0));
    case StatusReason::kTooFewLandmarks:
      return fmt::format("A map needs 3 observed landmarks, {} are there.", v(0));
    case StatusReason::kTooManyNeighbours:
      return fmt::format("K = {} needs more than {} observed landmarks.", v(0), v(1));
    case StatusReason::kNoSharedObservation:
      return "Some groups of landmarks share no observation: nothing determines where they lie "
             "relative to each "
             "other.";
    case StatusReason::kNoCommonStep:
      return fmt::format(
          "{} of landmarks {} no step in common; {} distance is the shortest path over the others.",
          plural(v(0), "pair"), v(0) == 1.0 ? "has" : "have", v(0) == 1.0 ? "its" : "their");
    case StatusReason::kHessianNeighbours:
      return fmt::format("Hessian LLE of the plane needs K >= {}, K is {}.", v(0), v(1));
    case StatusReason::kHessianNeighbourhoods:
      return fmt::format("Hessian LLE needs {} neighbours of each landmark, {} have fewer.", v(0),
                         v(1));
    case StatusReason::kNeverObserved:
      return fmt::format("{} of {} landmarks were never observed and are not on the map{}{}.", v(0),
                         v(1), status.names.empty() ? "" : ": ", listed_names(status));
    case StatusReason::kFewSteps:
      return fmt::format("{} used, a map needs {} at least to mean anything.",
                         plural(v(0), "observation"), v(1));
    case StatusReason::kGraphInPieces:
      return fmt::format(
          "The graph of K = {} neighbours was in {} pieces; joined by its shortest bridges, the "
          "longest {:.3g}.",
          v(0), v(1), v(2));
    case StatusReason::kClosedGroups:
      return fmt::format(
          "Some groups of landmarks had all their neighbours among themselves; {} got one more, "
          "the "
          "nearest outside.",
          v(0));
    case StatusReason::kLandmarksUntied:
      return fmt::format(
          "{} {} not tied to the map by the neighbours of others, and joined {} own.",
          plural(v(0), "landmark"), v(0) == 1.0 ? "was" : "were", v(0) == 1.0 ? "its" : "their");
    case StatusReason::kFewSeenTogether:
      return fmt::format(
                 "{} {} fewer than K = {} others ever seen together with {}; the rest of the K are "
                 "arbitrary.",
                 plural(v(0), "landmark"), v(0) == 1.0 ? "has" : "have", v(1),
                 v(0) == 1.0 ? "it" : "them") +
             (v(2) > 1.0 ? fmt::format(" Without those the graph is in {} pieces: how they lie to "
                                       "each other is arbitrary too.",
                                       v(2))
                         : "");
    case StatusReason::kBoundBelowZero:
      return fmt::format(
          "No points have the distances to be kept, as the bound shows; the squared distances to "
          "be kept are off by up to {:.1e} of the largest.",
          v(0));
    case StatusReason::kNoBound:
      return with_residual("The greatest variance was not certified.", v(0));
    case StatusReason::kVarianceTooGreat:
      return with_residual(
          fmt::format(
              "The map spreads more than points that keep the distances can: their variance "
              "is at most {:.2g} % of its own.",
              v(0)),
          v(1));
    case StatusReason::kLooseBound:
      return with_residual(
          fmt::format("The greatest variance is bounded only to within {:.2g} %.", v(0)), v(1));
    case StatusReason::kDistancesNotKept:
      return residual_words(v(0));
    case StatusReason::kDistancesFlat:
      return fmt::format("The distances that the map is made of spread in {}, a map needs two.",
                         plural(v(0), "direction"));
    case StatusReason::kUnfoldedFlat:
      return fmt::format("The unfolded points spread in {}, a map needs two.",
                         plural(v(0), "direction"));
    case StatusReason::kEigenvaluesNotConverged:
      return "The eigenvalues' solver gave up; these are its best.";
    case StatusReason::kEqualEigenvalues:
      return fmt::format(
          "The second and third eigenvalue are equal ({:.4g}): which directions the map shows is "
          "arbitrary.",
          v(0));
    case StatusReason::kEqualSmallestEigenvalues:
      return fmt::format(
          "Beside the constant, eigenvalues {:.3g}, {:.3g} and {:.3g} are smallest, and the last "
          "two do not differ: which map of them came out is arbitrary.",
          v(0), v(1), v(2));
    case StatusReason::kNeighbourhoodsFlat:
      return "In every neighbourhood the observations spread in one direction alone.";
    case StatusReason::kNeighbourhoodsNotEuclidean:
      return fmt::format(
          "No points have the distances about {} of {} landmarks, as with missing entries; the "
          "nearest that some have were taken.",
          v(0), v(1));
    case StatusReason::kNoTangentPlane:
      return fmt::format(
          "{} of {} neighbourhoods spread in one direction alone: they have no tangent plane.",
          v(0), v(1));
    case StatusReason::kStressFalling:
      return fmt::format("The stress still fell after {} iterations.", v(0));
    case StatusReason::kFlatMap:
      return "The map is flat: its landmarks lie on one line or at one position.";
    case StatusReason::kEqualKernel:
      return fmt::format(
          "The kernel is nearly that of landmarks equally far from each other: its second "
          "eigenvalue is {:.3g} times the mean one. The map means little.",
          v(0));
    case StatusReason::kFewAnchorsMapped:
      return fmt::format("{} of {} anchors are on the map; an affine map needs 3.", v(0), v(1));
    case StatusReason::kAnchorsOnALine:
      return "The anchors lie on one line in the embedding: nothing ties its second axis to the "
             "ground truth.";
    case StatusReason::kFewAnchorsSoFar:
      return fmt::format(
          "{} on the map so far, or on one line; a fit to them needs 3 that span the plane.",
          plural(v(0), "anchor"));
    case StatusReason::kFewKnownMapped:
      return fmt::format("{} of known position mapped; a rigid fit takes 3 or more.",
                         plural(v(0), "landmark"));
    case StatusReason::kNoSubmap:
      return "No sub-map came out.";
    case StatusReason::kSubmapsLeftOut:
      return fmt::format(
          "{} of {} sub-maps share fewer than 3 landmarks, or 3 on one line, with the others and "
          "are left out.",
          v(0), v(1));
    case StatusReason::kLikelihoodRising:
      return fmt::format("The likelihood of PPCA still rose after {} iterations.", v(0));
    case StatusReason::kLossFalling:
      return fmt::format("The loss of PCA still fell after {} iterations.", v(0));
    case StatusReason::kTrustedPairsInPieces:
      return "The pairs of landmarks that can be trusted leave the map in pieces.";
    case StatusReason::kNotCovisible:
      return fmt::format(
          "{} of landmarks are not among the covisible ones that --missing covisible keeps ({} of "
          "them without a step in common); their distance is the shortest path over the others.",
          plural(v(0), "pair"), v(1));
    case StatusReason::kNeverMeasuredTogether:
      return fmt::format(
          "Range and bearing were never measured together with another's, so not mapped: {}.",
          listed_names(status));
    case StatusReason::kNotWithTheMapped:
      return fmt::format("In no scan with the {} landmarks that are mapped, so not mapped: {}.",
                         v(0), listed_names(status));
    case StatusReason::kFewPairs:
      return fmt::format(
          "Measured against fewer than three others, which leaves more than one position: {}.",
          listed_names(status));
    case StatusReason::kTooFewPairs:
      return fmt::format("{} measured, which hold no three landmarks together: nothing to map.",
                         plural(v(0), "pair"));
    case StatusReason::kNoSensorShares:
      return "Some groups of landmarks share no observation by any sensor.";
    case StatusReason::kNoSensorObserved:
      return fmt::format("{} not observed by any of the sensors.", plural(v(0), "landmark"));
    case StatusReason::kNotObservedSoFar:
      return fmt::format("{} of {} landmarks were not observed so far.", v(0), v(1));
    case StatusReason::kFilterLost:
      return fmt::format("The filter is lost: {} of {} ranges were gated out.", v(0), v(1));
    case StatusReason::kFewStepsWithMotion:
      return fmt::format("{} landmarks and {} steps with motion; {} and {} are needed.", v(0), v(1),
                         v(2), v(3));
    case StatusReason::kFrameNotTied:
      return fmt::format(
          "Known landmarks with ranges: {} of {}, and not two at different positions. They do not "
          "tie "
          "the frame, which is that of the first pose.",
          v(0), v(1));
    case StatusReason::kFlatInSpace:
      return fmt::format(
          "Landmarks or path lie on one plane or sphere, as far as the ranges determine: {}.",
          condition_text(v(0)));
    case StatusReason::kFewCommonRanges:
      return fmt::format("{} landmarks, ranged to together at {} times; {} at {} are needed.", v(0),
                         v(1), v(2), v(3));
    case StatusReason::kFewLandmarksAtSteps:
      return fmt::format("{} landmarks at {} steps; {} at {} are needed.", v(0), v(1), v(2), v(3));
    case StatusReason::kLandmarksNearlyOnALine:
      return nearly_on_a_line("The landmarks lie", "the robot was", v(0));
    case StatusReason::kPathNearlyOnALine:
      return nearly_on_a_line("The path lies", "a landmark stands", v(0));
    case StatusReason::kTooFewRanges:
      return fmt::format("Too few ranges for a position of {}.",
                         listed(status.names, kMostLandmarksNamed));
    case StatusReason::kNoQuadric:
      return fmt::format("No quadric of a path in {} fits the states: {}.", extent(v(0)),
                         condition_text(v(1)));
    case StatusReason::kOtherQuadric:
      return fmt::format(
          "Another quadric fits the states nearly as well as the one taken: {:.3g} times its "
          "misfit, {}.",
          v(0), condition_text(v(1)));
    case StatusReason::kMappedOnALine:
      return "The landmarks came out on one line: no positions.";
    case StatusReason::kRankOfRanges:
      return fmt::format(
          "Squared ranges have rank {} above the noise, {} is needed: {}. So "
          "it is where the robot or the landmarks keep to {}.",
          v(0), v(1), condition_text(v(2)),
          v(1) == 4.0 ? "a line or a circle" : "a plane or a sphere");
    case StatusReason::kNoCovariances:
      return "The ranges leave a landmark or the path free to move: there are no covariances.";
    case StatusReason::kCovariancesOfFirstPose:
      return "The covariances are relative to the first pose: it takes two landmarks in different "
             "positions to free them of the frame.";
    case StatusReason::kLeastSquaresNotConverged:
      return fmt::format("The least squares had not converged after {} iterations.", v(0));
    case StatusReason::kNoStepLowered:
      return "No step decreased the cost: this is the initial guess, aligned to the odometry.";
    case StatusReason::kFewStates:
      return fmt::format("{} states against {} on the other side; {} against {} are needed.", v(0),
                         v(1), v(2), v(3));
    case StatusReason::kStatesFlat:
      return fmt::format("The states do not span {} dimensions: {}.", v(0) == 4.0 ? "four" : "five",
                         condition_text(v(1)));
    case StatusReason::kFewKnownLandmarks:
      return fmt::format("{} landmarks are known, {} are needed.", v(0), v(1));
    case StatusReason::kKnownDegenerate:
      return fmt::format("The known landmarks lie on one {}: {}.",
                         v(0) == 2.0 ? "line or circle" : "plane or sphere", condition_text(v(1)));
    case StatusReason::kRankOfPath:
      return fmt::format(
          "The ranges do not determine positions from the known landmarks: their rank is lower "
          "than "
          "that of a path in {}.",
          extent(v(0)));
    case StatusReason::kStepsFlat:
      return fmt::format("The steps span {} dimensions; {} are needed.", v(0), v(1));
    case StatusReason::kMirrorImage:
      return fmt::format(
          "Odometry does not distinguish the map from its reflection: the fits differ only by "
          "{:.2g} %.",
          v(0));
    case StatusReason::kFewPosesWithRanges:
      return fmt::format(
          "All of {} landmarks are observed at {} of {} poses; {} at {} are needed. Landmark {} is "
          "observed at the fewest: {}.",
          v(0), v(1), v(2), v(3), v(4), status.names.at(0), v(5));
    case StatusReason::kPosesWithoutWindow:
      return fmt::format(
          "{} of {} poses have no window with enough measurements of every landmark; the path "
          "leaves them out. Landmark {} is observed at the fewest: {}.",
          v(0), v(1), status.names.at(0), v(2));
    case StatusReason::kNoKnownLandmark:
      return "No landmark's position is known.";
    case StatusReason::kNoOdometry:
      return "The log has no odometry.";
    case StatusReason::kNoOdometryForHeadings:
      return "The log has no odometry, which headings need.";
    case StatusReason::kNoStart:
      return "The spectral method gave nothing to start from.";
    case StatusReason::kMessage:
      return status.names.at(0);
  }
  return std::string(name(status.reason));
}

}  // namespace

std::string status_text(const Status& status) {
  std::string text;
  if (status.submaps)
    text = fmt::format("{} of {} sub-maps: ", status.submaps->count, status.submaps->submaps);
  for (const Method start : status.starts)
    text += fmt::format("Its start, {}: ", info(start).label);
  return text + reason_words(status);
}

void add_status_notes(const std::vector<std::string>& lines, std::vector<Note>& notes) {
  constexpr std::size_t kMost = 4;
  for (std::size_t i = 0; i < std::min(lines.size(), kMost); ++i)
    notes.push_back({"\u26A0 " + lines[i], ThemeColour::kWarning});
  if (lines.size() > kMost)
    notes.push_back({fmt::format("\u26A0 {} more, see the record.", lines.size() - kMost),
                     ThemeColour::kWarning});
}

}  // namespace mapproof
