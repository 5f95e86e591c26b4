#pragma once

#include <memory>
#include <string>

#include "app/command_line.hpp"
#include "app/map/incremental.hpp"
#include "app/map/outputs.hpp"

namespace mapproof {

/// How often an incremental map is updated.
struct UpdateInterval {
  long steps = 0;        ///< After so many; 0: by time.
  double seconds = 1.0;  ///< After so long, if there is a step more.
};

/// "100": steps; "2s", "0.5s": seconds. @throws InvalidInput, naming the option.
UpdateInterval update_interval(const std::string& text);

/// The streamed file, and how it is mapped.
struct IncrementalRequest {
  std::string path;        ///< "-": standard input. Packed or not.
  IncrementalTable table;  ///< Its source is set from the path.
  std::unique_ptr<IncrementalSource> (*source)(const IncrementalTable& table) = nullptr;
  UpdateInterval every;
};

/// Reads a streamed file to its end, or to SIGINT or SIGTERM, and updates its map:
/// map.json, map.csv and the figure after every update, each at once, and tables and report after
/// the last. A file that is cut short or replaced ends it, too, with a remark. Without anchors each
/// map is aligned to the one before, so that it does not jump. What is noticed meanwhile goes to
/// the console. The folder is locked meanwhile; a map that was there is replaced.
/// @return The command's exit code.
/// @throws IoError for what cannot be read, or if the folder holds something else, or another
///         process writes there.
int write_incremental(const IncrementalRequest& request, const MapOutput& location,
                      const Invocation& invocation);

}  // namespace mapproof
