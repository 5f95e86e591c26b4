#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "core/records/tables/table_reader.hpp"

namespace mapproof {

/// Rows of a text of numbers between blanks, each of `width` finite ones.
class NumberRows {
 public:
  /// @param text  From checked_text(); must outlive the object, as must `source`.
  NumberRows(std::string_view text, const std::string& source, std::size_t width);

  /// @return Whether there was a row. @throws IoError with the line if it is none of `width` finite
  ///         numbers.
  bool next();

  /// @throws IoError at the row's line.
  [[noreturn]] void fail(const std::string& what) const;

  std::size_t line() const { return row_.line; }
  double operator[](std::size_t i) const { return values_[i]; }
  const std::vector<double>& values() const { return values_; }
  /// An identifying number: an integer from 0. @throws IoError if it is none.
  int id(std::size_t i) const;

 private:
  const std::string& source_;
  TableReader reader_;
  TableRow row_;
  std::vector<double> values_;
};

}  // namespace mapproof
