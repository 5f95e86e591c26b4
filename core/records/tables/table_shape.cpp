#include "core/records/tables/table_shape.hpp"

#include <algorithm>
#include <span>
#include <vector>

#include <fmt/format.h>

#include "core/base/text/words.hpp"
#include "core/json/text_input.hpp"
#include "core/records/observations/name_list.hpp"
#include "core/records/tables/column_names.hpp"
#include "core/records/tables/time_text.hpp"

namespace mapproof {
namespace {

using Texts = std::span<const std::string>;

/// A first column that ascends over so many rows holds times, not values.
constexpr std::size_t kAscendingRows = 8;

bool is_text_cell(std::string_view cell) {
  return !is_missing(cell) && !number_in(cell) && !date_in(cell);
}

/// 0, 1, 2, ... or other numbers or dates, each above the one before: steps, not values.
bool are_steps(Texts cells) {
  double last = 0.0;
  for (std::size_t i = 0; i < cells.size(); ++i) {
    const std::optional<double> time = time_in(cells[i]);
    if (!time || (i > 0 && *time <= last)) return false;
    last = *time;
  }
  // 0, 1 alone may be visibilities.
  return cells.size() > 2 || (cells.size() == 2 && last > 1.0);
}

/// "t0", "step 3", "first": labels of steps, not names of landmarks.
bool labels_step(std::string_view cell) {
  std::string word = lower_case(trimmed(cell));
  const std::size_t digits = word.find_last_not_of("0123456789");
  const bool is_numbered = digits + 1 < word.size();
  word = std::string(trimmed(std::string_view(word).substr(0, digits + 1), " _-#.=[]()"));
  return is_numbered && (word == "s" || word == "k" || names_steps(word));
}

bool names_index(std::string_view cell) {
  const std::string word = lower_case(cell);
  return is_missing(cell) || word == "index" || word.starts_with("unnamed");
}

bool is_first_row_header(Texts row, const TableFormat& format) {
  const Texts others = row.subspan(1);
  if (is_word_for_names(row.front()) || others.empty()) return is_word_for_names(row.front());
  if (is_text_cell(row.front()) && names_steps(row.front(), format.columns)) return true;
  if (names_index(row.front()) && are_steps(others)) return true;
  return std::ranges::none_of(others,
                              [](const auto& cell) { return number_in(cell).has_value(); }) &&
         std::ranges::any_of(others, [](const auto& cell) { return !is_missing(cell); });
}

}  // namespace

void TableShapes::Labels::add(std::string_view cell) {
  if (const std::optional<double> number = number_in(cell)) return add(*number);
  ascends = false;
  if (date_in(cell))
    ++dates;
  else if (!is_missing(cell))
    ++texts;
  ++rows;
}

void TableShapes::Labels::add(double number) {
  ascends = ascends && (rows == 0 || number > last);
  last = number;
  ++rows;
}

bool TableShapes::Labels::are_times() const {
  return are_dates() || (ascends && rows >= kAscendingRows);
}

TableShapes::TableShapes(const TableRow& first, const std::string& source,
                         const TableFormat& stated)
    : format_(stated), first_(first.cells.begin(), first.cells.end()), columns_(first_.size()) {
  require_columns(first.cells, stated.columns, source);
  format_.columns = columns_in(first.cells, stated.columns);
  has_header_ = is_first_row_header(first_, format_);
  if (has_header_) return;
  labels_.add(first_.front());
  drop_first();
}

void TableShapes::drop_first() {
  first_.resize(1);
  first_.shrink_to_fit();
}

void TableShapes::take_second(std::size_t cells) {
  is_second_ = false;
  if (!has_header_ || cells != columns_ + 1) return;
  is_header_short_ = true;
  first_.insert(first_.begin(), "");
  ++columns_;
}

void TableShapes::add(std::string_view label, std::size_t cells) {
  if (is_second_) take_second(cells);
  labels_.add(label);
  // Rows that have names are landmarks: what the header calls the steps is not read.
  if (labels_.are_names() && format_.layout != Layout::kTransposed && first_.size() > 1)
    drop_first();
}

void TableShapes::add(double label, std::size_t cells) {
  if (is_second_) take_second(cells);
  labels_.add(label);
}

std::size_t TableShapes::value_columns() const {
  const bool may_be_labels = has_header_ || labels_.are_names() || labels_.are_dates();
  return columns_ - (may_be_labels && columns_ > 0 ? 1 : 0);
}

std::string TableShapes::doubt_of(std::string_view why) const {
  return fmt::format(
      "{} rows x {} columns, {}: it seems transposed, with more landmarks than time steps; state "
      "--layout transposed if each row is a time step, or --layout wide if each row is a "
      "landmark{}",
      labels_.rows, value_columns(), why,
      value_columns() == 2 ? "; or --columns time=1,landmark=2 if each row is a detection" : "");
}

void TableShapes::recognise_with_header(TableShape& shape) const {
  if (labels_.are_names()) return;
  const std::string& corner = first_.front();
  const Texts others = Texts(first_).subspan(1);
  const bool is_tall = labels_.rows > value_columns();
  const bool has_steps = are_steps(others) || std::ranges::all_of(others, labels_step);
  if (is_word_for_names(corner)) {
    if (is_tall && labels_.ascends && labels_.rows >= kAscendingRows)
      shape.doubt = doubt_of("whose names are numbers that ascend");
  } else if (names_steps(corner, format_.columns) || labels_.are_dates()) {
    shape.is_transposed = true;
  } else if (has_steps) {
    if (is_tall && labels_.rows >= kAscendingRows) shape.doubt = doubt_of("and neither has names");
  } else {
    // The header names landmarks. Without an index its first cell is one of them.
    shape.is_transposed = !names_index(corner) || labels_.ascends;
  }
}

void TableShapes::recognise_layout(TableShape& shape) const {
  if (format_.layout == Layout::kTransposed) {
    shape.is_transposed = true;
  } else if (format_.layout != Layout::kWide) {
    if (has_header_)
      recognise_with_header(shape);
    else if (labels_.are_dates())
      shape.is_transposed = true;
    else if (!labels_.are_names() && labels_.rows > value_columns())
      shape.doubt = doubt_of("without names");
  }
}

/// Which column holds names or times.
std::optional<std::size_t> TableShapes::label_column(const TableShape& shape) const {
  const std::string& corner = first_.front();
  if (!shape.is_transposed) {
    const bool has_names =
        labels_.are_names() || (has_header_ && (is_word_for_names(corner) || names_index(corner)));
    return has_names ? std::optional<std::size_t>(0) : std::nullopt;
  }
  if (has_header_)
    for (std::size_t i = 0; i < first_.size(); ++i) {
      const bool is_asked = !format_.columns.empty() &&
                            column_heading(first_[i], i, format_.columns).role.has_value() &&
                            !column_heading(first_[i], i, {}).role;
      if (is_asked) return i;
    }
  const bool is_named = has_header_ && is_text_cell(corner) && names_steps(corner, format_.columns);
  const bool is_index = has_header_ && names_index(corner);
  return is_named || is_index || labels_.are_times() ? std::optional<std::size_t>(0) : std::nullopt;
}

TableShape TableShapes::shape() const {
  TableShape shape;
  shape.has_header = has_header_;
  shape.is_header_short = is_header_short_;
  recognise_layout(shape);
  shape.label_column = label_column(shape);
  shape.has_dates = shape.is_transposed && shape.label_column && labels_.are_dates();
  return shape;
}

}  // namespace mapproof
