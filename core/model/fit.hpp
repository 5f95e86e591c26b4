#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace mapproof {

/// Whether the data fit a map, from the data alone. In the order of fit_rank().
enum class FitVerdict {
  kFits,          ///< Residuals are as large as the noise; no test exceeds its bound.
  kDoubtful,      ///< A test exceeds its bound, by an effect that hardly moves the map.
  kUndetermined,  ///< Several maps fit equally: `Fit::parts` names what is open.
  kDoesNotFit,    ///< A test exceeds its bound.
  kNotTestable,   ///< `Fit::why` says what is missing.
};

/// "fits", "doubtful", "undetermined", "does_not_fit", "not_testable".
std::string_view name(FitVerdict verdict);

/// What is tested, and what a cause is.
enum class FitCode {
  // Of any map.
  kResiduals,          ///< Chi-squared of all residuals beside that of the noise.
  kLandmarkResiduals,  ///< The same of one landmark.
  kOutliers,           ///< A share of the measurements is far off.
  // Of range-only maps.
  kCommonOffset,             ///< One constant in all ranges.
  kLandmarkOffset,           ///< A constant in the ranges of one landmark.
  kTimeOffset,               ///< Ranges are stamped late or early.
  kClockJump,                ///< From some time on.
  kLandmarkMoved,            ///< A landmark changed its position at some time.
  kIdsExchanged,             ///< Two landmarks carry each other's ID for some time.
  kOdometryGap,              ///< Odometry is missing for some time, by its stamps.
  kOdometryFrozen,           ///< Odometry reports a standstill that the ranges deny.
  kKnownLandmarkOff,         ///< A given position is at odds with the others.
  kKnownLandmarksExchanged,  ///< Two given positions belong to each other's landmark.
  kKnownLandmarksAtOdds,     ///< Given positions are at odds; which one, is open.
  kResidualsOverTime,        ///< Residuals of some time differ from those of the others.
  kResidualsOverRange,       ///< Residuals depend on the range.
  kOdometryResiduals,        ///< The robot moved otherwise than the odometry reports.
  // Of maps of observations.
  kStress,         ///< Distances in the map beside the measured ones.
  kAnchorMissed,   ///< An anchor is missed by more than noise allows.
  kWeakBridge,     ///< Groups of landmarks hang together by few pairs.
  kMirror,         ///< A group of landmarks fits as well when it is reflected.
  kFold,           ///< A group of landmarks fits as well when it is folded onto others.
  kWrongIds,       ///< Data association that residuals deny.
  kScatter,        ///< Repeated measurements of a distance differ by far.
  kRobotRanges,    ///< One robot's ranges are longer or shorter than the others'.
  kRobotBearings,  ///< One robot sees landmarks in the opposite orientation.
  kKnownMirrored,  ///< Given positions fit the reflected map.
  kKnownScale,     ///< Given positions fit the map in another scale.
  kDisconnected,   ///< Groups of landmarks that no measurement connects.
};

/// In files: "common_offset".
std::string_view name(FitCode code);

/// What is missing for a test.
enum class FitMissing {
  kMap,         ///< No map came out.
  kRedundancy,  ///< Not enough more measurements than unknowns.
  kNoiseModel,  ///< Nothing says how large errors are.
  kOdometry,    ///< Ranges alone.
  kMetric,      ///< The measurements have no unit in which the map could be compared with them.
  kSize,        ///< There are too many landmarks or measurements for the tests' arrays.
};

/// In files: "map", "redundancy", "noise_model", "odometry", "metric", "size".
std::string_view name(FitMissing missing);

/// A number of a cause. The ids in use: offset_m, offset_s, distance_m, sigmas, from_s, to_s, at_s,
/// share_percent, ratio, count, pairs, angle_rad, robot (its number in the data, from 1).
struct FitValue {
  std::string id;  ///< With its unit: "offset_m", "from_s", "share_percent".
  double value = 0.0;
  std::optional<double> sigma = {};  ///< Its standard deviation.

  bool operator==(const FitValue&) const = default;
};

/// A test that was made. Its statistic is compared with its bound; both are without a unit.
struct FitTest {
  FitCode code = FitCode::kResiduals;
  std::vector<std::string> landmarks = {};  ///< That it is about; empty: all.
  double statistic = 0.0;
  double bound = 0.0;  ///< > 0. At or below: no alarm.
  /// The least effect that would have been seen in these data, in the unit that its id has.
  std::optional<FitValue> limit = {};

  bool exceeds() const { return statistic > bound; }
  bool operator==(const FitTest&) const = default;
};

/// Why the data do not fit, or might not.
struct FitCause {
  FitCode code = FitCode::kResiduals;
  std::vector<std::string> landmarks = {};
  std::vector<FitValue> values = {};
  double statistic = 0.0;
  double bound = 0.0;
  bool is_small = false;    ///< Significant, but the map hardly depends on it: doubtful alone.
  std::string figure = {};  ///< Id of the figure that shows why; empty: none.

  bool operator==(const FitCause&) const = default;
};

/// A number of the fit, by its quantity in the dictionary: "fit_chi2_ratio".
struct FitNumber {
  std::string quantity;
  double value = 0.0;
  std::optional<double> bound = {};  ///< Above which it is an alarm.

  bool operator==(const FitNumber&) const = default;
};

/// What is left of one range in a fit.
struct FittedRange {
  double time_s = 0.0;
  std::ptrdiff_t landmark = 0;  ///< Row.
  double range_m = 0.0;
  double normalised = 0.0;  ///< Prediction less range, in standard deviations.
  double inlier = 1.0;      ///< Probability that it is not an outlier.
};

/// Whether the data fit a map, and why not.
struct Fit {
  FitVerdict verdict = FitVerdict::kNotTestable;
  std::vector<FitCause> causes = {};  ///< The most significant first.
  /// Groups of landmarks whose position relative to each other is open.
  std::vector<std::vector<std::string>> parts = {};
  std::vector<FitMissing> why = {};  ///< Only if the verdict is kNotTestable.
  std::vector<FitNumber> numbers = {};
  std::vector<FitTest> tests = {};  ///< All that were made, in the order of their codes.

  const FitNumber* number(std::string_view quantity) const;
  bool operator==(const Fit&) const = default;
};

/// 1 for kFits to 4 for kDoesNotFit, as quantity "fit_verdict"; none for kNotTestable.
std::optional<double> fit_rank(FitVerdict verdict);

/// The quantities of a fit: "fit_verdict" and its numbers.
std::vector<FitNumber> fit_numbers(const Fit& fit);

}  // namespace mapproof
