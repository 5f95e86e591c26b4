#include "core/records/tables/npy.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <iterator>

#include <fmt/format.h>

#include "core/base/errors.hpp"
#include "core/json/text_input.hpp"

namespace mapproof {
namespace {

template <typename Value>
Value value_at(std::string_view data, std::size_t offset, bool is_swapped) {
  std::array<char, sizeof(Value)> bytes{};
  std::memcpy(bytes.data(), data.data() + offset, sizeof(Value));
  if (is_swapped) std::ranges::reverse(bytes);
  return std::bit_cast<Value>(bytes);
}

template <typename Value>
void append_value(std::string& text, std::string_view data, std::size_t offset, bool is_swapped) {
  const auto value = value_at<Value>(data, offset, is_swapped);
  if constexpr (std::is_floating_point_v<Value>)
    if (std::isnan(value)) return;  // An empty cell is missing.
  fmt::format_to(std::back_inserter(text), "{}", value);
}

using Append = void (*)(std::string&, std::string_view, std::size_t, bool);

struct Element {
  char kind;
  std::size_t size;
  Append append;
};

/// int8_t and bool are characters to fmt.
void append_byte(std::string& text, std::string_view data, std::size_t offset, bool) {
  fmt::format_to(std::back_inserter(text), "{}",
                 static_cast<int>(static_cast<signed char>(data[offset])));
}

constexpr Element kElements[] = {{'f', 8, append_value<double>},
                                 {'f', 4, append_value<float>},
                                 {'i', 8, append_value<std::int64_t>},
                                 {'i', 4, append_value<std::int32_t>},
                                 {'i', 2, append_value<std::int16_t>},
                                 {'i', 1, append_byte},
                                 {'u', 8, append_value<std::uint64_t>},
                                 {'u', 4, append_value<std::uint32_t>},
                                 {'u', 2, append_value<std::uint16_t>},
                                 {'u', 1, append_value<std::uint8_t>},
                                 {'b', 1, append_byte}};

const Element* element_of(char kind, std::size_t size) {
  const Element* found = std::ranges::find_if(
      kElements, [&](const Element& one) { return one.kind == kind && one.size == size; });
  return found == std::end(kElements) ? nullptr : found;
}

}  // namespace

NpyArray::NpyArray(std::string_view bytes, std::string source) : source_(std::move(source)) {
  constexpr std::size_t kStart = 8;  // The magic bytes and the version.
  const std::size_t length_bytes = bytes.size() > kStart && bytes[6] == 1 ? 2 : 4;
  if (bytes.size() < kStart + length_bytes) throw IoError(source_, "the NumPy array is cut off");
  std::size_t length = 0;
  for (std::size_t i = 0; i < length_bytes; ++i)
    length |= std::size_t{static_cast<unsigned char>(bytes[kStart + i])} << (8 * i);
  const std::size_t begin = kStart + length_bytes;
  if (length > bytes.size() - begin) throw IoError(source_, "the NumPy array is cut off");
  data_ = bytes.substr(begin + length);
  read_header(bytes.substr(begin, length));
  std::size_t count = 1;
  for (const std::size_t n : shape_) {
    if (n > 0 && count > data_.size() / n) throw IoError(source_, "the NumPy array is cut off");
    count *= n;
  }
  if (count * size_ > data_.size()) throw IoError(source_, "the NumPy array is cut off");
}

/// The text behind 'key': up to the comma that ends it.
std::string NpyArray::field(std::string_view header, std::string_view key) const {
  const std::size_t at = header.find(fmt::format("'{}':", key));
  if (at == std::string_view::npos)
    throw IoError(source_, fmt::format("the header of the NumPy array lacks '{}'", key));
  std::string_view text = trimmed(header.substr(at + key.size() + 3));
  const char close = text.starts_with('(') ? ')' : text.starts_with('[') ? ']' : ',';
  return std::string(trimmed(text.substr(0, text.find(close))));
}

void NpyArray::read_header(std::string_view header) {
  std::string descr = field(header, "descr");
  std::erase(descr, '\'');
  is_fortran_ = field(header, "fortran_order") == "True";
  std::size_t size = 0;
  const char* end = descr.data() + descr.size();
  if (descr.size() > 2) std::from_chars(descr.data() + 2, end, size);
  const char order = descr.empty() ? '?' : descr[0];
  if (std::string_view("<>|=").find(order) == std::string_view::npos || descr.size() < 3 ||
      element_of(descr[1], size) == nullptr)
    throw IoError(source_, fmt::format("a NumPy array of elements {}; booleans, integers, float32 "
                                       "and float64 are read: array.astype(float)",
                                       in_quotes(descr)));
  kind_ = descr[1];
  size_ = size;
  is_swapped_ = order == '>' && size > 1;
  const std::string shape = field(header, "shape");
  for (std::size_t at = shape.find_first_of("0123456789"); at != std::string::npos;
       at = shape.find_first_of("0123456789", at)) {
    std::size_t n = 0;
    const auto [stop, error] = std::from_chars(shape.data() + at, shape.data() + shape.size(), n);
    if (error != std::errc()) throw IoError(source_, "the shape of the NumPy array is broken");
    shape_.push_back(n);
    at = static_cast<std::size_t>(stop - shape.data());
  }
}

void NpyArray::append(std::string& text, std::size_t row, std::size_t column) const {
  const std::size_t rows = shape_[0], columns = shape_.size() > 1 ? shape_[1] : 1;
  const std::size_t index = is_fortran_ ? column * rows + row : row * columns + column;
  element_of(kind_, size_)->append(text, data_, index * size_, is_swapped_);
}

std::string npy_bytes(const Eigen::MatrixXd& matrix) {
  static_assert(std::endian::native == std::endian::little,
                "elements are written as they are held");
  using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  const RowMajor rows = matrix;
  std::string header = fmt::format(
      "{{'descr': '<f8', 'fortran_order': False, 'shape': ({}, {}), }}", rows.rows(), rows.cols());
  // The elements begin at a multiple of 64 bytes, behind the magic, the version and the length.
  constexpr std::size_t kAlignment = 64, kFixed = 10;
  header.append(kAlignment - 1 - (kFixed + header.size()) % kAlignment, ' ');
  header += '\n';
  std::string bytes("\x93NUMPY\x01\x00", 8);
  bytes += static_cast<char>(header.size() & 0xff);
  bytes += static_cast<char>(header.size() >> 8);
  bytes += header;
  bytes.append(reinterpret_cast<const char*>(rows.data()),
               static_cast<std::size_t>(rows.size()) * sizeof(double));
  return bytes;
}

}  // namespace mapproof
