#include "core/records/detections/detection_stream.hpp"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "core/base/errors.hpp"
#include "core/json/text_input.hpp"
#include "core/records/detections/scan_grouping.hpp"
#include "core/records/limits.hpp"

namespace mapproof {

void ScanGatherer::end() {
  if (!window_s_) find_window();
  for (OpenScan& open : open_) close(open.scan);
}

std::vector<std::string> ScanGatherer::remarks() const {
  std::vector<std::string> remarks = rows_.scans().remarks();
  if (!grouping_.empty()) remarks.push_back(grouping_);
  return remarks;
}

void ScanGatherer::close(StreamedScan& scan) {
  if (scan.detections.empty()) return;
  std::ranges::sort(scan.detections, {}, &Detection::landmark);
  complete_.push_back(std::exchange(scan, {}));
}

bool ScanGatherer::begins_scan(const OpenScan& open, const Row& row) const {
  const std::vector<Detection>& detections = open.scan.detections;
  if (detections.empty()) return true;
  if (row.stamp.key == open.last_stamp) return false;
  return row.stamp.key - open.last_stamp > *window_s_ ||
         std::ranges::find(detections, row.seen.landmark, &Detection::landmark) != detections.end();
}

/// Closes the robot's scan and opens the one that the row begins.
void ScanGatherer::open(OpenScan& last, const Row& row) {
  close(last.scan);
  last.scan.scan = row.stamp;
  if (++scans_ > static_cast<std::size_t>(kMostSteps))
    throw IoError(source_, fmt::format("line {}", row.line),
                  fmt::format("more than {} scans", kMostSteps));
}

void ScanGatherer::add(const Row& row) {
  const auto robot = static_cast<std::size_t>(row.stamp.robot);
  if (robot >= open_.size()) open_.resize(robot + 1);
  OpenScan& last = open_[robot];
  std::vector<Detection>& detections = last.scan.detections;
  if (!detections.empty() && row.stamp.key < last.last_stamp)
    throw IoError(
        source_, fmt::format("line {}", row.line),
        fmt::format("{} after {}: a streamed file lists a robot's scans in "
                    "ascending order",
                    rows_.scans().words(row.stamp.key), rows_.scans().words(last.last_stamp)));
  if (begins_scan(last, row)) open(last, row);
  last.last_stamp = row.stamp.key;
  if (std::ranges::find(detections, row.seen.landmark, &Detection::landmark) != detections.end())
    throw IoError(
        source_, fmt::format("line {}", row.line),
        fmt::format("landmark {} is in that scan already",
                    in_quotes(rows_.names().names()[static_cast<std::size_t>(row.seen.landmark)])));
  detections.push_back(row.seen);
}

void ScanGatherer::find_window() {
  FirstRows first;
  for (const Row& row : waiting_) first.add(row.stamp, row.seen.landmark);
  window_s_ = first.window_s();
  grouping_ = first_rows_remark(*window_s_, waiting_.size());
  for (const Row& row : std::exchange(waiting_, {})) add(row);
}

void ScanGatherer::take(const TableRow& row) {
  if (!std::exchange(begun_, true)) {
    const bool is_header = rows_.begin(row);
    require_stamps(rows_.scans(), window_s_);
    if (!rows_.scans().is_timed()) window_s_ = 0.0;
    if (is_header) return;
  }
  const ScanKey stamp = rows_.scan_of(row);
  const Row read{stamp, rows_.detection_of(row), row.line};
  if (++detections_ > kMostDetections)
    throw IoError(source_, fmt::format("line {}", row.line),
                  fmt::format("more than {} rows", kMostDetections));
  if (window_s_) return add(read);
  waiting_.push_back(read);
  if (waiting_.size() == kFirstRows) find_window();
}

std::vector<std::string> DetectionStream::remarks() const {
  std::vector<std::string> remarks = gatherer_.remarks();
  if (table_.cut_remark() != nullptr) remarks.emplace_back(table_.cut_remark());
  return remarks;
}

}  // namespace mapproof
