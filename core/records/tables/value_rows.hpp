#pragma once

#include <cstddef>
#include <string>

#include <Eigen/Core>

#include "core/records/detections/scan_rows.hpp"

namespace mapproof {

/// Understands the rows of a long table of one sensor's values: step or time, landmark, value.
class ValueRows {
 public:
  /// The content of one row.
  struct Measured {
    Eigen::Index landmark;  ///< Row among the names; -1: without an ID, see kUnassociatedMark.
    ScanKey scan;
    double value;  ///< NaN: missing.
    std::size_t line;
  };

  /// @param source  What to call the table in errors; must outlive the object.
  ValueRows(const std::string& source, Sensor sensor, const TableFormat& format);

  /// Learns the columns from the first row; without a header they are step, landmark, value.
  /// @return Whether it is a header, and not a measurement. @throws IoError as detection_columns().
  bool begin(const TableRow& first);

  /// @throws IoError with the line for a row that is none of the table's.
  Measured measured(const TableRow& row);

  const ScanRows& scans() const { return scans_; }
  const NameList& names() const { return names_; }

 private:
  Sensor sensor_;
  ColumnNames columns_;
  ScanRows scans_;
  NameList names_;
};

}  // namespace mapproof
