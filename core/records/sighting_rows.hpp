#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "core/model/sighting_log.hpp"
#include "core/records/name_list.hpp"
#include "core/records/sighting_columns.hpp"
#include "core/records/sightings.hpp"

namespace mapproof {

inline constexpr std::size_t kMostSightings = 50'000'000;  ///< More are taken for a mistake.

/// Which look a row is of: rows of one robot at one step or time are one look.
struct LookKey {
  int robot = 0;     ///< In the order in which they come; 0 where no column names robots.
  double key = 0.0;  ///< Step or time, finite.

  auto operator<=>(const LookKey&) const = default;
};

/// Understands the rows of a long table of sightings one by one, see read_sightings().
class SightingRows {
 public:
  /// @param source  What to call the table in errors; must outlive the object.
  SightingRows(const std::string& source, const SightingFormat& format)
      : source_(source), format_(format), names_(source), robots_(source) {}

  /// Learns the columns from the first row.
  /// @return Whether it is a header, and no sighting. @throws IoError as sighting_columns().
  bool begin(const TableRow& first);

  /// @throws IoError with the line for a row that is none of the table's.
  LookKey look_of(const TableRow& row);

  /// What the row holds, after look_of(); its step is 0. @throws IoError with the line.
  Sighting sighting_of(const TableRow& row);

  bool is_timed() const { return !columns_[SightingColumn::kStep]; }
  const SightingColumns& columns() const { return columns_; }
  const NameList& names() const { return names_; }

  /// What has to be said of the columns, a sentence each.
  std::vector<std::string> remarks() const;

 private:
  [[noreturn]] void fail(const TableRow& row, const std::string& what) const;
  double value(const TableRow& row, std::size_t cell, Sensor sensor) const;
  void take_value(const TableRow& row, std::size_t cell, Sighting& seen) const;

  const std::string& source_;
  SightingFormat format_;
  SightingColumns columns_;
  NameList names_;
  NameList robots_;
};

}  // namespace mapproof
