#pragma once

#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "app/map/alignment.hpp"
#include "app/map/map_result.hpp"
#include "app/map/reference.hpp"
#include "core/incremental/incremental_map.hpp"
#include "core/model/sensor.hpp"
#include "core/records/detections/detections.hpp"

namespace mapproof {

/// How an incremental map is made from a table.
struct IncrementalTable {
  std::string source = {};                      ///< What to call it in errors.
  Sensor sensor = Sensor::kRange;               ///< Of values alone.
  TableFormat format = {};                      ///< How the table is to be understood.
  IncrementalOptions options = {};              ///< Of one sensor.
  std::optional<NamedPointsFile> anchors = {};  ///< Fitted to once three of them are on the map.
  std::optional<NamedPointsFile> ground_truth = {};  ///< For scores, of what is known of it so far.
  FrameFit fit = {};
  bool find_moved = false;  ///< Range and bearing: notice landmarks that moved.
};

/// An incremental map of a table. Without anchors or ground truth each map is aligned to the one
/// before, so that it does not jump.
class IncrementalSource {
 public:
  virtual ~IncrementalSource() = default;

  /// @throws IoError for what cannot be read.
  virtual void take(std::string_view bytes) = 0;
  /// Forgets a line whose end has not come.
  virtual void drop_half_line() = 0;
  /// There will be no more. @throws IoError as take().
  virtual void end() = 0;

  /// Takes in the steps that are complete. @return How many. @throws IoError as take().
  virtual long take_steps() = 0;
  virtual long steps() const = 0;

  /// The map so far; its remarks name moved landmarks.
  virtual MapResult update() = 0;
  /// The map of all observations, with all remarks and warnings.
  virtual MapResult last_update() = 0;
};

/// The incremental map of a long table of one sensor.
std::unique_ptr<IncrementalSource> incremental_values(const IncrementalTable& table);

/// The incremental map of detections of range and bearing.
std::unique_ptr<IncrementalSource> incremental_pairs(const IncrementalTable& table);

/// The incremental map of a table of ranges that are taken together: step or time, landmark, range
/// in metres. Each update is the spectral map (core/range_slam/factors/incremental_spectral_map) of
/// all steps so far that have a range to every landmark of the first one. From four anchors on the
/// map is that of known landmarks. `sensor` and `options` of the table do not count.
std::unique_ptr<IncrementalSource> incremental_ranges(const IncrementalTable& table);

}  // namespace mapproof
