#include "core/records/observation_stream.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "core/base/errors.hpp"
#include "core/json/text_input.hpp"
#include "core/records/limits.hpp"
#include "core/records/sighting_columns.hpp"
#include "core/records/sighting_values.hpp"
#include "core/records/table_reader.hpp"

namespace mapproof {
namespace {

constexpr std::size_t kLongestLine = 1 << 20;

/// What is wrong with one line, said of its place in the file.
template <typename Read>
void at_place(const std::string& source, const std::string& place, const char* what, Read read) {
  try {
    read();
  } catch (const IoError&) {
    throw IoError(source, place, what);
  }
}

}  // namespace

ObservationStream::ObservationStream(std::string source, Sensor sensor, AngleUnit unit)
    : source_(std::move(source)), sensor_(sensor), unit_(unit), names_(source_) {}

void ObservationStream::take(std::string_view bytes) {
  while (true) {
    const std::size_t end = bytes.find('\n');
    const std::string_view part = bytes.substr(0, end);
    if (pending_.size() + part.size() > kLongestLine)
      throw IoError(source_, fmt::format("line {}", line_ + 1), "is longer than 1 MiB");
    pending_ += part;
    if (end == std::string_view::npos) return;
    read_line(std::exchange(pending_, {}));
    bytes.remove_prefix(end + 1);
  }
}

void ObservationStream::end() {
  if (!pending_.empty()) read_line(std::exchange(pending_, {}));
  if (open_) complete_.push_back(*std::exchange(open_, std::nullopt));
}

void ObservationStream::read_line(std::string_view line) {
  const std::string place = fmt::format("line {}", ++line_);
  if (trimmed(line).empty()) return;
  std::string_view text;
  at_place(source_, place, "is no UTF-8 text, or holds a NUL byte",
           [&] { text = checked_text(line, source_); });
  TableReader reader(text, source_);
  TableRow row;
  bool is_row = false;
  at_place(source_, place, "its quotes are broken, or a cell goes over its end",
           [&] { is_row = reader.next(row); });
  if (!is_row) return;
  const bool first = !std::exchange(begun_, true);
  row.line = line_;
  if (first && is_long_header(row)) return read_header(row, place);
  if (row.cells.size() != width_)
    throw IoError(source_, place,
                  fmt::format("has {} cells, expected {}", row.cells.size(), width_));
  const std::string_view step_cell = row.cells[columns_[0]];
  const std::optional<double> step = number_in(step_cell);
  if (!step || !std::isfinite(*step))
    throw IoError(source_, place, fmt::format("{}: {}", word_, number_problem(step_cell)));
  const std::string_view value_cell = row.cells[columns_[2]];
  const std::optional<double> value = sighting_value(value_cell, sensor_, unit_);
  if (!value) throw IoError(source_, place, sighting_problem(value_cell, sensor_, unit_));
  add(*step, names_.find_or_add(row.cells[columns_[1]], line_), *value, place);
}

void ObservationStream::read_header(const TableRow& row, const std::string& place) {
  const SightingColumns columns = sighting_columns(row, source_);
  if (!columns[SightingColumn::kValue]) throw IoError(source_, place, "no column is named value");
  if (columns[SightingColumn::kRobot])
    throw IoError(source_, place, "a file that is followed is of one robot");
  const bool of_steps = columns[SightingColumn::kStep].has_value();
  word_ = of_steps ? "step" : "time";
  columns_[0] = *columns[of_steps ? SightingColumn::kStep : SightingColumn::kTime];
  columns_[1] = *columns[SightingColumn::kLandmark];
  columns_[2] = *columns[SightingColumn::kValue];
  width_ = columns.width;
}

void ObservationStream::add(double step, Eigen::Index landmark, double value,
                            const std::string& place) {
  if (open_ && step < open_->step)
    throw IoError(source_, place,
                  fmt::format("{0} {1:.15g} after {0} {2:.15g}: a file that is followed lists its "
                              "looks in ascending order",
                              word_, step, open_->step));
  if (open_ && step > open_->step) complete_.push_back(*std::exchange(open_, std::nullopt));
  if (!open_) {
    if (++steps_ > static_cast<std::size_t>(kMostSteps))
      throw IoError(source_, place, fmt::format("more than {} steps", kMostSteps));
    open_ = StreamedStep{.step = step, .values = {}};
    listed_.assign(listed_.size(), false);
  }
  const auto row = static_cast<std::size_t>(landmark);
  if (row >= listed_.size()) listed_.resize(row + 1, false);
  if (listed_[row])
    throw IoError(source_, place,
                  fmt::format("landmark {} is already listed at {} {:.15g}",
                              in_quotes(names_.names()[row]), word_, step));
  listed_[row] = true;
  if (!std::isnan(value)) open_->values.emplace_back(landmark, value);
}

}  // namespace mapproof
