#include "core/records/tables/respelling.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <iterator>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <zip.h>

#include "core/base/errors.hpp"
#include "core/base/text/csv.hpp"
#include "core/json/text_input.hpp"

namespace mapproof {
namespace {

constexpr std::size_t kLargestArray = std::size_t{1} << 31;

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

void append_rows(std::string& text, const NpyArray& array, const std::string& source) {
  if (array.shape().size() != 2)
    throw IoError(source, fmt::format("a NumPy array of shape ({}); a table has two dimensions",
                                      fmt::join(array.shape(), ", ")));
  for (std::size_t row = 0; row < array.shape()[0]; ++row)
    for (std::size_t column = 0; column < array.shape()[1]; ++column) {
      array.append(text, row, column);
      text += column + 1 == array.shape()[1] ? '\n' : ',';
    }
}

/// An archive of arrays.
class Archive {
 public:
  Archive(std::string_view bytes, const std::string& source) : source_(source) {
    zip_error_t error;
    zip_error_init(&error);
    zip_source_t* buffer = zip_source_buffer_create(bytes.data(), bytes.size(), 0, &error);
    if (buffer != nullptr) archive_ = zip_open_from_source(buffer, ZIP_RDONLY, &error);
    const std::string what = zip_error_strerror(&error);
    zip_error_fini(&error);
    if (archive_ != nullptr) return;
    zip_source_free(buffer);
    throw IoError(source_, "the archive of NumPy arrays is damaged: " + what);
  }
  ~Archive() { zip_discard(archive_); }
  Archive(const Archive&) = delete;
  Archive& operator=(const Archive&) = delete;

  /// Names without ".npy", and bytes.
  std::vector<std::pair<std::string, std::string>> arrays() {
    std::vector<std::pair<std::string, std::string>> arrays;
    std::size_t total = 0;
    for (zip_int64_t i = 0; i < zip_get_num_entries(archive_, 0); ++i) {
      zip_stat_t facts;
      if (zip_stat_index(archive_, static_cast<zip_uint64_t>(i), 0, &facts) != 0) continue;
      std::string name = facts.name;
      if (!name.ends_with(".npy")) continue;
      total += facts.size;
      if (facts.size > kLargestArray || total > kLargestArray)
        throw IoError(source_, "its arrays unpack to more than 2 GiB");
      arrays.emplace_back(name.substr(0, name.size() - 4),
                          entry(static_cast<zip_uint64_t>(i), facts.size));
    }
    return arrays;
  }

 private:
  std::string entry(zip_uint64_t index, zip_uint64_t size) {
    std::string bytes(size, '\0');
    zip_file_t* file = zip_fopen_index(archive_, index, 0);
    const bool is_read =
        file != nullptr && zip_fread(file, bytes.data(), size) == static_cast<zip_int64_t>(size);
    if (file != nullptr) zip_fclose(file);
    if (!is_read) throw IoError(source_, "the archive of NumPy arrays is damaged");
    return bytes;
  }

  const std::string& source_;
  zip_t* archive_ = nullptr;
};

struct NamedArray {
  std::string name;
  NpyArray array;
};

/// Arrays of one dimension and one length: the columns of a table.
std::string columns_csv(const std::vector<NamedArray>& arrays) {
  std::string text;
  for (const NamedArray& one : arrays) text += (text.empty() ? "" : ",") + csv_field(one.name);
  text += '\n';
  for (std::size_t row = 0; row < arrays[0].array.shape()[0]; ++row)
    for (std::size_t i = 0; i < arrays.size(); ++i) {
      arrays[i].array.append(text, row, 0);
      text += i + 1 == arrays.size() ? '\n' : ',';
    }
  return text;
}

}  // namespace

std::string npy_csv(std::string_view bytes, const std::string& source) {
  std::string text;
  append_rows(text, NpyArray(bytes, source), source);
  return text;
}

std::string npz_csv(std::string_view bytes, const std::string& source) {
  Archive archive(bytes, source);
  const auto files = archive.arrays();
  std::vector<NamedArray> arrays;
  for (const auto& [name, array] : files)
    arrays.push_back({name, NpyArray(array, fmt::format("{}: {}", source, printable(name)))});
  const auto is_table = [](const NamedArray& one) { return one.array.shape().size() == 2; };
  const auto tables = std::ranges::count_if(arrays, is_table);
  if (tables == 1) {
    std::string text;
    append_rows(text, std::ranges::find_if(arrays, is_table)->array, source);
    return text;
  }
  const bool are_columns =
      !arrays.empty() && std::ranges::all_of(arrays, [&](const NamedArray& one) {
        return one.array.shape().size() == 1 && one.array.shape() == arrays[0].array.shape();
      });
  if (are_columns) return columns_csv(arrays);
  std::vector<std::string> names;
  for (const NamedArray& one : arrays) names.push_back(printable(one.name));
  throw IoError(source, fmt::format("holds the arrays {}; one array of two dimensions is read, or "
                                    "columns of one length: numpy.save(\"table.npy\", array)",
                                    fmt::join(names, ", ")));
}

}  // namespace mapproof
