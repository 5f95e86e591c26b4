#pragma once

#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include "core/model/detection_log.hpp"
#include "core/records/detections/scan_rows.hpp"
#include "core/records/observations/name_list.hpp"
#include "core/records/observations/sources.hpp"

namespace mapproof {

inline constexpr std::size_t kMostDetections = 200'000'000;  ///< More are taken for a mistake.

/// Understands the rows of a long table of detections one by one, see read_detections().
class DetectionRows {
 public:
  /// @param source  What to call the table in errors; must outlive the object.
  DetectionRows(const std::string& source, const TableFormat& format)
      : source_(source), scans_(source, format), format_(format), names_(source) {}

  /// Learns the columns from the first row.
  /// @return Whether it is a header, and no detection. @throws IoError as detection_columns().
  bool begin(const TableRow& first);

  /// @throws IoError with the line for a row that is none of the table's.
  ScanKey scan_of(const TableRow& row) { return scans_.scan_of(row); }

  /// What the row holds, after scan_of(); its step is 0. @throws IoError with the line.
  Detection detection_of(const TableRow& row);

  const ScanRows& scans() const { return scans_; }
  const NameList& names() const { return names_; }
  /// The names, without a copy of them.
  std::vector<std::string> take_names() && { return std::move(names_).take(); }

 private:
  void take_position(const TableRow& row, Detection& seen) const;
  void take_value(const TableRow& row, Detection& seen) const;

  const std::string& source_;
  ScanRows scans_;
  TableFormat format_;
  NameList names_;
};

}  // namespace mapproof
