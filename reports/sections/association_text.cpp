#include "reports/sections/association_text.hpp"

#include <fmt/format.h>

#include "core/base/errors.hpp"
#include "core/base/text/number_text.hpp"
#include "core/base/text/words.hpp"

namespace mapproof {
namespace {

std::string shown_name(const DetectionLog& log, int landmark) {
  return printable(log.names[static_cast<std::size_t>(landmark)]);
}

/// The name of a scan, by its step or time in the file: "step 1200", "12.5 s".
std::string scan_words(const DetectionLog& log, int step) {
  const auto scan = static_cast<std::size_t>(step);
  if (scan < log.times_s.size()) return fmt::format("{:.1f} s", log.times_s[scan]);
  if (scan < log.scans.size()) return fmt::format("step {:.15g}", log.scans[scan].key);
  return fmt::format("step {}", step + 1);
}

/// Whose scan it was, " of robot 3"; empty for the log of one robot.
std::string robot_words(const DetectionLog& log, int step) {
  const auto scan = static_cast<std::size_t>(step);
  if (log.robots.size() < 2 || scan >= log.scans.size()) return "";
  return " of robot " + printable(log.robots[static_cast<std::size_t>(log.scans[scan].robot)]);
}

/// "from step 12 to step 90 of robot 3", "throughout", "in all scans of robot 3".
std::string when_words(const AssociationFinding& finding, const DetectionLog& log) {
  if (finding.to_the_end && finding.from_the_start) return "throughout";
  // The times of all robots' scans come from one clock: the robot adds nothing.
  const auto robot = [&](int step) { return finding.by_time ? "" : robot_words(log, step); };
  const std::string of_first = robot(finding.first_step);
  const std::string of_last = robot(finding.last_step);
  if (finding.all_of_robot && !of_first.empty()) return "in all scans" + of_first;
  const std::string first = scan_words(log, finding.first_step);
  const std::string last = scan_words(log, finding.last_step);
  if (finding.to_the_end) return "from " + first + of_first + " on";
  if (finding.from_the_start) return "up to " + last + of_last;
  return of_first == of_last ? "from " + first + " to " + last + of_last
                             : "from " + first + of_first + " to " + last + of_last;
}

}  // namespace

std::string described(const AssociationFinding& finding, const DetectionLog& log) {
  const std::string what =
      finding.fault == AssociationFault::kSwapped
          ? fmt::format("IDs of {} and {} swapped{}", shown_name(log, finding.first),
                        shown_name(log, finding.second),
                        finding.scattered || finding.in_part ? " in single scans" : "")
      : finding.fault == AssociationFault::kWrong
          ? fmt::format("{} has the ID of {}{}", shown_name(log, finding.first),
                        shown_name(log, finding.second), finding.in_part ? " in single scans" : "")
          : fmt::format("some of {} have the ID of {}", shown_name(log, finding.first),
                        shown_name(log, finding.second));
  return fmt::format("{} {} ({}): loss {:.3f} -> {:.3f} m", what, when_words(finding, log),
                     counted(finding.detections, "detection"), finding.loss_before_m,
                     finding.loss_after_m);
}

std::string described(const MovedLandmark& moved, const DetectionLog& log) {
  const std::string earliest = scan_words(log, moved.earliest_step);
  const std::string latest = scan_words(log, moved.latest_step);
  return fmt::format("{} moved by {:.2f} m {} (p = {:.3g}): loss {:.3f} -> {:.3f} m",
                     shown_name(log, moved.landmark), moved.distance_m,
                     earliest == latest ? "at " + latest : "between " + earliest + " and " + latest,
                     moved.p, moved.loss_before_m, moved.loss_after_m);
}

std::string described(const AnchorExchange& exchange, const DetectionLog& log) {
  return fmt::format(
      "IDs of {} and {} swapped in all detections: known positions missed by {:.3f} m, then by "
      "{:.3f} m",
      shown_name(log, exchange.first), shown_name(log, exchange.second), exchange.misfit_before_m,
      exchange.misfit_after_m);
}

std::string described(const SharedId& shared, const std::string& first, const std::string& second) {
  return fmt::format(
      "{} stands at two positions {:.2f} m apart ({} and {} detections): another landmark has "
      "its "
      "landmark ID{}: loss {:.3f} -> {:.3f} m",
      printable(first), shared.apart_m, count_text(shared.first_detections),
      count_text(shared.second_detections),
      second.empty() ? "" : ", likely " + printable(second) + ", which has no detection",
      shared.loss_before_m, shared.loss_after_m);
}

std::string undetermined_text(const AssociationFinding& finding, const DetectionLog& log,
                              bool repair) {
  return fmt::format(
      "{} and {}: {} with no other landmark in the scan cannot be assigned and {}stay as they "
      "are; "
      "{} fit neither landmark and {} left out.",
      shown_name(log, finding.first), shown_name(log, finding.second),
      counted(finding.undetermined, "detection"), repair ? "" : "would ", finding.left_out,
      repair ? "are" : "would be");
}

std::string undetermined_text(const SharedId& shared, const std::string& first, bool repair) {
  return fmt::format("{}: {} cannot be assigned and {} left out.", printable(first),
                     counted(shared.undetermined, "detection"), repair ? "are" : "would be");
}

std::string doubts_text(const AssociationCheck& check, const DetectionLog& log) {
  const AssociationDoubts& doubts = check.doubts;
  return fmt::format(
      "The scans do not fit one map{}: residual {:.3f} m, but a spread of {:.3f} m of repeated "
      "measurements{}.",
      check.findings.empty() ? "" : ", even with the findings corrected", doubts.residual_m,
      doubts.spread_m,
      doubts.landmarks.empty()
          ? ""
          : "; most with landmarks " + listed(shown_names(doubts.landmarks, log), 4));
}

std::string repair_kept_text(const HeldOutFit& held_out) {
  return fmt::format(
      "The corrected landmark IDs make a map that predicts held-out scans as well or better: mean "
      "log-likelihood {:.3f} instead of {:.3f} over {}.",
      held_out.repaired, held_out.given, counted(held_out.pairs, "pair"));
}

std::string repair_dropped_text(const HeldOutFit& held_out) {
  return fmt::format(
      "The corrections of landmark IDs are not made: their map predicts held-out scans worse, "
      "with a mean log-likelihood of {:.3f} instead of {:.3f} over {}. The landmark IDs are wrong "
      "in a way that cannot be repaired.",
      held_out.repaired, held_out.given, counted(held_out.pairs, "pair"));
}

std::string check_failed_text(const std::string& what, const std::string& problem) {
  return fmt::format("The check of {} failed, and the map is of the data as they are: {}.", what,
                     problem);
}

std::string nothing_found_text(const AssociationCheck& check) {
  return fmt::format(
      "No ID swap and no wrong data association, over a stretch or in single scans, explains the "
      "scans clearly better: loss {:.3f} m.",
      check.loss_before_m);
}

std::string too_few_known_text() {
  return fmt::format(
      "An ID swap in all detections would not show: that needs the positions of {} landmarks or "
      "more.",
      kFewestKnownPositions);
}

std::string no_exchange_text(const AnchorCheck& check) {
  return fmt::format(
      "No ID swap would fit the {} known positions clearly better: missed by {:.3f} m.",
      check.positions, check.misfit_before_m);
}

std::string known_missed_text(const AnchorCheck& check, double loss_m,
                              const std::vector<std::string>& doubtful) {
  return fmt::format(
      "Known positions are missed by {:.3f} m, far more than the loss of {:.3f} m explains: data "
      "association may be wrong in a way that was not found{}.",
      check.misfit_after_m, loss_m,
      doubtful.empty() ? "" : "; most doubtful: " + listed(doubtful, 4));
}

std::vector<std::string> shown_names(const std::vector<int>& landmarks, const DetectionLog& log) {
  std::vector<std::string> names;
  for (const int k : landmarks) names.push_back(shown_name(log, k));
  return names;
}

}  // namespace mapproof
