#pragma once

#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/model/detection_log.hpp"
#include "core/model/histories/history_blocks.hpp"
#include "core/model/observation_history.hpp"
#include "core/model/points.hpp"
#include "core/model/sensor.hpp"
#include "core/records/tables/cells.hpp"
#include "core/records/tables/column_names.hpp"
#include "core/records/tables/packed_table.hpp"

namespace mapproof {

/// How a CSV file holds observations.
enum class Layout {
  kAuto,        ///< As the table shows, see table_shape.hpp; a doubtful one is refused.
  kWide,        ///< One row per landmark, one column per step.
  kTransposed,  ///< One row per step, one column per landmark; the steps' times may come first.
  kLong,        ///< One row per observation: step or time, landmark, value; a robot too, whose
                ///< steps are then its own.
};

/// Where the bearings of a table are zero, and their sense. A map depends on neither: it compares
/// the landmarks of one scan.
enum class BearingConvention {
  kCounterclockwise,  ///< From the heading, counter-clockwise (to the left): what mapproof holds.
  kClockwise,         ///< From the heading, clockwise (to the right).
  kCompass,           ///< From north, clockwise.
  kEast,              ///< From the x axis, counter-clockwise.
};

inline bool is_clockwise(BearingConvention convention) {
  return convention == BearingConvention::kClockwise || convention == BearingConvention::kCompass;
}

/// What a reader understood of a file.
struct TableReading {
  std::string form;  ///< "wide table", "transposed table", "detections"; empty: not a table.
  /// Role and header of each column that was read: {"landmark", "Objekt"}.
  std::vector<std::pair<std::string, std::string>> columns = {};
  char separator = '\0';  ///< kBlanks of TableReader: blanks.
  bool has_decimal_commas = false;
  std::string packing = {};  ///< "gzip", "xz", "UTF-16".
  std::string times = {};    ///< How times are written, where that is not in seconds: "dates".
  AngleUnit unit = AngleUnit::kRadians;  ///< Of bearings.
  BearingConvention convention = BearingConvention::kCounterclockwise;
};

/// What scans showed, with what is needed to talk about the file that it came from.
struct DetectionSource {
  DetectionLog log;
  std::optional<Points> ground_truth_m;  ///< M x 2, if the source holds it; NaN rows: unknown.
  std::vector<std::string> remarks;      ///< What was dropped or assumed, a sentence each.
  std::vector<std::string> locations;    ///< M; where the file holds the landmark: "line 7".
  std::string path;                      ///< For errors: the file or folder that was read.
  TableReading reading = {};
};

/// How the user says that a table is to be understood; what is not said is recognised.
struct TableFormat {
  AngleUnit unit = AngleUnit::kRadians;  ///< Of bearings, where the file does not state it.
  /// What a column `value` holds; visibility: 1, seen.
  std::optional<Sensor> value = std::nullopt;
  Layout layout = Layout::kAuto;
  BearingConvention convention = BearingConvention::kCounterclockwise;
  ColumnNames columns = {};  ///< Columns that a long or transposed table names otherwise.
  /// Seconds between time stamps of one scan, see ScanWindow; empty: found from the gaps.
  std::optional<double> scan_window_s = std::nullopt;
};

/// A measurement without a landmark ID.
struct UnassociatedMeasurement {
  Eigen::Index step = 0;  ///< Column of the history.
  double number = 0.0;    ///< Step or time, as the file has it.
  double value = 0.0;     ///< As the history's; NaN: missing.
  std::size_t line = 0;
};

/// The landmark of such a measurement in a long table.
inline constexpr std::string_view kUnassociatedMark = "?";

/// A user's observations, with what is needed to talk about the file they came from.
struct ObservationSource {
  ObservationHistory history;
  std::optional<Points> ground_truth_m;  ///< M x 2, if the source holds it; NaN rows: unknown.
  std::vector<std::string> remarks;      ///< What was dropped or assumed, a sentence each.
  std::vector<std::string>
      locations;     ///< M; where the file holds the landmark: "line 7", "/values/6".
  std::string path;  ///< For errors: the file or folder that was read.
  /// Of a long table, in the order of its lines; they are not in the history.
  std::vector<UnassociatedMeasurement> unassociated = {};
  TableReading reading = {};
};

/// A table of landmarks times steps that is kept as the numbers of its file, since an array of its
/// values would take several times the memory.
struct PackedHistory {
  Sensor sensor = Sensor::kVisibility;
  std::vector<std::string> names;  ///< Of the landmarks, M of them, all different.
  Eigen::Index steps = 0;
  double missing = 0.0;  ///< So many of the M x N values are.
  std::shared_ptr<const PackedTable> table;
  ValueForm form;                           ///< How the table writes values.
  bool is_transposed = false;               ///< Its rows are steps.
  std::optional<std::size_t> label_column;  ///< It holds no values.

  Eigen::Index landmarks() const { return std::ssize(names); }
  /// The object must outlive what is returned.
  HistoryBlocks blocks() const;
  ObservationHistory array() const;
};

/// What is known of a source of observations but for its history.
struct PackedSource {
  PackedHistory history;
  std::vector<std::string> remarks;    ///< What was dropped or assumed, a sentence each.
  std::vector<std::string> locations;  ///< M; where the file holds the landmark: "line 7".
  std::string path;                    ///< For errors: the file that was read.
  TableReading reading = {};
};

/// The same observations as an array.
ObservationSource unpacked(const PackedSource& source);

/// Landmarks with known positions: anchors, or the ground truth.
struct NamedPoints {
  std::vector<std::string> names;      ///< M, all different.
  Points positions_m;                  ///< M x 2, finite.
  std::vector<std::string> locations;  ///< M; where the file holds the landmark: "line 7".
  /// A remark on heights that the file has too; empty: none, or all of them 0.
  std::string heights = {};
};

/// Refuses detections of which the sensor measured nothing. @throws IoError.
[[noreturn]] void refuse_unmeasured(const std::string& source, Sensor sensor);

/// What one sensor observed of detections.
/// @throws IoError if that were more than 2e8 entries, or there is nothing of that kind.
ObservationSource observations_of(DetectionSource source, Sensor sensor);

}  // namespace mapproof
