#pragma once

#include <cstddef>
#include <limits>
#include <numbers>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/model/histories/history_blocks.hpp"
#include "core/model/sensor.hpp"

namespace mapproof {

/// Says what is wrong with a value as an observation of that kind; empty if nothing is. A value
/// that is missing is NaN and right.
std::string observation_problem(Sensor sensor, double value);

inline double in_radians(double degrees) { return degrees * std::numbers::pi / 180.0; }

/// A cell as an observation, NaN if it is missing. Empty if it is wrong: cell_problem() gives the
/// reason.
std::optional<double> observation_in(std::string_view cell, Sensor sensor);
std::string cell_problem(std::string_view cell, Sensor sensor);

/// Finds ranges that are angles by mistake: values that fill a full turn, in degrees or radians,
/// and jump from one of its ends to the other as no distance does.
class FullTurn {
 public:
  /// @param before  That of the same landmark one step before; NaN: none.
  void add(double value, double before);
  /// A remark with the way out; empty: they are no angles.
  std::string remark() const;

 private:
  double smallest_ = std::numeric_limits<double>::infinity();
  double largest_ = 0.0;
  std::size_t degree_jumps_ = 0, radian_jumps_ = 0;
};

/// Adds the remark of FullTurn on the ranges of a history, if it has one.
void remark_on_angles(const HistoryBlocks& ranges, std::vector<std::string>& remarks);

/// @param place  For the error: "line 7". @throws IoError if the history grows beyond its bounds.
void check_size(const std::string& source, const std::string& location, std::size_t landmarks,
                std::size_t steps);

/// How the values of a column are written.
struct ValueForm {
  AngleUnit unit = AngleUnit::kRadians;  ///< Of bearings.
  double factor = 1.0;                   ///< Metres of one unit of a range.
  bool is_clockwise = false;             ///< The bearings: they get the other sign.
};

/// A number of a file as a range in metres or a bearing in radians, counter-clockwise; empty if it
/// is none.
std::optional<double> detection_of(double number, Sensor sensor, const ValueForm& form);

/// A cell as a range in metres or a bearing in radians, counter-clockwise; NaN if it is missing.
/// Empty if it is wrong: detection_problem() gives the reason.
std::optional<double> detection_value(std::string_view cell, Sensor sensor, const ValueForm& form);
std::string detection_problem(std::string_view cell, Sensor sensor, const ValueForm& form);

}  // namespace mapproof
