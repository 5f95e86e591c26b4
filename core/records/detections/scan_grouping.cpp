#include "core/records/detections/scan_grouping.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <string_view>
#include <utility>

#include <fmt/format.h>

#include "core/base/errors.hpp"
#include "core/base/text/words.hpp"
#include "core/json/text_input.hpp"

namespace mapproof {
namespace {

constexpr double kLeastRatio = 3.0;       ///< Between gaps of scans and gaps within scans.
constexpr double kFewestShare = 0.02;     ///< Of the gaps, on each side of the window,
constexpr std::size_t kFewestOnSide = 3;  ///< and how many at least.
constexpr double kMostRepeats = 0.01;     ///< Of joined stamps: a landmark of the scan again.
constexpr std::size_t kMostTried = 8;     ///< Intervals, the widest first.
constexpr double kMostWindow_s = 3600.0;

/// An interval without gaps, and the window inside it.
struct Interval {
  double ratio;
  double window;
};

/// The rows of each stamp follow one another in `seen`.
std::span<const Detection> take_rows(std::span<const Detection>& seen, std::size_t stamp) {
  std::size_t rows = 0;
  while (rows < seen.size() && static_cast<std::size_t>(seen[rows].step) == stamp) ++rows;
  const std::span<const Detection> taken = seen.first(rows);
  seen = seen.subspan(rows);
  return taken;
}

int most_landmark(std::span<const Detection> seen) {
  int most = -1;
  for (const Detection& one : seen) most = std::max(most, one.landmark);
  return most;
}

ScanGrouping grouped(std::span<const ScanKey> stamps, std::span<const Detection> seen,
                     double window) {
  ScanGrouping result{.window = {.seconds = window}, .scan_of = {}, .scans = {}};
  result.scan_of.reserve(stamps.size());
  std::vector<int> last(static_cast<std::size_t>(most_landmark(seen) + 1), -1);  // Scan of each.
  for (std::size_t k = 0; k < stamps.size(); ++k) {
    const std::span<const Detection> rows = take_rows(seen, k);
    auto scan = static_cast<int>(result.scans.size()) - 1;
    const bool is_near = k > 0 && stamps[k].robot == stamps[k - 1].robot &&
                         stamps[k].key - stamps[k - 1].key <= window;
    const bool repeats =
        is_near && std::ranges::any_of(rows, [&](const Detection& one) {
          return one.landmark >= 0 && last[static_cast<std::size_t>(one.landmark)] == scan;
        });
    if (!is_near || repeats) {
      result.cut += repeats ? 1 : 0;
      result.scans.push_back(stamps[k]);
      ++scan;
    }
    for (const Detection& one : rows)
      if (one.landmark >= 0) last[static_cast<std::size_t>(one.landmark)] = scan;
    result.scan_of.push_back(scan);
  }
  return result;
}

/// The intervals between neighbouring gaps that are wide enough, the widest first.
std::vector<Interval> intervals(std::vector<double> gaps) {
  std::ranges::sort(gaps);
  const auto share = static_cast<std::size_t>(kFewestShare * static_cast<double>(gaps.size()));
  const std::size_t fewest = std::max(kFewestOnSide, share);
  std::vector<Interval> found;
  for (std::size_t k = fewest; k + fewest <= gaps.size(); ++k)
    if (gaps[k] >= kLeastRatio * gaps[k - 1])
      found.push_back({gaps[k] / gaps[k - 1], std::sqrt(gaps[k] * gaps[k - 1])});
  std::ranges::stable_sort(found, std::greater(), &Interval::ratio);
  if (found.size() > kMostTried) found.resize(kMostTried);
  return found;
}

}  // namespace

double scan_window_of(const std::string& text) {
  constexpr std::array<std::pair<std::string_view, double>, 4> kUnits = {
      {{"ms", 1e-3}, {"us", 1e-6}, {"s", 1.0}, {"", 1.0}}};
  std::string_view number = text;
  double unit = 1.0;
  for (const auto& [word, seconds] : kUnits)
    if (number.ends_with(word)) {
      number.remove_suffix(word.size());
      unit = seconds;
      break;
    }
  const std::optional<double> value = number_in(number);
  if (!value || !(*value >= 0.0 && *value * unit <= kMostWindow_s))
    throw InvalidInput("--scan-window: expected seconds, or a unit as 50ms, got " +
                       in_quotes(text));
  return *value * unit;
}

double found_window(std::span<const ScanKey> stamps, std::span<const Detection> seen) {
  std::vector<double> gaps;
  for (std::size_t k = 1; k < stamps.size(); ++k)
    if (stamps[k].robot == stamps[k - 1].robot) gaps.push_back(stamps[k].key - stamps[k - 1].key);
  if (gaps.size() < kFewestGaps) return 0.0;
  for (const Interval& one : intervals(std::move(gaps))) {
    const ScanGrouping tried = grouped(stamps, seen, one.window);
    const std::size_t joined = stamps.size() - tried.scans.size();
    // Where more rows have equal stamps, equal stamps are what marks a scan.
    if (joined < seen.size() - stamps.size()) continue;
    if (static_cast<double>(tried.cut) <= kMostRepeats * static_cast<double>(joined + tried.cut))
      return one.window;
  }
  return 0.0;
}

ScanGrouping group_stamps(std::span<const ScanKey> stamps, std::span<const Detection> seen,
                          std::optional<double> seconds) {
  ScanGrouping result = grouped(stamps, seen, seconds ? *seconds : found_window(stamps, seen));
  result.window.is_found = !seconds;
  return result;
}

double FirstRows::window_s() const {
  std::vector<Row> rows = rows_;
  std::ranges::sort(rows);
  std::vector<ScanKey> stamps;
  std::vector<Detection> seen;
  for (const Row& row : rows) {
    if (stamps.empty() || stamps.back() != row.stamp) stamps.push_back(row.stamp);
    seen.push_back({.step = static_cast<int>(stamps.size()) - 1, .landmark = row.landmark});
  }
  return found_window(stamps, seen);
}

std::string first_rows_remark(double window_s, std::size_t rows) {
  if (window_s == 0.0) return "";
  return fmt::format(
      "Rows of a robot that follow one another within {:.3g} s are one scan (found from the gaps "
      "between the time stamps of the first {}; --scan-window sets it).",
      window_s, counted(static_cast<long>(rows), "row"));
}

void require_stamps(const ScanRows& rows, std::optional<double> window_s) {
  if (window_s && !rows.is_timed()) refuse_window(rows.source());
}

void refuse_window(const std::string& source) {
  throw IoError(source, "--scan-window groups time stamps; the scans of this file are numbered");
}

std::string grouping_remark(const ScanGrouping& grouping, std::size_t stamps) {
  const ScanWindow& window = grouping.window;
  if (grouping.scans.size() == stamps) return "";
  std::string remark = fmt::format(
      "Rows of a robot that follow one another within {:.3g} s are one scan ({}): {} of {}.",
      window.seconds,
      window.is_found ? "found from the gaps between the time stamps; --scan-window sets it"
                      : "--scan-window",
      counted(std::ssize(grouping.scans), "scan"),
      counted(static_cast<long>(stamps), "time stamp"));
  if (grouping.cut > 0)
    remark += fmt::format(" {} ended earlier, because a landmark came a second time.",
                          counted(static_cast<long>(grouping.cut), "scan"));
  return remark;
}

}  // namespace mapproof
