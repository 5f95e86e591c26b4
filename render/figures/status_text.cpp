#include "render/figures/status_text.hpp"

#include <algorithm>
#include <cmath>
#include <map>
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

std::string nearly_on_a_line(std::string_view what, std::string_view which, double condition) {
  return fmt::format("{} nearly on one line, {}: on which side of it {} is hardly determined.",
                     what, condition_text(condition), which);
}

/// A status whose reason is put in words.
struct Reason {
  const Status& status;

  double operator()(std::size_t i) const { return status.values.at(i); }
};

/// The sentence of each reason.
const std::map<StatusReason, std::string (*)(const Reason&)> kSentences = {
    {StatusReason::kSameObservations,
     [](const Reason&) -> std::string {
       return "The distances between the observations of all landmarks are 0: the map is a point. "
              "The observations are equal, or differ by less than double precision can square.";
     }},
    {StatusReason::kGroupsNeverTogether,
     [](const Reason& of) -> std::string {
       return fmt::format(
           "The landmarks are in {} groups never seen together: how these lie to each other is "
           "arbitrary.",
           of(0));
     }},
    {StatusReason::kTooFewLandmarks,
     [](const Reason& of) -> std::string {
       return fmt::format("A map needs 3 observed landmarks, {} are there.", of(0));
     }},
    {StatusReason::kTooManyNeighbours,
     [](const Reason& of) -> std::string {
       return fmt::format("K = {} needs more than {} observed landmarks.", of(0), of(1));
     }},
    {StatusReason::kNoSharedObservation,
     [](const Reason&) -> std::string {
       return "Some groups of landmarks share no observation: nothing determines where they lie "
              "relative to each "
              "other.";
     }},
    {StatusReason::kNoCommonStep,
     [](const Reason& of) -> std::string {
       return fmt::format(
           "{} of landmarks {} no step in common; {} distance is the shortest path over the "
           "others.",
           plural(of(0), "pair"), of(0) == 1.0 ? "has" : "have", of(0) == 1.0 ? "its" : "their");
     }},
    {StatusReason::kHessianNeighbours,
     [](const Reason& of) -> std::string {
       return fmt::format("Hessian LLE of the plane needs K >= {}, K is {}.", of(0), of(1));
     }},
    {StatusReason::kHessianNeighbourhoods,
     [](const Reason& of) -> std::string {
       return fmt::format("Hessian LLE needs {} neighbours of each landmark, {} have fewer.", of(0),
                          of(1));
     }},
    {StatusReason::kNeverObserved,
     [](const Reason& of) -> std::string {
       return fmt::format("{} of {} landmarks were never observed and are not on the map{}{}.",
                          of(0), of(1), of.status.names.empty() ? "" : ": ",
                          listed_names(of.status));
     }},
    {StatusReason::kFewSteps,
     [](const Reason& of) -> std::string {
       return fmt::format("{} used, a map needs {} at least to mean anything.",
                          plural(of(0), "observation"), of(1));
     }},
    {StatusReason::kGraphInPieces,
     [](const Reason& of) -> std::string {
       return fmt::format(
           "The graph of K = {} neighbours was in {} pieces; joined by its shortest bridges, the "
           "longest {:.3g}.",
           of(0), of(1), of(2));
     }},
    {StatusReason::kClosedGroups,
     [](const Reason& of) -> std::string {
       return fmt::format(
           "Some groups of landmarks had all their neighbours among themselves; {} got one more, "
           "the "
           "nearest outside.",
           of(0));
     }},
    {StatusReason::kLandmarksUntied,
     [](const Reason& of) -> std::string {
       return fmt::format(
           "{} {} not tied to the map by the neighbours of others, and joined {} own.",
           plural(of(0), "landmark"), of(0) == 1.0 ? "was" : "were",
           of(0) == 1.0 ? "its" : "their");
     }},
    {StatusReason::kFewSeenTogether,
     [](const Reason& of) -> std::string {
       return fmt::format(
                  "{} {} fewer than K = {} others ever seen together with {}; the rest of the K "
                  "are "
                  "arbitrary.",
                  plural(of(0), "landmark"), of(0) == 1.0 ? "has" : "have", of(1),
                  of(0) == 1.0 ? "it" : "them") +
              (of(2) > 1.0
                   ? fmt::format(" Without those the graph is in {} pieces: how they lie to "
                                 "each other is arbitrary too.",
                                 of(2))
                   : "");
     }},
    {StatusReason::kBoundBelowZero,
     [](const Reason& of) -> std::string {
       return fmt::format(
           "No points have the distances to be kept, as the bound shows; the squared distances to "
           "be kept are off by up to {:.1e} of the largest.",
           of(0));
     }},
    {StatusReason::kNoBound,
     [](const Reason& of) -> std::string {
       return with_residual("The greatest variance was not certified.", of(0));
     }},
    {StatusReason::kVarianceTooGreat,
     [](const Reason& of) -> std::string {
       return with_residual(
           fmt::format(
               "The map spreads more than points that keep the distances can: their variance "
               "is at most {:.2g} % of its own.",
               of(0)),
           of(1));
     }},
    {StatusReason::kLooseBound,
     [](const Reason& of) -> std::string {
       return with_residual(
           fmt::format("The greatest variance is bounded only to within {:.2g} %.", of(0)), of(1));
     }},
    {StatusReason::kDistancesNotKept,
     [](const Reason& of) -> std::string { return residual_words(of(0)); }},
    {StatusReason::kDistancesFlat,
     [](const Reason& of) -> std::string {
       return fmt::format("The distances that the map is made of spread in {}, a map needs two.",
                          plural(of(0), "direction"));
     }},
    {StatusReason::kUnfoldedFlat,
     [](const Reason& of) -> std::string {
       return fmt::format("The unfolded points spread in {}, a map needs two.",
                          plural(of(0), "direction"));
     }},
    {StatusReason::kEigenvaluesNotConverged,
     [](const Reason&) -> std::string {
       return "The eigenvalues' solver gave up; these are its best.";
     }},
    {StatusReason::kEqualEigenvalues,
     [](const Reason& of) -> std::string {
       return fmt::format(
           "The second and third eigenvalue are equal ({:.4g}): which directions the map shows is "
           "arbitrary.",
           of(0));
     }},
    {StatusReason::kEqualSmallestEigenvalues,
     [](const Reason& of) -> std::string {
       return fmt::format(
           "Beside the constant, eigenvalues {:.3g}, {:.3g} and {:.3g} are smallest, and the last "
           "two do not differ: which map of them came out is arbitrary.",
           of(0), of(1), of(2));
     }},
    {StatusReason::kNeighbourhoodsFlat,
     [](const Reason&) -> std::string {
       return "In every neighbourhood the observations spread in one direction alone.";
     }},
    {StatusReason::kNeighbourhoodsNotEuclidean,
     [](const Reason& of) -> std::string {
       return fmt::format(
           "No points have the distances about {} of {} landmarks, as with missing entries; the "
           "nearest that some have were taken.",
           of(0), of(1));
     }},
    {StatusReason::kNoTangentPlane,
     [](const Reason& of) -> std::string {
       return fmt::format(
           "{} of {} neighbourhoods spread in one direction alone: they have no tangent plane.",
           of(0), of(1));
     }},
    {StatusReason::kStressFalling,
     [](const Reason& of) -> std::string {
       return fmt::format("The stress still fell after {} iterations.", of(0));
     }},
    {StatusReason::kFlatMap,
     [](const Reason&) -> std::string {
       return "The map is flat: its landmarks lie on one line or at one position.";
     }},
    {StatusReason::kEqualKernel,
     [](const Reason& of) -> std::string {
       return fmt::format(
           "The kernel is nearly that of landmarks equally far from each other: its second "
           "eigenvalue is {:.3g} times the mean one. The map means little.",
           of(0));
     }},
    {StatusReason::kFewAnchorsMapped,
     [](const Reason& of) -> std::string {
       return fmt::format("{} of {} anchors are on the map; an affine map needs 3.", of(0), of(1));
     }},
    {StatusReason::kAnchorsOnALine,
     [](const Reason&) -> std::string {
       return "The anchors lie on one line in the embedding: nothing ties its second axis to the "
              "ground truth.";
     }},
    {StatusReason::kFewAnchorsSoFar,
     [](const Reason& of) -> std::string {
       return fmt::format(
           "{} on the map so far, or on one line; a fit to them needs 3 that span the plane.",
           plural(of(0), "anchor"));
     }},
    {StatusReason::kFewKnownMapped,
     [](const Reason& of) -> std::string {
       return fmt::format("{} of known position mapped; a rigid fit takes 3 or more.",
                          plural(of(0), "landmark"));
     }},
    {StatusReason::kNoSubmap, [](const Reason&) -> std::string { return "No sub-map came out."; }},
    {StatusReason::kSubmapsLeftOut,
     [](const Reason& of) -> std::string {
       return fmt::format(
           "{} of {} sub-maps share fewer than 3 landmarks, or 3 on one line, with the others and "
           "are left out.",
           of(0), of(1));
     }},
    {StatusReason::kLikelihoodRising,
     [](const Reason& of) -> std::string {
       return fmt::format("The likelihood of PPCA still rose after {} iterations.", of(0));
     }},
    {StatusReason::kLossFalling,
     [](const Reason& of) -> std::string {
       return fmt::format("The loss of PCA still fell after {} iterations.", of(0));
     }},
    {StatusReason::kTrustedPairsInPieces,
     [](const Reason&) -> std::string {
       return "The pairs of landmarks that can be trusted leave the map in pieces.";
     }},
    {StatusReason::kNotCovisible,
     [](const Reason& of) -> std::string {
       return fmt::format(
           "{} of landmarks are not among the covisible ones that --missing covisible keeps ({} of "
           "them without a step in common); their distance is the shortest path over the others.",
           plural(of(0), "pair"), of(1));
     }},
    {StatusReason::kNeverMeasuredTogether,
     [](const Reason& of) -> std::string {
       return fmt::format(
           "Range and bearing were never measured together with another's, so not mapped: {}.",
           listed_names(of.status));
     }},
    {StatusReason::kNotWithTheMapped,
     [](const Reason& of) -> std::string {
       return fmt::format("In no scan with the {} landmarks that are mapped, so not mapped: {}.",
                          of(0), listed_names(of.status));
     }},
    {StatusReason::kFewPairs,
     [](const Reason& of) -> std::string {
       return fmt::format(
           "Measured against fewer than three others, which leaves more than one position: {}.",
           listed_names(of.status));
     }},
    {StatusReason::kTooFewPairs,
     [](const Reason& of) -> std::string {
       return fmt::format("{} measured, which hold no three landmarks together: nothing to map.",
                          plural(of(0), "pair"));
     }},
    {StatusReason::kNoSensorShares,
     [](const Reason&) -> std::string {
       return "Some groups of landmarks share no observation by any sensor.";
     }},
    {StatusReason::kNoSensorObserved,
     [](const Reason& of) -> std::string {
       return fmt::format("{} not observed by any of the sensors.", plural(of(0), "landmark"));
     }},
    {StatusReason::kNotObservedSoFar,
     [](const Reason& of) -> std::string {
       return fmt::format("{} of {} landmarks were not observed so far.", of(0), of(1));
     }},
    {StatusReason::kFilterLost,
     [](const Reason& of) -> std::string {
       return fmt::format("The filter is lost: {} of {} ranges were gated out.", of(0), of(1));
     }},
    {StatusReason::kFewStepsWithMotion,
     [](const Reason& of) -> std::string {
       return fmt::format("{} and {} with motion; {} and {} are needed.", plural(of(0), "landmark"),
                          plural(of(1), "step"), of(2), of(3));
     }},
    {StatusReason::kFrameNotTied,
     [](const Reason& of) -> std::string {
       return fmt::format(
           "Known landmarks with ranges: {} of {}, and not two at different positions. They do not "
           "tie "
           "the frame, which is that of the first pose.",
           of(0), of(1));
     }},
    {StatusReason::kFlatInSpace,
     [](const Reason& of) -> std::string {
       return fmt::format(
           "Landmarks or path lie on one plane or sphere, as far as the ranges determine: {}.",
           condition_text(of(0)));
     }},
    {StatusReason::kFewCommonRanges,
     [](const Reason& of) -> std::string {
       return fmt::format("{} landmarks, ranged to together at {} times; {} at {} are needed.",
                          of(0), of(1), of(2), of(3));
     }},
    {StatusReason::kFewLandmarksAtSteps,
     [](const Reason& of) -> std::string {
       return fmt::format("{} at {}; {} at {} are needed.", plural(of(0), "landmark"),
                          plural(of(1), "step"), of(2), of(3));
     }},
    {StatusReason::kLandmarksNearlyOnALine,
     [](const Reason& of) -> std::string {
       return nearly_on_a_line("The landmarks lie", "the robot was", of(0));
     }},
    {StatusReason::kPathNearlyOnALine,
     [](const Reason& of) -> std::string {
       return nearly_on_a_line("The path lies", "a landmark stands", of(0));
     }},
    {StatusReason::kTooFewRanges,
     [](const Reason& of) -> std::string {
       return fmt::format("Too few ranges for a position of {}.",
                          listed(of.status.names, kMostLandmarksNamed));
     }},
    {StatusReason::kNoQuadric,
     [](const Reason& of) -> std::string {
       return fmt::format("No quadric of a path in {} fits the states: {}.", extent(of(0)),
                          condition_text(of(1)));
     }},
    {StatusReason::kOtherQuadric,
     [](const Reason& of) -> std::string {
       return fmt::format(
           "Another quadric fits the states nearly as well as the one taken: {:.3g} times its "
           "misfit, {}.",
           of(0), condition_text(of(1)));
     }},
    {StatusReason::kMappedOnALine,
     [](const Reason&) -> std::string {
       return "The landmarks came out on one line: no positions.";
     }},
    {StatusReason::kRankOfRanges,
     [](const Reason& of) -> std::string {
       return fmt::format(
           "Squared ranges have rank {} above the noise, {} is needed: {}. So "
           "it is where the robot or the landmarks keep to {}.",
           of(0), of(1), condition_text(of(2)),
           of(1) == 4.0 ? "a line or a circle" : "a plane or a sphere");
     }},
    {StatusReason::kNoCovariances,
     [](const Reason&) -> std::string {
       return "The ranges leave a landmark or the path free to move: there are no covariances.";
     }},
    {StatusReason::kCovariancesOfFirstPose,
     [](const Reason&) -> std::string {
       return "The covariances are relative to the first pose: it takes two landmarks in different "
              "positions to free them of the frame.";
     }},
    {StatusReason::kLeastSquaresNotConverged,
     [](const Reason& of) -> std::string {
       return fmt::format("The least squares had not converged after {} iterations.", of(0));
     }},
    {StatusReason::kNoDecreasingStep,
     [](const Reason&) -> std::string {
       return "No step decreased the cost: this is the initial guess, aligned to the odometry.";
     }},
    {StatusReason::kFewStates,
     [](const Reason& of) -> std::string {
       return fmt::format("{} states against {} on the other side; {} against {} are needed.",
                          of(0), of(1), of(2), of(3));
     }},
    {StatusReason::kStatesFlat,
     [](const Reason& of) -> std::string {
       return fmt::format("The states do not span {} dimensions: {}.",
                          of(0) == 4.0 ? "four" : "five", condition_text(of(1)));
     }},
    {StatusReason::kFewKnownLandmarks,
     [](const Reason& of) -> std::string {
       return fmt::format("{} landmarks are known, {} are needed.", of(0), of(1));
     }},
    {StatusReason::kKnownDegenerate,
     [](const Reason& of) -> std::string {
       return fmt::format("The known landmarks lie on one {}: {}.",
                          of(0) == 2.0 ? "line or circle" : "plane or sphere",
                          condition_text(of(1)));
     }},
    {StatusReason::kRankOfPath,
     [](const Reason& of) -> std::string {
       return fmt::format(
           "The ranges do not determine positions from the known landmarks: their rank is lower "
           "than "
           "that of a path in {}.",
           extent(of(0)));
     }},
    {StatusReason::kStepsFlat,
     [](const Reason& of) -> std::string {
       return fmt::format("The steps span {} dimensions; {} are needed.", of(0), of(1));
     }},
    {StatusReason::kMirrorImage,
     [](const Reason& of) -> std::string {
       return fmt::format(
           "Odometry does not distinguish the map from its reflection: the fits differ only by "
           "{:.2g} %.",
           of(0));
     }},
    {StatusReason::kFewPosesWithRanges,
     [](const Reason& of) -> std::string {
       return fmt::format(
           "All of {} landmarks are observed at {} of {} poses; {} at {} are needed. Landmark {} "
           "is "
           "observed at the fewest: {}.",
           of(0), of(1), of(2), of(3), of(4), of.status.names.at(0), of(5));
     }},
    {StatusReason::kPosesWithoutWindow,
     [](const Reason& of) -> std::string {
       return fmt::format(
           "{} of {} poses have no window with enough measurements of every landmark; the path "
           "leaves them out. Landmark {} is observed at the fewest: {}.",
           of(0), of(1), of.status.names.at(0), of(2));
     }},
    {StatusReason::kNoKnownLandmark,
     [](const Reason&) -> std::string { return "No landmark's position is known."; }},
    {StatusReason::kNoOdometry,
     [](const Reason&) -> std::string { return "The log has no odometry."; }},
    {StatusReason::kNoOdometryForHeadings,
     [](const Reason&) -> std::string { return "The log has no odometry, which headings need."; }},
    {StatusReason::kNoStart,
     [](const Reason&) -> std::string {
       return "The spectral method gave nothing to start from.";
     }},
    {StatusReason::kMethodLeftOut,
     [](const Reason& of) -> std::string {
       return fmt::format("The method gives no position to {}: {}.",
                          counted(std::ssize(of.status.names), "landmark"),
                          listed_names(of.status));
     }},
    {StatusReason::kMethodNotStarted,
     [](const Reason& of) -> std::string {
       return fmt::format("The method cannot be started: {}.", of.status.names.at(0));
     }},
    {StatusReason::kMethodTimeout,
     [](const Reason& of) -> std::string {
       return fmt::format("The method gave no answer within {:g} s and was ended.", of(0));
     }},
    {StatusReason::kMethodEnded,
     [](const Reason& of) -> std::string {
       return fmt::format("The method ended without an answer: {}.", of.status.names.at(0));
     }},
    {StatusReason::kMethodReply,
     [](const Reason& of) -> std::string {
       return fmt::format("The method gave no valid answer: {}.", of.status.names.at(0));
     }},
    {StatusReason::kMethodNumbers,
     [](const Reason& of) -> std::string {
       return fmt::format("The method gave coordinates that are no map: {}.",
                          of.status.names.at(0));
     }},
    {StatusReason::kMethodRefused,
     [](const Reason& of) -> std::string {
       return fmt::format("The method reports that it has no map: {}.", of.status.names.at(0));
     }},
    {StatusReason::kMessage, [](const Reason& of) -> std::string { return of.status.names.at(0); }},
};

std::string reason_words(const Status& status) {
  const auto sentence = kSentences.find(status.reason);
  return sentence == kSentences.end() ? std::string(name(status.reason))
                                      : sentence->second({status});
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
