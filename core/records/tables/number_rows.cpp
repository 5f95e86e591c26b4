#include "core/records/tables/number_rows.hpp"

#include <cmath>
#include <optional>

#include <fmt/format.h>

#include "core/base/errors.hpp"
#include "core/json/text_input.hpp"

namespace mapproof {

NumberRows::NumberRows(std::string_view text, const std::string& source, std::size_t width)
    : source_(source), reader_(text, source, TableReader::kBlanks), values_(width) {}

bool NumberRows::next() {
  if (!reader_.next(row_)) return false;
  if (row_.cells.size() != values_.size())
    fail(fmt::format("has {} numbers, expected {}", row_.cells.size(), values_.size()));
  for (std::size_t i = 0; i < values_.size(); ++i) {
    const std::optional<double> value = number_in(row_.cells[i]);
    if (!value || !std::isfinite(*value)) fail(number_problem(row_.cells[i]));
    values_[i] = *value;
  }
  return true;
}

void NumberRows::fail(const std::string& what) const {
  throw IoError(source_, fmt::format("line {}", row_.line), what);
}

int NumberRows::id(std::size_t i) const {
  if (!(values_[i] >= 0.0 && values_[i] <= 1e9 && values_[i] == std::trunc(values_[i])))
    fail("expected a number without decimals, got " + in_quotes(row_.cells[i]));
  return static_cast<int>(values_[i]);
}

}  // namespace mapproof
