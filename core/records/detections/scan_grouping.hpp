#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/model/detection_log.hpp"
#include "core/records/detections/scan_rows.hpp"

namespace mapproof {

/// Which time stamps are one scan. Rows with equal stamps of one robot always are. Rows with stamps
/// of their own, some milliseconds apart, are one scan if no gap between neighbouring stamps of the
/// robot exceeds the window.
struct ScanWindow {
  double seconds = 0.0;   ///< >= 0; 0: only equal stamps are one scan.
  bool is_found = false;  ///< Found from the gaps, and not given.
};

/// A window of seconds, or of milliseconds or microseconds: "0.05", "50ms", "2s", "300us".
/// @throws InvalidInput, naming the option, for anything else, and unless 0 <= window <= 3600 s.
double scan_window_of(const std::string& text);

inline constexpr std::size_t kFewestGaps = 20;  ///< Of which a window is found.

/// The window that the gaps between stamps suggest: the middle, in ratio, of the widest interval
/// without gaps that divides gaps within scans from gaps between scans. The interval has to span a
/// factor of 3, with 2 % of the gaps, and 3, or more on each side. It has to join at least as many
/// stamps as there are rows with the stamp of another row, and hardly a stamp may bring a landmark
/// that the scan has already. 0 if no interval does, and for fewer than kFewestGaps gaps.
/// @param stamps  Distinct, ascending.
/// @param seen  Ascending by step, which is the index of the stamp.
/// @note O(n log n) time for n stamps.
double found_window(std::span<const ScanKey> stamps, std::span<const Detection> seen);

/// Stamps grouped into scans.
struct ScanGrouping {
  ScanWindow window;
  std::vector<int> scan_of;    ///< Of each stamp, ascending.
  std::vector<ScanKey> scans;  ///< The first stamp of each.
  std::size_t cut = 0;         ///< Scans that a landmark ended, as it came a second time.
};

/// Groups stamps into scans: a stamp joins the scan of the stamp before if it is the same robot's,
/// the gap is at most the window, and the scan has none of its landmarks yet.
/// @param seconds  The window; empty: found_window().
/// @param seen  As found_window(). Landmarks < 0 have no ID, and end no scan.
ScanGrouping group_stamps(std::span<const ScanKey> stamps, std::span<const Detection> seen,
                          std::optional<double> seconds);

inline constexpr std::size_t kFirstRows = 100;  ///< Of a stream, which determine its window.

/// The first rows of a table that grows, in any order of robots.
class FirstRows {
 public:
  void add(const ScanKey& stamp, int landmark) { rows_.push_back({stamp, landmark}); }

  /// found_window() of them.
  double window_s() const;

 private:
  struct Row {
    ScanKey stamp;
    int landmark;

    auto operator<=>(const Row&) const = default;
  };

  std::vector<Row> rows_;
};

/// A remark on a window that the first rows of a stream determined; empty if there is none.
std::string first_rows_remark(double window_s, std::size_t rows);

/// @throws IoError for a window of a table whose scans are numbered: there is nothing to group.
void require_stamps(const ScanRows& rows, std::optional<double> window_s);

/// The same of a file that cannot hold time stamps. @throws IoError.
[[noreturn]] void refuse_window(const std::string& source);

/// A remark on the grouping: the window, and how many landmarks a scan holds; empty if every stamp
/// is a scan.
std::string grouping_remark(const ScanGrouping& grouping, std::size_t stamps);

}  // namespace mapproof
