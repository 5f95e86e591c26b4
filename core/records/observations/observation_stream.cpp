#include "core/records/observations/observation_stream.hpp"

#include <cmath>

#include <fmt/format.h>

#include "core/json/text_input.hpp"
#include "core/records/detections/scan_rows.hpp"
#include "core/records/limits.hpp"

namespace mapproof {

ObservationStream::ObservationStream(std::string source, Sensor sensor, const TableFormat& format)
    : table_(std::move(source)),
      sensor_(sensor),
      format_(format),
      values_(table_.source(), sensor, format) {}

void ObservationStream::end() {
  table_.end([this](const TableRow& row) { read_row(row); });
  if (detections_) detections_->end();
  if (open_) complete_.push_back(*std::exchange(open_, std::nullopt));
}

std::vector<StreamedStep> ObservationStream::steps() {
  if (!detections_) return std::exchange(complete_, {});
  std::vector<StreamedStep> steps;
  for (const StreamedScan& scan : detections_->scans()) {
    steps.push_back({scan.scan.key, {}});
    for (const Detection& seen : scan.detections) {
      const double value = sensor_ == Sensor::kVisibility ? 1.0
                           : sensor_ == Sensor::kRange    ? seen.range_m
                                                          : seen.bearing_rad;
      if (!std::isnan(value)) steps.back().values.emplace_back(seen.landmark, value);
    }
  }
  return steps;
}

std::vector<std::string> ObservationStream::remarks() const {
  std::vector<std::string> remarks =
      (detections_ ? detections_->rows().scans() : values_.scans()).remarks();
  if (table_.cut_remark() != nullptr) remarks.emplace_back(table_.cut_remark());
  return remarks;
}

void ObservationStream::read_row(const TableRow& row) {
  const bool first = !std::exchange(begun_, true);
  if (first && (names_detection_columns(row, format_.columns) || starts_detection_list(row)))
    detections_.emplace(table_.source(), format_);
  if (detections_) return detections_->take(row);
  if (first && values_.begin(row)) {
    if (values_.scans().columns()[ColumnRole::kRobot])
      values_.scans().fail(row.line, "a streamed file is of one robot");
    return;
  }
  add(values_.measured(row));
}

void ObservationStream::begin_step(const ValueRows::Measured& measured) {
  const ScanRows& scans = values_.scans();
  const double step = measured.scan.key;
  if (open_ && step < open_->step)
    scans.fail(measured.line, fmt::format("{} after {}: a streamed file lists its scans in "
                                          "ascending order",
                                          scans.words(step), scans.words(open_->step)));
  if (open_ && step == open_->step) return;
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
