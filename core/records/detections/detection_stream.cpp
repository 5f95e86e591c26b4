#include "core/records/detections/detection_stream.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "core/base/errors.hpp"
#include "core/json/text_input.hpp"
#include "core/records/limits.hpp"

namespace mapproof {

void ScanGatherer::end() {
  for (StreamedScan& scan : open_) close(scan);
}

void ScanGatherer::close(StreamedScan& scan) {
  if (scan.detections.empty()) return;
  std::ranges::sort(scan.detections, {}, &Detection::landmark);
  complete_.push_back(std::move(scan));
  scan.detections.clear();
}

/// The robot's scan that the row is of: the one that is open, or a new one.
void ScanGatherer::open(const ScanKey& scan, const TableRow& row) {
  const auto robot = static_cast<std::size_t>(scan.robot);
  if (robot >= open_.size()) open_.resize(robot + 1);
  StreamedScan& last = open_[robot];
  if (!last.detections.empty() && last.scan == scan) return;
  if (!last.detections.empty() && scan.key < last.scan.key)
    throw IoError(source_, fmt::format("line {}", row.line),
                  fmt::format("{} after {}: a streamed file lists a robot's scans in "
                              "ascending order",
                              rows_.scans().words(scan.key), rows_.scans().words(last.scan.key)));
  close(last);
  last.scan = scan;
  if (++scans_ > static_cast<std::size_t>(kMostSteps))
    throw IoError(source_, fmt::format("line {}", row.line),
                  fmt::format("more than {} scans", kMostSteps));
}

void ScanGatherer::take(const TableRow& row) {
  if (!std::exchange(begun_, true) && rows_.begin(row)) return;
  const ScanKey scan = rows_.scan_of(row);
  open(scan, row);
  const Detection seen = rows_.detection_of(row);
  std::vector<Detection>& detections = open_[static_cast<std::size_t>(scan.robot)].detections;
  if (std::ranges::find(detections, seen.landmark, &Detection::landmark) != detections.end())
    throw IoError(
        source_, fmt::format("line {}", row.line),
        fmt::format("landmark {} is in that scan already",
                    in_quotes(rows_.names().names()[static_cast<std::size_t>(seen.landmark)])));
  if (++detections_ > kMostDetections)
    throw IoError(source_, fmt::format("line {}", row.line),
                  fmt::format("more than {} rows", kMostDetections));
  detections.push_back(seen);
}

std::vector<std::string> DetectionStream::remarks() const {
  std::vector<std::string> remarks = gatherer_.rows().scans().remarks();
  if (table_.cut_remark() != nullptr) remarks.emplace_back(table_.cut_remark());
  return remarks;
}

}  // namespace mapproof
