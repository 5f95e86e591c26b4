#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/model/detection_log.hpp"
#include "core/records/detections/detection_rows.hpp"
#include "core/records/tables/streamed_table.hpp"

namespace mapproof {

/// All that one scan of a file that grows showed.
struct StreamedScan {
  ScanKey scan;
  std::vector<Detection> detections;  ///< Ascending by landmark; their step is 0.
};

/// Gathers the rows of a long table of detections (see read_detections) into scans as they come. A
/// scan is complete once a later row of the same robot is there that is not of it. A robot's scans
/// come in ascending order. Time stamps are grouped as by group_stamps(); the first rows wait until
/// they determine the window (see FirstRows).
class ScanGatherer {
 public:
  /// @param source  What to call the table in errors; must outlive the object.
  ScanGatherer(const std::string& source, const TableFormat& format)
      : source_(source), rows_(source, format), window_s_(format.scan_window_s) {}

  /// @param row  The first one may be a header. @throws IoError with the line, as read_detections;
  ///             or for a scan that is not ascending.
  void take(const TableRow& row);

  /// There will be no more: the last scans are complete.
  /// @throws IoError as take().
  void end();

  /// The scans that became complete since the last call, in order of each robot.
  std::vector<StreamedScan> scans() { return std::exchange(complete_, {}); }

  const DetectionRows& rows() const { return rows_; }
  /// Remarks on the columns and the window, a sentence each.
  std::vector<std::string> remarks() const;

 private:
  /// A row that was read.
  struct Row {
    ScanKey stamp;
    Detection seen;
    std::size_t line;
  };

  /// The last scan of a robot.
  struct OpenScan {
    StreamedScan scan;
    double last_stamp = 0.0;
  };

  bool begins_scan(const OpenScan& open, const Row& row) const;
  void find_window();
  void add(const Row& row);
  void open(OpenScan& last, const Row& row);
  void close(StreamedScan& scan);

  const std::string& source_;
  DetectionRows rows_;
  bool begun_ = false;              ///< The first row was read.
  std::optional<double> window_s_;  ///< Empty: not found yet.
  std::vector<Row> waiting_;        ///< Until it is.
  std::string grouping_;            ///< A remark.
  std::vector<OpenScan> open_;      ///< Of each robot.
  std::vector<StreamedScan> complete_;
  std::size_t scans_ = 0;
  std::size_t detections_ = 0;
};

/// Reads a long table of detections as it grows: see StreamedTable and ScanGatherer.
class DetectionStream {
 public:
  /// @param source  What to call the file in errors.
  DetectionStream(std::string source, const TableFormat& format)
      : table_(std::move(source)), gatherer_(table_.source(), format) {}
  DetectionStream(const DetectionStream&) = delete;
  DetectionStream& operator=(const DetectionStream&) = delete;

  /// @throws IoError with the line.
  void take(std::string_view bytes) {
    table_.take(bytes, [this](const TableRow& row) { gatherer_.take(row); });
  }

  /// Forgets a line whose end has not come, as of a file that is still being written.
  void drop_half_line() { table_.drop_half_line(); }

  /// There will be no more: the last line needs no end. @throws IoError as take().
  void end() {
    table_.end([this](const TableRow& row) { gatherer_.take(row); });
    gatherer_.end();
  }

  std::vector<StreamedScan> scans() { return gatherer_.scans(); }

  /// Remarks after end(), a sentence each.
  std::vector<std::string> remarks() const;

  bool is_timed() const { return gatherer_.rows().scans().is_timed(); }
  /// Of all landmarks so far, in the order in which they came.
  const std::vector<std::string>& names() const { return gatherer_.rows().names().names(); }

 private:
  StreamedTable table_;
  ScanGatherer gatherer_;
};

}  // namespace mapproof
