#pragma once

#include <filesystem>

#include "core/model/range_log.hpp"

namespace mapproof::test {

/// A drive of 200 s past six landmarks, ranges 5 % long and 10 cm noisy, with odometry from a known
/// start and the ground truth.
RangeLog drive_log();

/// Which files of a log's folder are written.
struct LogFiles {
  bool odometry = true;
  bool ground_truth = true;
  bool landmarks = true;
};

/// The log as a folder of CSV files.
void write_log(const RangeLog& log, const std::filesystem::path& folder,
               const LogFiles& files = {});

/// Every landmark ranged to at each of some times, without odometry; the ground truth is kept.
RangeLog log_of_common_times();

}  // namespace mapproof::test
