#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include "core/model/sensor.hpp"
#include "core/records/detections/detection_stream.hpp"
#include "core/records/detections/detections.hpp"
#include "core/records/tables/streamed_table.hpp"
#include "core/records/tables/table_reader.hpp"
#include "core/records/tables/value_rows.hpp"

namespace mapproof {

/// All that one step of a file that grows listed.
struct StreamedStep {
  double step = 0.0;                                    ///< Or time.
  std::vector<std::pair<Eigen::Index, double>> values;  ///< Landmark and value; missing ones not.
};

/// Reads one sensor's values from long CSV (step or time, landmark, value) as it grows. A line
/// counts once its end is there (see StreamedTable), and a step once a row of a later one is. Steps
/// come in ascending order; time stamps are grouped as by ScanGatherer. A header of detections (see
/// read_detections) does as well: of each scan what the sensor saw.
class ObservationStream {
 public:
  /// @param source  What to call the file in errors.
  ObservationStream(std::string source, Sensor sensor, const TableFormat& format = {});
  ObservationStream(const ObservationStream&) = delete;
  ObservationStream& operator=(const ObservationStream&) = delete;

  /// @throws IoError with the line, as read_observations and StreamedTable; for a step that is not
  ///         ascending; or for detections without a column that the sensor measures.
  void take(std::string_view bytes) {
    table_.take(bytes, [this](const TableRow& row) { read_row(row); });
  }

  /// Forgets a line whose end has not come, as of a file that is still being written.
  void drop_half_line() { table_.drop_half_line(); }

  /// There will be no more: the last line needs no end, and the last step is complete.
  /// @throws IoError as take(), or if there were detections and the sensor measured none of them.
  void end();

  /// The steps that became complete since the last call, ascending.
  std::vector<StreamedStep> steps() {
    take_scans();
    return std::exchange(complete_, {});
  }

  /// Remarks after end(), a sentence each.
  std::vector<std::string> remarks() const;

  /// Of all landmarks so far, in the order in which they came.
  const std::vector<std::string>& names() const {
    return detections_ ? detections_->rows().names().names() : values_.names().names();
  }

 private:
  void read_row(const TableRow& row);
  void take_scans();
  void find_window();
  void add(const ValueRows::Measured& measured);
  bool begins_step(const ValueRows::Measured& measured) const;
  void begin_step(const ValueRows::Measured& measured);

  StreamedTable table_;
  Sensor sensor_;
  TableFormat format_;
  ValueRows values_;
  std::optional<ScanGatherer> detections_;    ///< If that is what the first row shows.
  bool is_measured_ = false;                  ///< The sensor measured one of them.
  std::optional<double> window_s_;            ///< Empty: not found yet.
  std::vector<ValueRows::Measured> waiting_;  ///< Until it is.
  std::string grouping_;                      ///< A remark.
  double last_stamp_ = 0.0;                   ///< Of the open step.
  bool begun_ = false;                        ///< A row was read: no header comes any more.
  std::optional<StreamedStep> open_;
  std::vector<bool> listed_;  ///< Landmarks in the open step.
  std::vector<StreamedStep> complete_;
  std::size_t steps_ = 0;
};

}  // namespace mapproof
