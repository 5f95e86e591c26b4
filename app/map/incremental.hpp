#pragma once

#include <memory>
#include <string>
#include <string_view>

#include "app/command_line.hpp"
#include "app/map/arguments.hpp"
#include "app/map/outputs.hpp"
#include "app/map/pipeline.hpp"

namespace mapproof {

/// A table that is read as it grows, and what of it is to be mapped.
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

  /// The map so far, embedded, with what is known of its landmarks: see last_steps(). Its remarks
  /// are on what was noticed since the last one.
  virtual MapDraft update() = 0;
  /// The map of all observations, with all remarks.
  virtual MapDraft last_update() = 0;
};

/// Which incremental map is made of a job's file: of `path`, by `sensor`, `table_format()`,
/// `setting`, `embedder`, known positions and `find_moved`.
using MakeIncremental = std::unique_ptr<IncrementalSource> (*)(const MapJob& job);

/// Of a long table of one sensor.
std::unique_ptr<IncrementalSource> incremental_values(const MapJob& job);

/// Of detections of range and bearing.
std::unique_ptr<IncrementalSource> incremental_pairs(const MapJob& job);

/// Of a table of ranges that are taken together: step or time, landmark, range in metres. Each
/// update is the spectral map (core/range_slam/factors/incremental_spectral_map) of all steps so
/// far that have a range to every landmark of the first one. From four anchors on the map is that
/// of known landmarks. Sensor, setting and embedder of the job do not count.
std::unique_ptr<IncrementalSource> incremental_ranges(const MapJob& job);

/// Reads a file, packed or not, that grows ("-": standard input), to its end or to SIGINT or
/// SIGTERM, and updates its map every `job.every`: map.json, map.csv and the figure after every
/// update, each at once, and tables and report after the last. A file that is cut short or replaced
/// ends it, too, with a remark. Each map takes the last steps of the pipeline. One that neither
/// anchors nor a ground truth tie to a frame is aligned to the one before, so that it does not
/// jump. What is noticed meanwhile goes to the console. The folder is locked meanwhile; a map that
/// was there is replaced.
/// @return The command's exit code.
/// @throws IoError for what cannot be read, or if the folder holds something else, or another
///         process writes there. @throws InvalidInput for an interval that is none.
int write_incremental(const MapJob& job, MakeIncremental make, const MapOutput& location,
                      const Invocation& invocation);

}  // namespace mapproof
