#include "core/records/observation_stream.hpp"

#include <cmath>

#include <fmt/format.h>

#include "core/json/text_input.hpp"
#include "core/records/limits.hpp"
#include "core/records/sighting_columns.hpp"

namespace mapproof {

ObservationStream::ObservationStream(std::string source, Sensor sensor, AngleUnit unit)
    : table_(std::move(source)),
      sensor_(sensor),
      unit_(unit),
      values_(table_.source(), sensor, unit) {}

void ObservationStream::end() {
  table_.end([this](const TableRow& row) { read_row(row); });
  if (sightings_) sightings_->end();
  if (open_) complete_.push_back(*std::exchange(open_, std::nullopt));
}

std::vector<StreamedStep> ObservationStream::steps() {
  if (!sightings_) return std::exchange(complete_, {});
  std::vector<StreamedStep> steps;
  for (const StreamedLook& look : sightings_->looks()) {
    steps.push_back({look.look.key, {}});
    for (const Sighting& seen : look.sightings) {
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
      (sightings_ ? sightings_->rows().looks() : values_.looks()).remarks();
  if (table_.cut_remark() != nullptr) remarks.emplace_back(table_.cut_remark());
  return remarks;
}

void ObservationStream::read_row(const TableRow& row) {
  const bool first = !std::exchange(begun_, true);
  if (first && names_sighting_columns(row))
    sightings_.emplace(table_.source(), SightingFormat{.unit = unit_, .value = std::nullopt});
  if (sightings_) return sightings_->take(row);
  if (first && values_.begin(row)) {
    if (values_.looks().columns()[SightingColumn::kRobot])
      values_.looks().fail(row.line, "a file that is followed is of one robot");
    return;
  }
  add(values_.reading(row));
}

void ObservationStream::begin_step(const ValueRows::Reading& reading) {
  const LookRows& looks = values_.looks();
  const double step = reading.look.key;
  if (open_ && step < open_->step)
    looks.fail(reading.line, fmt::format("{} after {}: a file that is followed lists its looks in "
                                         "ascending order",
                                         looks.words(step), looks.words(open_->step)));
  if (open_ && step == open_->step) return;
  if (open_) complete_.push_back(*std::exchange(open_, std::nullopt));
  if (++steps_ > static_cast<std::size_t>(kMostSteps))
    looks.fail(reading.line, fmt::format("more than {} steps", kMostSteps));
  open_ = StreamedStep{.step = step, .values = {}};
  listed_.assign(listed_.size(), false);
}

void ObservationStream::add(const ValueRows::Reading& reading) {
  const LookRows& looks = values_.looks();
  if (reading.landmark < 0)
    looks.fail(reading.line,
               "a reading without a label (?): whose such are is estimated of whole files");
  begin_step(reading);
  const auto row = static_cast<std::size_t>(reading.landmark);
  if (row >= listed_.size()) listed_.resize(row + 1, false);
  if (listed_[row])
    looks.fail(reading.line, fmt::format("landmark {} is already listed at {}",
                                         in_quotes(names()[row]), looks.words(reading.look.key)));
  listed_[row] = true;
  if (!std::isnan(reading.value)) open_->values.emplace_back(reading.landmark, reading.value);
}

}  // namespace mapproof
