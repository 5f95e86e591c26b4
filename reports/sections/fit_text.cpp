#include "reports/sections/fit_text.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include <fmt/format.h>

#include "core/base/errors.hpp"
#include "core/base/text/number_text.hpp"
#include "core/base/text/words.hpp"

namespace mapproof {
namespace {

constexpr std::size_t kMostNames = 4;

std::string names_of(const std::vector<std::string>& landmarks) {
  std::vector<std::string> shown;
  for (const std::string& landmark : landmarks) shown.push_back(printable(landmark, 40));
  return listed(shown, kMostNames);
}

/// The values of a cause as words.
class Values {
 public:
  explicit Values(const FitCause& cause) : cause_(cause) {}

  std::optional<double> find(std::string_view id) const {
    const auto found = std::ranges::find(cause_.values, id, &FitValue::id);
    if (found == cause_.values.end()) return std::nullopt;
    return found->value;
  }
  /// "3.02 m"; "an unknown amount" without the value.
  std::string amount(std::string_view id, std::string_view unit) const {
    const auto value = find(id);
    if (!value) return "an unknown amount";
    return fmt::format("{}\u00a0{}", significant(std::abs(*value)), unit);
  }
  /// " from 12 s on", " from 12 s to 30 s"; empty without a time.
  std::string when() const {
    if (const auto at = find("at_s")) return fmt::format(" at {}\u00a0s", significant(*at, 4));
    const auto from = find("from_s");
    if (!from) return "";
    const auto to = find("to_s");
    return to ? fmt::format(" from {}\u00a0s to {}\u00a0s", significant(*from, 4),
                            significant(*to, 4))
              : fmt::format(" from {}\u00a0s on", significant(*from, 4));
  }
  bool is_negative(std::string_view id) const { return find(id).value_or(0.0) < 0.0; }

 private:
  const FitCause& cause_;
};

std::string range_cause_words(const FitCause& cause) {
  const Values values(cause);
  const std::string names = names_of(cause.landmarks);
  const char* length = values.is_negative("offset_m") ? "short" : "long";
  switch (cause.code) {
    case FitCode::kCommonOffset:
      return fmt::format("all ranges are {} too {}", values.amount("offset_m", "m"), length);
    case FitCode::kLandmarkOffset:
      return fmt::format("the ranges of {} are {} too {}", names, values.amount("offset_m", "m"),
                         length);
    case FitCode::kTimeOffset:
      return fmt::format("ranges are stamped {} {}", values.amount("offset_s", "s"),
                         values.is_negative("offset_s") ? "early" : "late");
    case FitCode::kClockJump:
      return fmt::format("the clock of the ranges jumps {} by {}{}",
                         values.is_negative("offset_s") ? "back" : "forward",
                         values.amount("offset_s", "s"), values.when());
    case FitCode::kLandmarkMoved:
      return fmt::format("{} was moved by {}{}", names, values.amount("distance_m", "m"),
                         values.when());
    case FitCode::kIdsExchanged:
      return fmt::format("the IDs of {} are exchanged{}", names, values.when());
    case FitCode::kOdometryGap:
      return fmt::format("odometry is missing{}, so that the path there is not known",
                         values.when());
    case FitCode::kOdometryFrozen:
      return fmt::format("odometry reports a standstill{} that the ranges contradict",
                         values.when());
    case FitCode::kKnownLandmarkOff:
      return fmt::format("the given position of {} is {} off, by the others", names,
                         values.amount("distance_m", "m"));
    case FitCode::kKnownLandmarksExchanged:
      return fmt::format("the given positions of {} are exchanged", names);
    case FitCode::kKnownLandmarksAtOdds:
      return fmt::format(
          "the given positions{} contradict the measurements by up to {}; which of them is "
          "wrong cannot be determined",
          names.empty() ? "" : " of " + names, values.amount("distance_m", "m"));
    case FitCode::kResidualsOverTime:
      return fmt::format("residuals{} are larger than at other times", values.when());
    case FitCode::kResidualsOverRange:
      return "residuals depend on the range";
    case FitCode::kOdometryResiduals:
      return fmt::format(
          "the robot moved otherwise than the odometry reports, by {} of the way: noise of the "
          "odometry, or clocks that differ by seconds",
          values.amount("share_percent", "%"));
    default:
      return "";
  }
}

std::string missed_words(const Values& values, const std::string& names) {
  const std::string distance = values.amount("distance_m", "m");
  if (const auto ratio = values.find("ratio"))
    return fmt::format(
        "half of the landmarks lie {} or more from the mean of the anchors, {} times as far as any "
        "anchor",
        distance, significant(*ratio));
  if (names.empty()) return "the map misses the given positions by a mean of " + distance;
  return fmt::format("the map misses the given position of {} by {}", names, distance);
}

std::string scale_words(const Values& values) {
  if (const auto long_percent = values.find("share_percent"))
    return fmt::format("the given positions show that odometry is {} % too {}",
                       significant(std::abs(*long_percent)),
                       *long_percent > 0.0 ? "long" : "short");
  return fmt::format("the given positions are {} times as far apart as the landmarks in the map",
                     significant(values.find("ratio").value_or(1.0)));
}

std::string map_cause_words(const FitCause& cause) {
  const Values values(cause);
  const std::string names = names_of(cause.landmarks);
  switch (cause.code) {
    case FitCode::kResiduals:
      return "residuals are larger than the noise explains, and no single cause explains them";
    case FitCode::kLandmarkResiduals:
      return fmt::format("the residuals of {} are larger than the noise explains", names);
    case FitCode::kOutliers:
      return fmt::format("{} of the measurements are far off", values.amount("share_percent", "%"));
    case FitCode::kStress:
      return "the distances in the map differ from the measured ones by more than noise explains";
    case FitCode::kAnchorMissed:
      return missed_words(values, names);
    case FitCode::kWeakBridge:
      return fmt::format("{} hang together with the other landmarks by few measurements", names);
    case FitCode::kMirror:
      return fmt::format("{} fit as well when they are reflected", names);
    case FitCode::kFold:
      return fmt::format("{} fit as well when they are folded over", names);
    case FitCode::kWrongIds:
      return fmt::format("measurements of {} have a wrong landmark ID", names);
    case FitCode::kScatter:
      return fmt::format(
          "repeated measurements of a distance differ by {} of it, and not as normal errors do: "
          "the "
          "unit of the bearings, or most landmark IDs, may be wrong",
          values.amount("share_percent", "%"));
    case FitCode::kRobotRanges:
      return fmt::format("the ranges of robot {} are {} times those of the other robots",
                         significant(values.find("robot").value_or(0.0)),
                         significant(values.find("ratio").value_or(1.0)));
    case FitCode::kRobotBearings:
      return fmt::format(
          "robot {} sees landmarks in the opposite orientation: the sign of its "
          "bearings may be wrong",
          significant(values.find("robot").value_or(0.0)));
    case FitCode::kKnownMirrored:
      return "the given positions fit the reflected map: an axis of theirs, or the sign of the "
             "bearings, may be wrong";
    case FitCode::kKnownScale:
      return scale_words(values);
    case FitCode::kDisconnected:
      return fmt::format("no measurement connects {} with the other landmarks", names);
    default:
      return "";
  }
}

std::string cause_words(const FitCause& cause) {
  std::string words = range_cause_words(cause);
  return words.empty() ? map_cause_words(cause) : words;
}

/// A test that found nothing names no landmarks.
std::string of_landmarks(const char* what, const std::string& names) {
  return names.empty() ? what : what + (" of " + names);
}

std::string map_test_words(FitCode code, const std::string& names) {
  switch (code) {
    case FitCode::kStress:
      return "distances in the map";
    case FitCode::kAnchorMissed:
      return names.empty() ? "map beside the mean of the anchors" : "misfit of anchor " + names;
    case FitCode::kWeakBridge:
      return of_landmarks("connection", names);
    case FitCode::kMirror:
      return of_landmarks("reflection", names);
    case FitCode::kFold:
      return of_landmarks("fold", names);
    case FitCode::kWrongIds:
      return of_landmarks("data association", names);
    case FitCode::kScatter:
      return "scatter of repeated measurements";
    case FitCode::kRobotRanges:
      return "ranges of a robot";
    case FitCode::kRobotBearings:
      return "bearings of a robot";
    case FitCode::kKnownMirrored:
      return "reflection of the given positions";
    case FitCode::kKnownScale:
      return "scale of the given positions";
    case FitCode::kDisconnected:
      return "groups without a connection";
    default:
      return std::string(name(code));
  }
}

}  // namespace

std::string verdict_words(FitVerdict verdict) {
  switch (verdict) {
    case FitVerdict::kFits:
      return "fits";
    case FitVerdict::kDoubtful:
      return "doubtful";
    case FitVerdict::kUndetermined:
      return "undetermined";
    case FitVerdict::kDoesNotFit:
      return "does not fit";
    case FitVerdict::kNotTestable:
      return "not testable";
  }
  return "";
}

std::string verdict_text(const Fit& fit) {
  const std::string first = fit.causes.empty() ? "" : cause_words(fit.causes.front());
  switch (fit.verdict) {
    case FitVerdict::kFits:
      return "The data fit the map.";
    case FitVerdict::kDoubtful:
      return first.empty() ? "It is doubtful whether the data fit the map."
                           : fmt::format("It is doubtful whether the data fit the map: {}.", first);
    case FitVerdict::kUndetermined:
      return first.empty() || fit.causes.front().is_small
                 ? "Several maps fit the data equally well."
                 : fmt::format("Several maps fit the data equally well: {}.", first);
    case FitVerdict::kDoesNotFit:
      return first.empty() ? "The data do not fit the map."
                           : fmt::format("The data do not fit the map: {}.", first);
    case FitVerdict::kNotTestable:
      return fit.why.empty() ? "The fit cannot be tested."
                             : "The fit cannot be tested: " + why_text(fit.why.front());
  }
  return "";
}

std::string cause_text(const FitCause& cause) {
  return capitalised(fmt::format("{} (statistic {}, bound {}{}).", cause_words(cause),
                                 significant(cause.statistic), significant(cause.bound),
                                 cause.is_small ? "; the map hardly changes" : ""));
}

std::string limit_text(const FitTest& test) {
  if (!test.limit || !std::isfinite(test.limit->value)) return "";
  const std::string& id = test.limit->id;
  const std::string unit = id.ends_with("_m") ? "m" : id.ends_with("_s") ? "s" : "";
  const std::string amount =
      significant(test.limit->value, 2) + (unit.empty() ? "" : "\u00a0" + unit);
  const std::string names = names_of(test.landmarks);
  switch (test.code) {
    case FitCode::kCommonOffset:
      return fmt::format("An offset of all ranges below {} could not be seen in these data.",
                         amount);
    case FitCode::kLandmarkOffset:
      return fmt::format("An offset of the ranges of {} below {} could not be seen in these data.",
                         names, amount);
    case FitCode::kTimeOffset:
      return fmt::format("A time offset of the ranges below {} could not be seen in these data.",
                         amount);
    case FitCode::kClockJump:
      return fmt::format("A jump of the clock below {} could not be seen in these data.", amount);
    case FitCode::kLandmarkMoved:
      return fmt::format("A move of {} below {} could not be seen in these data.", names, amount);
    case FitCode::kKnownLandmarkOff:
      return fmt::format(
          "An error of the given position of {} below {} could not be seen in these "
          "data.",
          names, amount);
    default:
      return fmt::format("{}: less than {} could not be seen in these data.",
                         capitalised(test_label(test.code, test.landmarks)), amount);
  }
}

std::string why_text(FitMissing missing) {
  switch (missing) {
    case FitMissing::kMap:
      return "there is no map.";
    case FitMissing::kRedundancy:
      return "there are too few measurements for the number of unknowns.";
    case FitMissing::kNoiseModel:
      return "nothing determines how large the errors of the measurements are.";
    case FitMissing::kOdometry:
      return "there is no odometry that ranges could be compared with.";
    case FitMissing::kMetric:
      return "the observations have no unit in which they could be compared with the map.";
    case FitMissing::kSize:
      return "the tests take maps of at most 5000 landmarks and lists of at most 20 million "
             "entries.";
  }
  return "";
}

std::string parts_text(const Fit& fit) {
  if (fit.parts.empty()) return "";
  std::vector<std::string> groups;
  for (const std::vector<std::string>& part : fit.parts) groups.push_back(names_of(part));
  std::string text = "The position of these groups of landmarks relative to each other is open: ";
  for (std::size_t i = 0; i < groups.size(); ++i) text += (i > 0 ? "; " : "") + groups[i];
  return text + ".";
}

std::string test_label(FitCode code, const std::vector<std::string>& landmarks) {
  const std::string names = names_of(landmarks);
  switch (code) {
    case FitCode::kResiduals:
      return "all residuals";
    case FitCode::kLandmarkResiduals:
      return "residuals of " + names;
    case FitCode::kOutliers:
      return "outliers";
    case FitCode::kCommonOffset:
      return "offset of all ranges";
    case FitCode::kLandmarkOffset:
      return "offset of " + names;
    case FitCode::kTimeOffset:
      return "time offset of ranges";
    case FitCode::kClockJump:
      return "jump of the clock";
    case FitCode::kLandmarkMoved:
      return names.empty() ? "moved landmarks" : "move of " + names;
    case FitCode::kIdsExchanged:
      return names.empty() ? "exchanged IDs" : "IDs of " + names + " exchanged";
    case FitCode::kOdometryGap:
      return "gap in odometry";
    case FitCode::kOdometryFrozen:
      return "frozen odometry";
    case FitCode::kKnownLandmarkOff:
      return "given position of " + names;
    case FitCode::kKnownLandmarksExchanged:
      return "given positions of " + names + " exchanged";
    case FitCode::kKnownLandmarksAtOdds:
      return names.empty() ? "misfit to given positions" : "greatest misfit of an anchor";
    case FitCode::kResidualsOverTime:
      return "residuals over time";
    case FitCode::kResidualsOverRange:
      return "residuals over range";
    case FitCode::kOdometryResiduals:
      return "error of the odometry";
    default:
      return map_test_words(code, names);
  }
}

std::string test_meaning(const FitTest& test) {
  switch (test.code) {
    case FitCode::kKnownLandmarksAtOdds:
    case FitCode::kAnchorMissed:
      if (!test.landmarks.empty())
        return "Misfit of an anchor: the greatest distance of one from its given position.";
      if (test.code == FitCode::kKnownLandmarksAtOdds)
        return "Misfit to given positions: how far the map is from all of them, once fitted to "
               "them.";
      return "Mean of the anchors: whether a map with all landmarks there has as small an error, "
             "or "
             "half of the landmarks lie far beyond the anchors.";
    case FitCode::kWeakBridge:
      return "Connection: whether only few measurements connect some landmarks with the others.";
    default:
      return "";
  }
}

}  // namespace mapproof
