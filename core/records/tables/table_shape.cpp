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

/// The content of the cells of a first column, below the header.
struct LabelCells {
  std::size_t rows = 0;
  std::size_t texts = 0;
  std::size_t dates = 0;
  bool ascends = true;  ///< All are numbers, each above the one before.
  double last = 0.0;

  void add(std::string_view cell) {
    const std::optional<double> number = number_in(cell);
    if (!number) {
      ascends = false;
      if (date_in(cell))
        ++dates;
      else if (!is_missing(cell))
        ++texts;
    } else {
      ascends = ascends && (rows == 0 || *number > last);
      last = *number;
    }
    ++rows;
  }

  bool are_names() const { return texts > 0; }
  bool are_dates() const { return texts == 0 && dates > 0; }
  bool are_times() const { return are_dates() || (ascends && rows >= kAscendingRows); }
};

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

/// What is known of a table before its layout is.
struct TableFacts {
  std::vector<std::string> first;  ///< Row, with an empty cell in front if the header is short.
  LabelCells labels = {};
  std::size_t columns = 0;  ///< Without names or times.
};

std::string doubt_of(const TableFacts& facts, std::string_view why) {
  return fmt::format(
      "{} rows x {} columns, {}: it seems transposed, with more landmarks than time steps; state "
      "--layout transposed if each row is a time step, or --layout wide if each row is a "
      "landmark{}",
      facts.labels.rows, facts.columns, why,
      facts.columns == 2 ? "; or --columns time=1,landmark=2 if each row is a detection" : "");
}

void recognise_with_header(const TableFacts& facts, const TableFormat& format, TableShape& shape) {
  const std::string& corner = facts.first.front();
  const Texts others = Texts(facts.first).subspan(1);
  const LabelCells& labels = facts.labels;
  const bool is_tall = labels.rows > facts.columns;
  const bool has_steps = are_steps(others) || std::ranges::all_of(others, labels_step);
  if (labels.are_names()) return;
  if (is_word_for_names(corner)) {
    if (is_tall && labels.ascends && labels.rows >= kAscendingRows)
      shape.doubt = doubt_of(facts, "whose names are numbers that ascend");
  } else if (names_steps(corner, format.columns) || labels.are_dates()) {
    shape.is_transposed = true;
  } else if (has_steps) {
    if (is_tall && labels.rows >= kAscendingRows)
      shape.doubt = doubt_of(facts, "and neither has names");
  } else {
    // The header names landmarks. Without an index its first cell is one of them.
    shape.is_transposed = !names_index(corner) || labels.ascends;
  }
}

void recognise_layout(const TableFacts& facts, const TableFormat& format, TableShape& shape) {
  if (format.layout == Layout::kTransposed) {
    shape.is_transposed = true;
  } else if (format.layout != Layout::kWide) {
    if (shape.has_header)
      recognise_with_header(facts, format, shape);
    else if (facts.labels.are_dates())
      shape.is_transposed = true;
    else if (!facts.labels.are_names() && facts.labels.rows > facts.columns)
      shape.doubt = doubt_of(facts, "without names");
  }
}

/// Which column holds names or times.
std::optional<std::size_t> label_column(const TableFacts& facts, const TableFormat& format,
                                        const TableShape& shape) {
  const std::string& corner = facts.first.front();
  const LabelCells& labels = facts.labels;
  if (!shape.is_transposed) {
    const bool has_names = labels.are_names() ||
                           (shape.has_header && (is_word_for_names(corner) || names_index(corner)));
    return has_names ? std::optional<std::size_t>(0) : std::nullopt;
  }
  if (shape.has_header)
    for (std::size_t i = 0; i < facts.first.size(); ++i) {
      const bool is_asked = !format.columns.empty() &&
                            column_heading(facts.first[i], i, format.columns).role.has_value() &&
                            !column_heading(facts.first[i], i, {}).role;
      if (is_asked) return i;
    }
  const bool is_named =
      shape.has_header && is_text_cell(corner) && names_steps(corner, format.columns);
  const bool is_index = shape.has_header && names_index(corner);
  return is_named || is_index || labels.are_times() ? std::optional<std::size_t>(0) : std::nullopt;
}

}  // namespace

TableShape table_shape(std::string_view text, const std::string& source,
                       const TableFormat& stated) {
  TableReader reader(text, source);
  TableRow row;
  TableShape shape;
  if (!reader.next(row)) return shape;
  require_columns(row.cells, stated.columns, source);
  TableFormat format = stated;
  format.columns = columns_in(row.cells, stated.columns);
  TableFacts facts{.first = {row.cells.begin(), row.cells.end()}};
  shape.has_header = is_first_row_header(facts.first, format);
  if (!shape.has_header) facts.labels.add(row.cells.front());
  for (bool is_second = true; reader.next(row); is_second = false) {
    if (is_second && shape.has_header && row.cells.size() == facts.first.size() + 1) {
      shape.is_header_short = true;
      facts.first.insert(facts.first.begin(), "");
    }
    facts.labels.add(row.cells.front());
  }
  facts.columns = facts.first.size();
  const bool may_be_labels =
      shape.has_header || facts.labels.are_names() || facts.labels.are_dates();
  if (may_be_labels && facts.columns > 0) --facts.columns;
  recognise_layout(facts, format, shape);
  shape.label_column = label_column(facts, format, shape);
  shape.has_dates = shape.is_transposed && shape.label_column && facts.labels.are_dates();
  return shape;
}

}  // namespace mapproof
