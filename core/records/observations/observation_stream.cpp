#include "core/records/observations/observation_stream.hpp"

#include <cmath>

#include <fmt/format.h>

#include "core/json/text_input.hpp"
#include "core/records/detections/scan_grouping.hpp"
#include "core/records/detections/scan_rows.hpp"
#include "core/records/limits.hpp"
#include "core/records/observations/sources.hpp"

namespace mapproof {

ObservationStream::ObservationStream(std::string source, Sensor sensor, const TableFormat& format)
    : table_(std::move(source)),
      sensor_(sensor),
      format_(format),
      values_(table_.source(), sensor, format),
      window_s_(format.scan_window_s) {}

void ObservationStream::end() {
  table_.end([this](const TableRow& row) { read_row(row); });
  if (detections_) {
    detections_->end();
    take_scans();
    if (!names().empty() && !is_measured_) refuse_unmeasured(table_.source(), sensor_);
  } else if (!window_s_) {
    find_window();
  }
  if (open_) complete_.push_back(*std::exchange(open_, std::nullopt));
}

/// What the sensor saw in the scans that became complete.
void ObservationStream::take_scans() {
  if (!detections_) return;
  for (const StreamedScan& scan : detections_->scans()) {
    StreamedStep& step = complete_.emplace_back(scan.scan.key);
    for (const Detection& seen : scan.detections) {
      const double value = sensor_ == Sensor::kVisibility ? 1.0
                           : sensor_ == Sensor::kRange    ? seen.range_m
                                                          : seen.bearing_rad;
      if (std::isnan(value)) continue;
      step.values.emplace_back(seen.landmark, value);
      is_measured_ = true;
    }
  }
}

std::vector<std::string> ObservationStream::remarks() const {
  std::vector<std::string> remarks =
      detections_ ? detections_->remarks() : values_.scans().remarks();
  if (!grouping_.empty()) remarks.push_back(grouping_);
  if (table_.cut_remark() != nullptr) remarks.emplace_back(table_.cut_remark());
  return remarks;
}

void ObservationStream::read_row(const TableRow& row) {
  const bool first = !std::exchange(begun_, true);
  if (first && (names_detection_columns(row, format_.columns) || starts_detection_list(row)))
    detections_.emplace(table_.source(), format_);
  if (detections_) {
    detections_->take(row);
    if (first && !detections_->rows().scans().columns().measure(sensor_))
      refuse_unmeasured(table_.source(), sensor_);
    return;
  }
  if (first) {
    const bool is_header = values_.begin(row);
    require_stamps(values_.scans(), window_s_);
    if (!values_.scans().is_timed()) window_s_ = 0.0;
    if (is_header && values_.scans().columns()[ColumnRole::kRobot])
      values_.scans().fail(row.line, "a streamed file is of one robot");
    if (is_header) return;
  }
  if (window_s_) return add(values_.measured(row));
  waiting_.push_back(values_.measured(row));
  if (waiting_.size() == kFirstRows) find_window();
}

void ObservationStream::find_window() {
  FirstRows first;
  for (const ValueRows::Measured& measured : waiting_)
    first.add(measured.scan, static_cast<int>(measured.landmark));
  window_s_ = first.window_s();
  grouping_ = first_rows_remark(*window_s_, waiting_.size());
  for (const ValueRows::Measured& measured : std::exchange(waiting_, {})) add(measured);
}

bool ObservationStream::begins_step(const ValueRows::Measured& measured) const {
  if (!open_) return true;
  if (measured.scan.key == last_stamp_) return false;
  const auto row = static_cast<std::size_t>(measured.landmark);
  return measured.scan.key - last_stamp_ > *window_s_ || (row < listed_.size() && listed_[row]);
}

void ObservationStream::begin_step(const ValueRows::Measured& measured) {
  const ScanRows& scans = values_.scans();
  const double step = measured.scan.key;
  if (open_ && step < last_stamp_)
    scans.fail(measured.line, fmt::format("{} after {}: a streamed file lists its scans in "
                                          "ascending order",
                                          scans.words(step), scans.words(last_stamp_)));
  const bool begins = begins_step(measured);
  last_stamp_ = step;
  if (!begins) return;
  if (open_) complete_.push_back(*std::exchange(open_, std::nullopt));
  if (++steps_ > static_cast<std::size_t>(kMostSteps))
    scans.fail(measured.line, fmt::format("more than {} steps", kMostSteps));
  open_ = StreamedStep{.step = step, .values = {}};
  listed_.assign(listed_.size(), false);
}

void ObservationStream::add(const ValueRows::Measured& measured) {
  const ScanRows& scans = values_.scans();
  if (measured.landmark < 0)
    scans.fail(measured.line,
               "a measurement without a landmark ID (?): the data association is estimated for "
               "whole files");
  begin_step(measured);
  const auto row = static_cast<std::size_t>(measured.landmark);
  if (row >= listed_.size()) listed_.resize(row + 1, false);
  if (listed_[row])
    scans.fail(measured.line, fmt::format("landmark {} is already listed at {}",
                                          in_quotes(names()[row]), scans.words(measured.scan.key)));
  listed_[row] = true;
  if (!std::isnan(measured.value)) open_->values.emplace_back(measured.landmark, measured.value);
}

}  // namespace mapproof
