#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "core/model/sighting_log.hpp"
#include "core/records/name_list.hpp"
#include "core/records/sighting_columns.hpp"
#include "core/records/sightings.hpp"
#include "core/records/table_reader.hpp"

namespace mapproof {

/// What the rows of every long table have in common: each is one landmark in one look, and the
/// columns say which look that is.
class LookRows {
 public:
  /// @param source  What to call the table in errors; must outlive the object.
  explicit LookRows(const std::string& source) : source_(source), robots_(source) {}

  const std::string& source() const { return source_; }

  void set_columns(SightingColumns columns) { columns_ = std::move(columns); }
  const SightingColumns& columns() const { return columns_; }

  /// @throws IoError with the line for a row of another width, or whose look is no number.
  LookKey look_of(const TableRow& row);

  /// What a cell holds in metres or radians, or 0 and 1; NaN if it is missing.
  /// @throws IoError with the line for anything else.
  double value(const TableRow& row, SightingColumn column, Sensor sensor, AngleUnit unit) const;

  /// The landmark's label. @pre After look_of() of the row.
  std::string_view label(const TableRow& row) const {
    return row.cells[*columns_[SightingColumn::kLandmark]];
  }

  bool is_timed() const { return !columns_[SightingColumn::kStep]; }
  /// Names of the robots, by LookKey::robot; none if no column tells them apart.
  const std::vector<std::string>& robots() const { return robots_.names(); }

  /// "step 3" or "time 3.5", as errors name a look.
  std::string words(double key) const;

  /// What has to be said of the columns, a sentence each.
  std::vector<std::string> remarks() const;

  [[noreturn]] void fail(std::size_t line, const std::string& what) const;

 private:
  const std::string& source_;
  SightingColumns columns_;
  NameList robots_;
};

}  // namespace mapproof
