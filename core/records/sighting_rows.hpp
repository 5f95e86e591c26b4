#pragma once

#include <cstddef>
#include <string>

#include "core/model/sighting_log.hpp"
#include "core/records/look_rows.hpp"
#include "core/records/name_list.hpp"
#include "core/records/sightings.hpp"

namespace mapproof {

inline constexpr std::size_t kMostSightings = 50'000'000;  ///< More are taken for a mistake.

/// Understands the rows of a long table of sightings one by one, see read_sightings().
class SightingRows {
 public:
  /// @param source  What to call the table in errors; must outlive the object.
  SightingRows(const std::string& source, const SightingFormat& format)
      : source_(source), looks_(source), format_(format), names_(source) {}

  /// Learns the columns from the first row.
  /// @return Whether it is a header, and no sighting. @throws IoError as sighting_columns().
  bool begin(const TableRow& first);

  /// @throws IoError with the line for a row that is none of the table's.
  LookKey look_of(const TableRow& row) { return looks_.look_of(row); }

  /// What the row holds, after look_of(); its step is 0. @throws IoError with the line.
  Sighting sighting_of(const TableRow& row);

  const LookRows& looks() const { return looks_; }
  const NameList& names() const { return names_; }

 private:
  double value(const TableRow& row, SightingColumn column, Sensor sensor) const;
  void take_value(const TableRow& row, Sighting& seen) const;

  const std::string& source_;
  LookRows looks_;
  SightingFormat format_;
  NameList names_;
};

}  // namespace mapproof
