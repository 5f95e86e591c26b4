#pragma once

#include <filesystem>
#include <optional>

#include "core/records/observations/sources.hpp"

namespace mapproof {

/// A data set of the UTIAS MRCLAM collection [leung2011]: Barcodes.dat, RobotN_Measurement.dat and,
/// if it is there, Landmark_Groundtruth.dat, each of them packed (NAME.gz, NAME.xz) or not.
///
/// The scans of all robots are pooled, robot by robot and in order of time: rows of one robot with
/// one time stamp are one step. Landmarks are the subjects above 5, named by their number. Dropped
/// and remarked: rows with unknown barcodes, rows of robots (subjects 1 to 5), a landmark's
/// second row in one scan, and scans that then show no landmark, since a step at which nothing
/// is seen holds no information about any two landmarks. An empty file of a robot is remarked, and
/// so is a missing ground truth.
/// @param scan_window_s  Stamps no further apart are one scan; empty: equal stamps alone.
/// @throws IoError naming file and line.
DetectionSource read_mrclam_detections(const std::filesystem::path& folder,
                                       std::optional<double> scan_window_s = {});

/// What one sensor of the set observed.
/// @return Visibility: 0 where a landmark was not seen. Bearing and range: NaN there.
/// @throws IoError as above.
ObservationSource read_mrclam(const std::filesystem::path& folder, Sensor sensor,
                              std::optional<double> scan_window_s = {});

/// Whether the folder holds a RobotN_Measurement.dat.
bool is_mrclam(const std::filesystem::path& folder);

}  // namespace mapproof
