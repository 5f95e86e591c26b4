#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/model/sensor.hpp"

namespace mapproof {

/// What a column of a long table holds.
enum class ColumnRole {
  kStep,
  kTime,
  kNanoseconds,  ///< Added to the time.
  kRobot,
  kLandmark,
  kRange,
  kBearing,
  kValue,
  kX,      ///< Of the landmark in the robot's frame: ahead, m.
  kY,      ///< To the left, m.
  kRight,  ///< The same to the right, as in a camera's frame.
};
inline constexpr std::size_t kColumnRoles = 11;

/// "landmark", as options, messages and headers call it.
std::string_view name(ColumnRole role);

/// A column that the user names.
struct NamedColumn {
  ColumnRole role;
  std::string header;  ///< Its cell in the header, or the column's number, from 1.

  bool operator==(const NamedColumn&) const = default;
};
using ColumnNames = std::vector<NamedColumn>;

/// "time=Zeit,landmark=Objekt" in parts, "landmark=Objekt" each.
/// @throws InvalidInput for what names no role, or one twice.
ColumnNames column_names(const std::vector<std::string>& parts);

/// What a header's cell says of its column.
struct ColumnHeading {
  std::optional<ColumnRole> role = {};  ///< Empty: not known.
  double factor = 1.0;                  ///< To metres or seconds.
  std::optional<AngleUnit> unit = {};   ///< Of bearings, if it is stated.
  std::string unknown_unit = {};        ///< A unit that no such column has.
};

/// Understands a header's cell, in any case and with a unit or without: "Range [cm]",
/// "bearing_deg", "tag_id", "header.stamp.sec".
/// @param number  Of the column, from 0.
ColumnHeading column_heading(std::string_view cell, std::size_t number, const ColumnNames& columns);

/// Whether a header's cell names steps, scans or times.
bool names_steps(std::string_view cell, const ColumnNames& columns = {});

}  // namespace mapproof
