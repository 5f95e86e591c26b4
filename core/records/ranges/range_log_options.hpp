#pragma once

#include <filesystem>
#include <string>

#include "core/records/tables/column_names.hpp"

namespace mapproof {

/// Which odometry is taken where a file holds more than one.
enum class OdometrySource {
  kRecovered,  ///< That of the dead-reckoned path, which is the robot's own.
  kAsGiven,    ///< The table of odometry as it stands.
};

struct RangeLogOptions {
  std::string name = {};  ///< For titles; empty: made of the path.
  OdometrySource odometry = OdometrySource::kRecovered;
  std::filesystem::path odometry_file =
      {};  ///< Taken instead; CSV with the columns of odometry.csv.
  std::filesystem::path ground_truth_file = {};  ///< Taken instead; CSV as groundtruth.csv.
  std::filesystem::path landmarks_file = {};     ///< Taken instead; CSV as landmarks.csv.
  ColumnNames columns = {};                      ///< Columns that tables of CSV name otherwise.
  /// Whether ranges stay that repeat landmark and stamp of another one, as in the published counts.
  bool keeps_repeats = false;
};

}  // namespace mapproof
