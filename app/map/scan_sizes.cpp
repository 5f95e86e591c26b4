#include "app/map/scan_sizes.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "app/result_json.hpp"
#include "core/observe/features.hpp"

namespace mapproof {
namespace {

void add_scan(long landmarks, ScanSizes& sizes) {
  sizes.detections += landmarks;
  sizes.with_two += landmarks >= 2 ? 1 : 0;
  sizes.most = std::max(sizes.most, landmarks);
}

}  // namespace

ScanSizes scan_sizes(const DetectionLog& log) {
  ScanSizes sizes{.scans = log.steps};
  for (auto row = log.detections.begin(); row != log.detections.end();) {
    const auto end = std::find_if(row, log.detections.end(),
                                  [&](const Detection& other) { return other.step != row->step; });
    add_scan(end - row, sizes);
    row = end;
  }
  return sizes;
}

ScanSizes scan_sizes(const HistoryBlocks& history) {
  ScanSizes sizes{.scans = history.steps()};
  const auto add = [&](Eigen::Index, const Eigen::MatrixXd& values) {
    for (Eigen::Index step = 0; step < values.cols(); ++step) {
      const auto column = values.col(step).array();
      add_scan(history.sensor() == Sensor::kVisibility ? (column == 1.0).count()
                                                       : (column == column).count(),
               sizes);
    }
  };
  for_blocks(history, history.steps(), add);
  return sizes;
}

void add_scan_sizes(const ScanSizes& sizes, MapResult& result) {
  if (sizes.scans == 0) return;
  const auto scans = static_cast<double>(sizes.scans);
  const double mean = static_cast<double>(sizes.detections) / scans;
  result.read.emplace_back(
      "Landmarks per scan",
      fmt::format("{:.1f} on average, at most {}; two or more in {:.0f} % of the scans", mean,
                  sizes.most, 100.0 * static_cast<double>(sizes.with_two) / scans));
  result.members.push_back({"scans",
                            {{"count", sizes.scans},
                             {"landmarks_mean", number_or_null(mean)},
                             {"landmarks_most", sizes.most},
                             {"with_two_or_more", sizes.with_two}}});
}

}  // namespace mapproof
