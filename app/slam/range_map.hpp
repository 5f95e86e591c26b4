#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "app/map/reference.hpp"
#include "core/experiment/slam_run.hpp"
#include "core/records/studies/folder_lock.hpp"

namespace mapproof {

/// The file that marks a folder as that of a range-only map.
inline constexpr const char* kSlamFile = "slam.json";

/// Positions of landmarks from a file, as a log's.
/// @throws IoError naming file and line of a landmark that the log has no range to.
KnownLandmarks known_landmarks_of(const RangeLog& log, const NamedPointsFile& file);

/// Runs every method that the log allows; its remarks name what the log does not allow:
/// without odometry no windows, no reflection, no refinement; with fewer than four known landmarks
/// no map by them.
/// The noise is estimated from the log but for what `fit` gives, and the fit of log and map is
/// tested. The results do not depend on the unit of lengths.
/// @param repairs  The map under the cause of a misfit is made, too, and is the result unless it
///                 predicts held-out ranges worse; a remark has both likelihoods.
SlamRunResult range_map(RangeLog log, const std::optional<KnownLandmarks>& known,
                        LogFitOptions fit = {}, bool repairs = false);

/// The record whose path and landmarks are the result: the repaired one if it was asked for, the
/// refinement that took part in the test of the fit, that from odometry,
/// else the first of the spectral ones that came out, known landmarks first, else what there is.
/// Null if no method gave a path with a landmark.
const SlamRecord* best_record(const SlamRun& run);

/// The folder of a range-only map while it is written: made, checked, locked, and rid of what a
/// killed process left behind.
class SlamFolder {
 public:
  /// @throws IoError if the folder holds anything else, or what was made of another log or with
  ///         other known landmarks, or if another process writes there.
  SlamFolder(const std::filesystem::path& folder, const SlamRun& run);

  std::filesystem::path path() const { return folder_.files().path(); }
  const FolderLock& lock() const { return folder_.lock(); }

 private:
  LockedFolder folder_;
};

}  // namespace mapproof
