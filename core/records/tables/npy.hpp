#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include <Eigen/Core>

namespace mapproof {

/// An array of NumPy's format .npy: of booleans, integers or floats of 4 and 8 bytes.
class NpyArray {
 public:
  /// @param bytes  The whole file; must outlive the object.
  /// @throws IoError if it is damaged, cut off, or of other elements, which are named.
  NpyArray(std::string_view bytes, std::string source);

  /// Its lengths, slowest first, whatever the order of the elements in the file.
  const std::vector<std::size_t>& shape() const { return shape_; }

  /// Appends the element in a row and column, a column of one dimension, as text.
  void append(std::string& text, std::size_t row, std::size_t column) const;

 private:
  void read_header(std::string_view header);
  std::string field(std::string_view header, std::string_view key) const;

  std::string source_;
  std::string_view data_;
  std::vector<std::size_t> shape_;
  char kind_ = 'f';  ///< b, i, u or f.
  std::size_t size_ = 8;
  bool is_swapped_ = false;
  bool is_fortran_ = false;
};

/// A matrix as a file of NumPy's format .npy, version 1.0: float64, little endian, by rows.
std::string npy_bytes(const Eigen::MatrixXd& matrix);

}  // namespace mapproof
