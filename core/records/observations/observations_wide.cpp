#include <algorithm>
#include <span>

#include <fmt/format.h>

#include "core/base/errors.hpp"
#include "core/json/text_input.hpp"
#include "core/records/observations/detection_values.hpp"
#include "core/records/observations/name_list.hpp"
#include "core/records/observations/observation_values.hpp"
#include "core/records/observations/table_reader.hpp"

namespace mapproof {
namespace {

using Cells = std::span<const std::string_view>;

bool is_text(std::string_view cell) { return !is_missing(cell) && !number_in(cell); }

/// 0, 1, 2, ... or 1, 2, 3, ...: step numbers, at least to 2 so that they are not visibilities.
bool counts_steps(Cells cells) {
  const std::optional<double> first = cells.empty() ? std::nullopt : number_in(cells.front());
  if (!first || (*first != 0.0 && *first != 1.0)) return false;
  if (*first + static_cast<double>(cells.size()) < 3.0) return false;
  for (std::size_t i = 0; i < cells.size(); ++i)
    if (number_in(cells[i]) != *first + static_cast<double>(i)) return false;
  return true;
}

bool is_header(const TableRow& row) {
  const Cells steps = Cells(row.cells).subspan(1);
  if (is_word_for_names(row.cells.front())) return true;
  if (steps.empty()) return false;
  const auto numbers = std::ranges::count_if(
      steps, [](std::string_view cell) { return !is_missing(cell) && !is_text(cell); });
  if (numbers == 0) return std::ranges::any_of(steps, is_text);
  return is_missing(row.cells.front()) && counts_steps(steps);
}

/// Reads the rows one by one into a row-major array.
class WideTable {
 public:
  WideTable(const std::string& source, Sensor sensor, AngleUnit unit)
      : source_(source), sensor_(sensor), unit_(unit), names_(source) {}

  void add_header(const TableRow& row) {
    set_width(row);
    has_header_ = true;
    has_names_ = is_word_for_names(row.cells.front()) || row.cells.front().empty();
  }

  void add(const TableRow& row) {
    if (names_.names().empty()) {
      if (width_ == 0) set_width(row);
      has_names_ = has_names_ || is_text(row.cells.front());
    }
    const std::string place = fmt::format("line {}", row.line);
    if (row.cells.size() != width_)
      throw IoError(
          source_, place,
          fmt::format("has {} cells where line {} has {}", row.cells.size(), first_line_, width_));
    Cells cells = row.cells;
    if (has_names_) {
      names_.add(cells.front(), row.line);
      cells = cells.subspan(1);
    } else {
      names_.add(fmt::format("L{}", names_.names().size() + 1), row.line);
    }
    if (cells.empty())
      throw IoError(source_, place,
                    "a single cell: cells stand between commas, semicolons or tabs");
    check_size(source_, place, names_.names().size(), cells.size());
    add_values(cells, place);
  }

  ObservationSource result() && {
    if (names_.names().empty())
      throw IoError(source_, has_header_ ? "holds a header and no rows" : "holds no rows");
    const auto landmarks = static_cast<Eigen::Index>(names_.names().size());
    const auto steps = static_cast<Eigen::Index>(values_.size()) / landmarks;
    using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
    return {.history = {.sensor = sensor_,
                        .names = names_.names(),
                        .values = Eigen::Map<const RowMajor>(values_.data(), landmarks, steps)},
            .truth_m = std::nullopt,
            .remarks = {},
            .places = names_.places(),
            .path = source_};
  }

 private:
  void set_width(const TableRow& row) {
    width_ = row.cells.size();
    first_line_ = row.line;
  }

  void add_values(Cells cells, const std::string& place) {
    for (std::size_t i = 0; i < cells.size(); ++i) {
      const std::optional<double> value = detection_value(cells[i], sensor_, unit_);
      if (!value)
        throw IoError(source_, fmt::format("{}, column {}", place, i + (has_names_ ? 2 : 1)),
                      detection_problem(cells[i], sensor_, unit_));
      values_.push_back(*value);
    }
  }

  const std::string& source_;
  Sensor sensor_;
  AngleUnit unit_;
  NameList names_;
  std::vector<double> values_;
  std::size_t width_ = 0;
  std::size_t first_line_ = 0;
  bool has_header_ = false;
  bool has_names_ = false;
};

}  // namespace

ObservationSource read_wide(std::string_view text, const std::string& source, Sensor sensor,
                            AngleUnit unit) {
  TableReader reader(text, source);
  WideTable table(source, sensor, unit);
  TableRow row;
  bool is_first = true;
  while (reader.next(row)) {
    if (is_first && is_header(row))
      table.add_header(row);
    else
      table.add(row);
    is_first = false;
  }
  return std::move(table).result();
}

}  // namespace mapproof
