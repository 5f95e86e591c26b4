#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <span>
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
  // Of range logs alone:
  kHeading,
  kDistance,       ///< Of a motion.
  kHeadingChange,  ///< Of a motion.
  kSideways,       ///< Of a motion, to the left.
};
inline constexpr std::size_t kColumnRoles = 15;

/// "landmark", as options, messages and headers call it.
std::string_view name(ColumnRole role);

/// A column that the user names.
struct NamedColumn {
  ColumnRole role;
  std::string header;  ///< Its cell in the header, or the column's number, from 1.
  /// Another table of those that are read together has it: this one need not.
  bool is_elsewhere = false;

  bool operator==(const NamedColumn&) const = default;
};
using ColumnNames = std::vector<NamedColumn>;

/// The roles in tables of observations, and in the tables of a range log.
inline constexpr std::array kTableRoles = {
    ColumnRole::kStep,     ColumnRole::kTime,  ColumnRole::kNanoseconds, ColumnRole::kRobot,
    ColumnRole::kLandmark, ColumnRole::kRange, ColumnRole::kBearing,     ColumnRole::kValue,
    ColumnRole::kX,        ColumnRole::kY,     ColumnRole::kRight};
inline constexpr std::array kRangeLogRoles = {
    ColumnRole::kTime,  ColumnRole::kNanoseconds, ColumnRole::kRobot,         ColumnRole::kLandmark,
    ColumnRole::kRange, ColumnRole::kDistance,    ColumnRole::kHeadingChange, ColumnRole::kSideways,
    ColumnRole::kX,     ColumnRole::kY,           ColumnRole::kHeading};

/// All of them: of files of any kind.
inline constexpr std::array kAllRoles = {
    ColumnRole::kStep,     ColumnRole::kTime,          ColumnRole::kNanoseconds,
    ColumnRole::kRobot,    ColumnRole::kLandmark,      ColumnRole::kRange,
    ColumnRole::kBearing,  ColumnRole::kValue,         ColumnRole::kX,
    ColumnRole::kY,        ColumnRole::kRight,         ColumnRole::kHeading,
    ColumnRole::kDistance, ColumnRole::kHeadingChange, ColumnRole::kSideways};

/// "time=Zeit,landmark=Objekt" in parts. A role may have several headers, each of another file.
/// @throws InvalidInput for what names none of the roles, or one twice alike.
ColumnNames column_names(const std::vector<std::string>& parts,
                         std::span<const ColumnRole> roles = kTableRoles);

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

/// Whether the user names that column of the table, by its header's cell or its number from 0.
bool is_named(const NamedColumn& column, std::string_view cell, std::size_t number);

/// The cells of a header, or of the first row of a table without one.
using HeaderCells = std::span<const std::string_view>;

/// Those of the named columns that a table has, by header, else by number. The others: their words.
ColumnNames columns_in(HeaderCells header, const ColumnNames& names);

/// @param header  Empty: of a file that is not a table.
/// @throws IoError naming the headers that there are, for a named column that neither this table
///         nor another one has.
void require_columns(HeaderCells header, const ColumnNames& names, const std::string& source);

/// The factor to metres, seconds or radians of a column whose header's cell is one of the words, in
/// any case, with a unit of the role or without. Empty: it is none of them, or of another unit.
/// @param words  In small letters, without blanks, dots and underscores.
std::optional<double> column_factor(std::string_view cell, ColumnRole role,
                                    std::span<const std::string_view> words);

/// What tables of positions and paths call x and y besides.
inline constexpr std::array<std::string_view, 8> kEastWords = {
    "east", "easting", "ost", "rechtswert", "px", "posx", "xpos", "positionx"};
inline constexpr std::array<std::string_view, 8> kNorthWords = {
    "north", "northing", "nord", "hochwert", "py", "posy", "ypos", "positiony"};

/// The same of a column that the user names: of the unit behind the first word, if there is one.
double named_column_factor(std::string_view cell, ColumnRole role);

/// Whether a header's cell names steps, scans or times.
bool names_steps(std::string_view cell, const ColumnNames& columns = {});

/// Whether a header's cell names a speed or a rate of turning, by its word or its unit: "v_ms",
/// "yaw_rate", "omega [deg/s]".
bool names_rate(std::string_view cell);

/// What tables of positions call heights.
inline constexpr std::array<std::string_view, 8> kUpWords = {
    "z", "pz", "posz", "height", "altitude", "elevation", "hoehe", "höhe"};

/// Whether a heading names latitudes or longitudes, in any case: no reader projects them.
bool is_geographic(std::string_view heading);

}  // namespace mapproof
