#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace mapproof {

/// An array of NumPy's format .npy: of booleans, integers or floats of 4 and 8 bytes.
class NpyArray {
 public:
  /// @param bytes  The whole file; must outlive the object.
  /// @throws IoError if it is damaged, cut off, or of other elements, which are named.
  NpyArray(std::string_view bytes, const std::string& source);

  /// Its lengths, slowest first, whatever the order of the elements in the file.
  const std::vector<std::size_t>& shape() const { return shape_; }
  /// Whether one of them is 0.
  bool is_empty() const;

  /// Appends the element in a row and column, a column of one dimension, as text; NaN: nothing.
  void append(std::string& text, std::size_t row, std::size_t column) const;

  /// Appends the rows of an array of two dimensions as CSV.
  /// @throws IoError if it has others, or is empty.
  void append_rows(std::string& text, const std::string& source) const;

 private:
  using Append = void (*)(std::string& text, const char* element, bool is_swapped);

  std::string_view data_;
  std::vector<std::size_t> shape_;
  std::size_t size_ = 0;  ///< Bytes of an element.
  Append append_ = nullptr;
  bool is_swapped_ = false;
  bool is_fortran_ = false;
};

/// The array in a file as CSV. @throws IoError as NpyArray and append_rows().
std::string npy_csv(std::string_view bytes, const std::string& source);

}  // namespace mapproof
