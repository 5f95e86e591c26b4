#include "app/map/data_association_words.hpp"

#include <fmt/format.h>

#include "core/base/errors.hpp"
#include "core/base/words.hpp"

namespace mapproof {
namespace {

/// How a scan is called, by its file's own step or time: "step 1200", "12.5 s".
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
std::string when_words(const LabelFinding& finding, const DetectionLog& log) {
  if (finding.to_the_end && finding.from_the_start) return "throughout";
  // Times of all robots' scans are of one clock: whose scan it was says nothing.
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

std::string described(const LabelFinding& finding, const DetectionLog& log) {
  const auto label = [&](int k) { return printable(log.names[static_cast<std::size_t>(k)]); };
  const std::string what =
      finding.fault == LabelFault::kSwapped
          ? fmt::format("{} and {} look swapped{}", label(finding.first), label(finding.second),
                        finding.scattered || finding.in_part ? " in single scans" : "")
      : finding.fault == LabelFault::kWrong
          ? fmt::format("{} looks like {}{}", label(finding.first), label(finding.second),
                        finding.in_part ? " in single scans" : "")
          : fmt::format("some of {} look like {}", label(finding.first), label(finding.second));
  return fmt::format("{} {} ({}): loss {:.3f} -> {:.3f} m", what, when_words(finding, log),
                     counted(finding.detections, "detection"), finding.loss_before_m,
                     finding.loss_after_m);
}

std::string described(const MovedLandmark& moved, const DetectionLog& log) {
  const std::string earliest = scan_words(log, moved.earliest_step);
  const std::string latest = scan_words(log, moved.latest_step);
  return fmt::format("{} moved by {:.2f} m {} (p = {:.3g}): loss {:.3f} -> {:.3f} m",
                     printable(log.names[static_cast<std::size_t>(moved.landmark)]),
                     moved.distance_m,
                     earliest == latest ? "at " + latest : "between " + earliest + " and " + latest,
                     moved.p, moved.loss_before_m, moved.loss_after_m);
}

std::string described(const AnchorExchange& exchange, const DetectionLog& log) {
  const auto label = [&](int k) { return printable(log.names[static_cast<std::size_t>(k)]); };
  return fmt::format(
      "{} and {} look exchanged in all detections: known places missed by {:.3f} m, then by {:.3f} "
      "m",
      label(exchange.first), label(exchange.second), exchange.misfit_before_m,
      exchange.misfit_after_m);
}

}  // namespace mapproof
