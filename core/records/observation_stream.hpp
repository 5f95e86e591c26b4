#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include "core/model/sensor.hpp"
#include "core/records/name_list.hpp"
#include "core/records/sightings.hpp"
#include "core/records/table_reader.hpp"

namespace mapproof {

/// All that one step of a growing file listed.
struct StreamedStep {
  double step = 0.0;                                    ///< Or time.
  std::vector<std::pair<Eigen::Index, double>> values;  ///< Landmark and value; missing ones not.
};

/// Reads long CSV (step or time, landmark, value) as it grows. A line counts once its end is there,
/// and a step once a row of a later one is. Steps come in ascending order; a cell holds no line
/// feed.
class ObservationStream {
 public:
  /// @param source  What to call the file in errors.
  /// @param unit    Of bearings.
  ObservationStream(std::string source, Sensor sensor, AngleUnit unit = AngleUnit::kRadians);
  ObservationStream(const ObservationStream&) = delete;
  ObservationStream& operator=(const ObservationStream&) = delete;

  /// @throws IoError with the line, as read_observations; or for a step that is not ascending, or a
  ///         line of more than 1 MiB.
  void take(std::string_view bytes);

  /// Forgets a line whose end has not come, as of a file that is still written to.
  void drop_half_line() { pending_.clear(); }

  /// There will be no more: the last line needs no end, and the last step is complete.
  /// @throws IoError as take().
  void end();

  /// The steps that became complete since the last call, ascending.
  std::vector<StreamedStep> steps() { return std::exchange(complete_, {}); }

  /// Of all landmarks so far, in the order in which they came.
  const std::vector<std::string>& names() const { return names_.names(); }

 private:
  void read_line(std::string_view line);
  void read_header(const TableRow& row, const std::string& place);
  void add(double step, Eigen::Index landmark, double value, const std::string& place);

  std::string source_;
  Sensor sensor_;
  AngleUnit unit_;
  NameList names_;
  std::string pending_;                 ///< A line whose end has not come.
  std::size_t line_ = 0;                ///< Of the file, that was read last.
  bool begun_ = false;                  ///< A row was read: no header comes any more.
  std::size_t columns_[3] = {0, 1, 2};  ///< Of step, landmark, value.
  std::size_t width_ = 3;               ///< Cells of a row.
  std::string word_ = "step";           ///< What the first of them is called.
  std::optional<StreamedStep> open_;
  std::vector<bool> listed_;  ///< Landmarks in the open step.
  std::vector<StreamedStep> complete_;
  std::size_t steps_ = 0;
};

}  // namespace mapproof
