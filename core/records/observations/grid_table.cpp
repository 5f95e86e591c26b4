#include "core/records/observations/grid_table.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "core/base/errors.hpp"
#include "core/base/not_finite.hpp"
#include "core/json/text_input.hpp"
#include "core/records/limits.hpp"
#include "core/records/observations/name_list.hpp"
#include "core/records/tables/cells.hpp"
#include "core/records/tables/packed_table.hpp"
#include "core/records/tables/table_shape.hpp"
#include "core/records/tables/table_stream.hpp"

namespace mapproof {
namespace {

/// The lines of the rows: mostly each is the one after the last.
class RowLines {
 public:
  void add(std::size_t line) {
    if (runs_.empty() || line != runs_.back().line + (rows_ - runs_.back().row))
      runs_.push_back({rows_, line});
    ++rows_;
  }

  std::size_t operator[](std::size_t row) const {
    const auto after = std::ranges::upper_bound(runs_, row, {}, &Run::row);
    const Run& run = *std::prev(after);
    return run.line + (row - run.row);
  }

 private:
  struct Run {
    std::size_t row, line;
  };
  std::vector<Run> runs_;
  std::size_t rows_ = 0;
};

/// The first cell of some that is not a value.
struct BadCell {
  std::size_t row = 0;
  std::size_t column = 0;
  std::string text;
};

/// A table row by row. Before the last one it is not known how it lies: which cells are names, and
/// what is wrong with it, is found out then.
class GridTable {
 public:
  GridTable(const std::string& source, Sensor sensor, const TableFormat& format)
      : source_(source),
        sensor_(sensor),
        format_(format),
        form_{.unit = format.unit, .is_clockwise = is_clockwise(format.convention)} {}

  void add(const TableRow& row);
  void add(const NumberRow& row);

  bool is_begun() const { return shapes_.has_value(); }

  /// Whether the table is too large, however it lies.
  bool is_too_large() const {
    return rows_ > 0 && exceeds(rows_, least_values()) && exceeds(least_values(), rows_);
  }

  /// All but what only its reader knows.
  PackedSource result() &&;

  TableShape shape() const { return shapes_->shape(); }

 private:
  static bool exceeds(std::size_t landmarks, std::size_t steps) {
    return landmarks > static_cast<std::size_t>(kMostLandmarks) ||
           steps > static_cast<std::size_t>(kMostSteps) ||
           static_cast<double>(landmarks) * static_cast<double>(steps) > kMostEntries;
  }

  /// Refuses a table that is far higher than wide, whose rows are probably steps, unless the user
  /// says that they are landmarks.
  void require_wide(std::size_t landmarks, std::size_t steps, const std::string& location) const {
    constexpr std::size_t kMany = 5000, kTimesHigher = 10;
    if (format_.layout != Layout::kWide && landmarks > kMany && landmarks > kTimesHigher * steps)
      throw IoError(source_, location,
                    fmt::format("more than {} landmarks: each row is a landmark and each column a "
                                "step; if rows are steps, pass --layout transposed, else --layout "
                                "wide",
                                kMany));
  }

  std::size_t least_values() const { return std::max<std::size_t>(shapes_->columns(), 1) - 1; }
  bool take_width(std::size_t cells, std::size_t line);
  void take_values(const std::vector<double>& values);
  void take_bad(std::size_t column, std::string text);
  std::string label(std::size_t row) const;
  std::string location(std::size_t row) const { return fmt::format("line {}", lines_[row]); }

  void check_rows(const TableShape& shape, NameList& names) const;
  void throw_bad(const BadCell& bad, const TableShape& shape) const;
  const BadCell* first_bad(const TableShape& shape) const;

  const std::string& source_;
  Sensor sensor_;
  TableFormat format_;
  ValueForm form_;
  std::optional<TableShapes> shapes_;
  std::size_t header_line_ = 0;
  std::optional<PackedTable> table_;
  std::vector<double> values_;  ///< Of one row.
  RowLines lines_;
  std::string labels_;                     ///< The rows' first cells, each with a NUL behind it,
  std::vector<std::size_t> label_starts_;  ///< and where each thousandth starts.
  std::size_t rows_ = 0;                   ///< Without the header.
  double missing_ = 0.0;
  double missing_first_ = 0.0;                       ///< Of those in the first column.
  std::optional<BadCell> bad_first_;                 ///< In the first column,
  std::vector<std::optional<BadCell>> bad_columns_;  ///< by column if any is named, else in all.
  std::optional<std::pair<std::size_t, std::size_t>> bad_width_;  ///< Row and its cells.
};

constexpr std::size_t kLabelsTogether = 1024;

/// The first row decides where columns begin; a header's rows begin after it.
void GridTable::add(const TableRow& row) {
  if (!shapes_) {
    shapes_.emplace(row, source_, format_);
    if (shapes_->has_header()) {
      header_line_ = row.line;
      return;
    }
  } else {
    shapes_->add(row.cells.front(), row.cells.size());
  }
  if (!take_width(row.cells.size(), row.line)) return;
  values_.resize(row.cells.size());
  for (std::size_t i = 0; i < row.cells.size(); ++i) {
    const std::string_view cell = row.cells[i];
    const std::optional<double> number = is_missing(cell) ? kNaN : number_in(cell);
    values_[i] = number.value_or(kNaN);
    if (!number) take_bad(i, std::string(cell));
  }
  labels_.append(row.cells.front()).push_back('\0');
  take_values(values_);
}

void GridTable::add(const NumberRow& row) {
  if (row.starts_as_text || std::isnan(row.values.front()))
    shapes_->add(row.first, row.values.size());
  else
    shapes_->add(row.values.front(), row.values.size());
  if (!take_width(row.values.size(), row.line)) return;
  if (row.starts_as_text) take_bad(0, std::string(row.first));
  labels_.append(row.first).push_back('\0');
  take_values(row.values);
}

/// Whether the row is as wide as the others; the first one that is not ends what is kept.
bool GridTable::take_width(std::size_t cells, std::size_t line) {
  if (!table_) table_.emplace(shapes_->columns());
  if (rows_ % kLabelsTogether == 0) label_starts_.push_back(labels_.size());
  lines_.add(line);
  ++rows_;
  if (cells != shapes_->columns() && !bad_width_) bad_width_ = {rows_ - 1, cells};
  return !bad_width_;
}

void GridTable::take_bad(std::size_t column, std::string text) {
  std::optional<BadCell>* bad = &bad_first_;
  if (column > 0) {
    const std::size_t which = format_.columns.empty() ? 0 : column - 1;
    if (bad_columns_.size() <= which) bad_columns_.resize(which + 1);
    bad = &bad_columns_[which];
  }
  if (!*bad) *bad = {rows_ - 1, column, std::move(text)};
}

void GridTable::take_values(const std::vector<double>& values) {
  std::size_t missing = 0;
  for (std::size_t i = 0; i < values.size(); ++i) {
    const bool is_number = values[i] == values[i];
    missing += is_number ? 0 : 1;
    if (is_number && !detection_of(values[i], sensor_, form_)) [[unlikely]]
      take_bad(i, fmt::format("{}", values[i]));
  }
  missing_ += static_cast<double>(missing);
  if (std::isnan(values.front())) ++missing_first_;
  table_->add_row(values);
}

std::string GridTable::label(std::size_t row) const {
  std::size_t at = label_starts_[row / kLabelsTogether];
  for (std::size_t k = 0; k < row % kLabelsTogether; ++k) at = labels_.find('\0', at) + 1;
  return labels_.c_str() + at;
}

const BadCell* GridTable::first_bad(const TableShape& shape) const {
  const BadCell* first = nullptr;
  const auto take = [&](const std::optional<BadCell>& bad) {
    if (!bad || bad->column == shape.label_column) return;
    if (first == nullptr || std::pair(bad->row, bad->column) < std::pair(first->row, first->column))
      first = &*bad;
  };
  take(bad_first_);
  for (const std::optional<BadCell>& bad : bad_columns_) take(bad);
  return first;
}

void GridTable::throw_bad(const BadCell& bad, const TableShape& shape) const {
  const bool names_landmarks = shape.is_transposed && shape.has_header &&
                               std::ranges::any_of(shapes_->first(), [](const std::string& cell) {
                                 return column_heading(cell, 0, {}).role == ColumnRole::kLandmark;
                               });
  // Of a list of detections whose measurements have other names.
  const char* remedy = names_landmarks
                           ? "; if each row is a detection, --columns ROLE=HEADER names range, "
                             "bearing, value, or x and y"
                           : "";
  throw IoError(source_, fmt::format("{}, column {}", location(bad.row), bad.column + 1),
                detection_problem(bad.text, sensor_, form_) + remedy);
}

/// The names of the landmarks; throws for what is wrong with the table, the first row first.
void GridTable::check_rows(const TableShape& shape, NameList& names) const {
  const BadCell* const bad = first_bad(shape);
  const std::size_t values = shapes_->columns() - (shape.label_column ? 1 : 0);
  if (shape.is_transposed) {
    const std::size_t line = shape.has_header ? header_line_ : lines_[0];
    for (std::size_t i = 0; i < shapes_->columns(); ++i)
      if (i != shape.label_column)
        names.add(shape.has_header ? std::string_view(shapes_->first()[i])
                                   : std::string_view(fmt::format("L{}", names.names().size() + 1)),
                  line);
  }
  const auto checked = [&](std::size_t row) {
    if (bad_width_ && bad_width_->first == row)
      throw IoError(source_, location(row),
                    fmt::format("has {} cells where line {} has {}", bad_width_->second,
                                shape.has_header ? header_line_ : lines_[0], shapes_->columns()));
    if (values == 0)
      throw IoError(source_, location(row),
                    "a single cell: cells stand between commas, semicolons, tabs or blanks");
    if (!shape.is_transposed)
      names.add(shape.label_column ? label(row) : fmt::format("L{}", row + 1), lines_[row]);
    if (!shape.is_transposed) require_wide(row + 1, values, location(row));
    shape.is_transposed ? check_size(source_, location(row), values, row + 1)
                        : check_size(source_, location(row), row + 1, values);
    if (bad != nullptr && bad->row == row) throw_bad(*bad, shape);
  };
  if (!shape.is_transposed) {
    for (std::size_t row = 0; row < rows_; ++row) checked(row);
    return;
  }
  // Of steps, which may be many, those alone where something may be wrong.
  std::vector<std::size_t> suspects = {0, rows_ - 1, static_cast<std::size_t>(kMostSteps)};
  if (values > 0)
    suspects.push_back(
        static_cast<std::size_t>(std::floor(kMostEntries / static_cast<double>(values))));
  if (bad != nullptr) suspects.push_back(bad->row);
  if (bad_width_) suspects.push_back(bad_width_->first);
  std::ranges::sort(suspects);
  for (const std::size_t row : suspects)
    if (row < rows_) checked(row);
}

/// Missing entries of a column of the table; 0 if there is none.
double missing_in(const PackedHistory& history, std::optional<std::size_t> column) {
  if (!column) return 0.0;
  std::vector<double> values(history.table->rows());
  history.table->read({0, values.size(), 1}, {*column, 1, 1}, values.data(), 1, 1);
  return static_cast<double>(
      std::ranges::count_if(values, [](double value) { return std::isnan(value); }));
}

PackedSource GridTable::result() && {
  const TableShape shape = shapes_->shape();
  if (!shape.doubt.empty()) throw IoError(source_, shape.doubt);
  if (rows_ == 0)
    throw IoError(source_, shape.has_header ? "holds a header and no rows" : "holds no rows");
  NameList names(source_);
  check_rows(shape, names);
  table_->end();
  PackedSource result;
  result.path = source_;
  result.locations = names.locations();
  PackedHistory& history = result.history;
  history.sensor = sensor_;
  history.names = std::move(names).take();
  const std::size_t values = table_->columns() - (shape.label_column ? 1 : 0);
  history.steps = static_cast<Eigen::Index>(shape.is_transposed ? rows_ : values);
  history.form = form_;
  history.is_transposed = shape.is_transposed;
  history.label_column = shape.label_column;
  history.table = std::make_shared<const PackedTable>(std::move(*table_));
  if (shape.label_column == 0U)
    history.missing = missing_ - missing_first_;
  else
    history.missing = missing_ - missing_in(history, shape.label_column);
  return result;
}

TableReading reading_of(const TableStream& stream, const TableFormat& format,
                        const TableShape& shape) {
  return {.form = shape.is_transposed ? "transposed table" : "wide table",
          .columns = {},
          .separator = stream.separator(),
          .has_decimal_commas = stream.has_decimal_commas(),
          .packing = stream.packing(),
          .times = shape.has_dates ? "dates" : "",
          .unit = format.unit,
          .convention = format.convention};
}

/// Number (landmark, step) of a table to a history's value, in place.
void understand(Eigen::MatrixXd& values, Sensor sensor, const ValueForm& form) {
  if (sensor != Sensor::kBearing || (form.unit == AngleUnit::kRadians && !form.is_clockwise))
    return;
  values = values.unaryExpr([&](double number) {
    return std::isnan(number) ? kNaN : detection_of(number, sensor, form).value_or(kNaN);
  });
}

}  // namespace

PackedSource read_grid(ByteSource& source, Sensor sensor, const TableFormat& format) {
  TableStream stream(source, ByteSource::kLargest);
  GridTable table(source.name(), sensor, format);
  NumberRow numbers;
  TableRow row;
  while (!table.is_begun() || !table.is_too_large()) {
    if (table.is_begun() && stream.next_numbers(numbers))
      table.add(numbers);
    else if (stream.next(row))
      table.add(row);
    else
      break;
  }
  if (!table.is_begun()) throw IoError(source.name(), "holds no rows");
  const TableReading reading = reading_of(stream, format, table.shape());
  PackedSource result = std::move(table).result();
  result.reading = reading;
  if (stream.is_cut()) result.remarks.emplace_back(kCutRemark);
  if (sensor == Sensor::kRange) remark_on_angles(result.history.blocks(), result.remarks);
  return result;
}

HistoryBlocks PackedHistory::blocks() const {
  const auto read = [this](const HistoryBlocks::Part& part) {
    Eigen::MatrixXd values(part.rows, part.count);
    const auto size = [](Eigen::Index index) { return static_cast<std::size_t>(index); };
    const PackedTable::Range steps_of{size(part.first), size(part.count), size(part.stride)};
    const std::size_t first = size(part.first_row), rows = size(part.rows);
    if (is_transposed) {
      // Landmarks before and behind the column that holds none of them.
      const std::size_t label = label_column.value_or(size(landmarks()));
      const std::size_t before = label > first ? std::min(label - first, rows) : 0;
      if (before > 0) table->read(steps_of, {first, before, 1}, values.data(), rows, 1);
      if (before < rows)
        table->read(steps_of, {first + before + 1, rows - before, 1}, values.data() + before, rows,
                    1);
    } else {
      const std::size_t skipped = label_column ? 1 : 0;
      table->read({first, rows, 1}, {steps_of.first + skipped, steps_of.count, steps_of.stride},
                  values.data(), 1, rows);
    }
    understand(values, sensor, form);
    return values;
  };
  return {sensor, names, steps, read, missing == 0.0};
}

}  // namespace mapproof
