#include "core/records/observation_stream.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "core/base/errors.hpp"
#include "core/json/text_input.hpp"
#include "core/records/limits.hpp"
#include "core/records/sighting_columns.hpp"
#include "core/records/sighting_values.hpp"

namespace mapproof {

ObservationStream::ObservationStream(std::string source, Sensor sensor, AngleUnit unit)
    : table_(std::move(source)), sensor_(sensor), unit_(unit), names_(table_.source()) {}

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
      sightings_ ? sightings_->rows().remarks() : std::vector<std::string>{};
  if (table_.is_cut()) remarks.emplace_back(kCutRemark);
  return remarks;
}

void ObservationStream::read_row(const TableRow& row) {
  const std::string& source = table_.source();
  const std::string place = fmt::format("line {}", row.line);
  const bool first = !std::exchange(begun_, true);
  if (first && names_sighting_columns(row))
    sightings_.emplace(source, SightingFormat{.unit = unit_, .value = std::nullopt});
  if (sightings_) return sightings_->take(row);
  if (first && is_long_header(row)) return read_header(row, place);
  if (row.cells.size() != width_)
    throw IoError(source, place,
                  fmt::format("has {} cells, expected {}", row.cells.size(), width_));
  const std::string_view step_cell = row.cells[columns_[0]];
  const std::optional<double> step = number_in(step_cell);
  if (!step || !std::isfinite(*step))
    throw IoError(source, place, fmt::format("{}: {}", word_, number_problem(step_cell)));
  const std::string_view value_cell = row.cells[columns_[2]];
  const std::optional<double> value = sighting_value(value_cell, sensor_, unit_);
  if (!value) throw IoError(source, place, sighting_problem(value_cell, sensor_, unit_));
  add(*step, names_.find_or_add(row.cells[columns_[1]], row.line), *value, place);
}

void ObservationStream::read_header(const TableRow& row, const std::string& place) {
  const std::string& source = table_.source();
  const SightingColumns columns = sighting_columns(row, source);
  if (!columns[SightingColumn::kValue]) throw IoError(source, place, "no column is named value");
  if (columns[SightingColumn::kRobot])
    throw IoError(source, place, "a file that is followed is of one robot");
  const bool of_steps = columns[SightingColumn::kStep].has_value();
  word_ = of_steps ? "step" : "time";
  columns_[0] = *columns[of_steps ? SightingColumn::kStep : SightingColumn::kTime];
  columns_[1] = *columns[SightingColumn::kLandmark];
  columns_[2] = *columns[SightingColumn::kValue];
  width_ = columns.width;
}

void ObservationStream::add(double step, Eigen::Index landmark, double value,
                            const std::string& place) {
  const std::string& source = table_.source();
  if (open_ && step < open_->step)
    throw IoError(source, place,
                  fmt::format("{0} {1:.15g} after {0} {2:.15g}: a file that is followed lists its "
                              "looks in ascending order",
                              word_, step, open_->step));
  if (open_ && step > open_->step) complete_.push_back(*std::exchange(open_, std::nullopt));
  if (!open_) {
    if (++steps_ > static_cast<std::size_t>(kMostSteps))
      throw IoError(source, place, fmt::format("more than {} steps", kMostSteps));
    open_ = StreamedStep{.step = step, .values = {}};
    listed_.assign(listed_.size(), false);
  }
  const auto row = static_cast<std::size_t>(landmark);
  if (row >= listed_.size()) listed_.resize(row + 1, false);
  if (listed_[row])
    throw IoError(source, place,
                  fmt::format("landmark {} is already listed at {} {:.15g}",
                              in_quotes(names_.names()[row]), word_, step));
  listed_[row] = true;
  if (!std::isnan(value)) open_->values.emplace_back(landmark, value);
}

}  // namespace mapproof
