#include "core/records/tables/npy.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <iterator>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "core/base/errors.hpp"
#include "core/base/text/words.hpp"
#include "core/json/text_input.hpp"

namespace mapproof {
namespace {

template <typename Value>
void append_as(std::string& text, const char* element, bool is_swapped) {
  std::array<char, sizeof(Value)> bytes{};
  std::copy_n(element, sizeof(Value), bytes.begin());
  if (is_swapped) std::ranges::reverse(bytes);
  const auto value = std::bit_cast<Value>(bytes);
  if constexpr (std::is_floating_point_v<Value>)
    if (std::isnan(value)) return;                         // An empty cell is missing.
  fmt::format_to(std::back_inserter(text), "{}", +value);  // Bytes as numbers.
}

struct Element {
  std::string_view type;  ///< As NumPy writes it, behind the order of the bytes.
  std::size_t size;
  void (*append)(std::string&, const char*, bool);
};

constexpr Element kElements[] = {
    {"f8", 8, append_as<double>},        {"f4", 4, append_as<float>},
    {"i8", 8, append_as<std::int64_t>},  {"i4", 4, append_as<std::int32_t>},
    {"i2", 2, append_as<std::int16_t>},  {"i1", 1, append_as<std::int8_t>},
    {"u8", 8, append_as<std::uint64_t>}, {"u4", 4, append_as<std::uint32_t>},
    {"u2", 2, append_as<std::uint16_t>}, {"u1", 1, append_as<std::uint8_t>},
    {"b1", 1, append_as<std::uint8_t>}};

/// The text behind 'key': up to the comma or bracket that ends it.
std::string_view field(std::string_view header, std::string_view key, const std::string& source) {
  const std::size_t at = header.find(fmt::format("'{}':", key));
  if (at == std::string_view::npos)
    throw IoError(source, fmt::format("the header of the NumPy array lacks '{}'", key));
  const std::string_view text = trimmed(header.substr(at + key.size() + 3));
  const char close = text.starts_with('(') ? ')' : text.starts_with('[') ? ']' : ',';
  return trimmed(text.substr(0, text.find(close)));
}

/// @throws IoError naming what is not read, and what converts it.
const Element& element_of(std::string_view descr, const std::string& source) {
  if (descr.starts_with('['))
    throw IoError(source,
                  "a NumPy array of records (a structured array): in Python, "
                  "pandas.DataFrame(array).to_csv(\"table.csv\", index=False)");
  const std::string_view type = trimmed(descr, "'");
  const bool has_order =
      !type.empty() && std::string_view("<>|=").find(type.front()) != std::string_view::npos;
  const auto* found =
      std::ranges::find(kElements, has_order ? type.substr(1) : type, &Element::type);
  if (found != std::end(kElements)) return *found;
  throw IoError(source, fmt::format("a NumPy array of elements {}; booleans, integers, float32 and "
                                    "float64 are read: array.astype(float)",
                                    in_quotes(type)));
}

std::vector<std::size_t> lengths_in(std::string_view shape, const std::string& source) {
  std::vector<std::size_t> lengths;
  for (std::size_t at; (at = shape.find_first_of("0123456789")) != std::string_view::npos;) {
    shape.remove_prefix(at);
    const auto [stop, error] =
        std::from_chars(shape.data(), shape.data() + shape.size(), lengths.emplace_back());
    if (error != std::errc()) throw IoError(source, "the shape of the NumPy array is broken");
    shape.remove_prefix(static_cast<std::size_t>(stop - shape.data()));
  }
  return lengths;
}

}  // namespace

NpyArray::NpyArray(std::string_view bytes, const std::string& source) {
  const auto require = [&](bool is_whole) {
    if (!is_whole) throw IoError(source, "the NumPy array is cut off");
  };
  constexpr std::size_t kStart = 8;  // The magic bytes and the version.
  const std::size_t length_bytes = bytes.size() > kStart && bytes[6] == 1 ? 2 : 4;
  require(bytes.size() >= kStart + length_bytes);
  std::size_t length = 0;
  for (std::size_t i = 0; i < length_bytes; ++i)
    length |= std::size_t{static_cast<unsigned char>(bytes[kStart + i])} << (8 * i);
  const std::string_view rest = bytes.substr(kStart + length_bytes);
  require(length <= rest.size());
  data_ = rest.substr(length);

  const std::string_view header = rest.substr(0, length);
  const std::string_view descr = field(header, "descr", source);
  const Element& element = element_of(descr, source);
  size_ = element.size;
  append_ = element.append;
  is_swapped_ = trimmed(descr, "'").starts_with('>');
  is_fortran_ = field(header, "fortran_order", source) == "True";
  shape_ = lengths_in(field(header, "shape", source), source);

  std::size_t count = is_empty() ? 0 : 1;
  for (const std::size_t n : shape_) {
    require(count <= data_.size() / std::max<std::size_t>(n, 1));
    count *= n;
  }
  require(count * size_ <= data_.size());
}

bool NpyArray::is_empty() const { return std::ranges::find(shape_, 0U) != shape_.end(); }

void NpyArray::append(std::string& text, std::size_t row, std::size_t column) const {
  const std::size_t rows = shape_[0], columns = shape_.size() > 1 ? shape_[1] : 1;
  const std::size_t index = is_fortran_ ? column * rows + row : row * columns + column;
  append_(text, data_.data() + index * size_, is_swapped_);
}

void NpyArray::append_rows(std::string& text, const std::string& source) const {
  if (shape_.size() != 2)
    throw IoError(source, fmt::format("a NumPy array of shape ({}); a table has two dimensions",
                                      fmt::join(shape_, ", ")));
  if (is_empty())
    throw IoError(source,
                  fmt::format("a NumPy array of {} x {} holds no number", shape_[0], shape_[1]));
  for (std::size_t row = 0; row < shape_[0]; ++row)
    for (std::size_t column = 0; column < shape_[1]; ++column) {
      append(text, row, column);
      text += column + 1 == shape_[1] ? '\n' : ',';
    }
}

std::string npy_csv(std::string_view bytes, const std::string& source) {
  std::string text;
  NpyArray(bytes, source).append_rows(text, source);
  return text;
}

}  // namespace mapproof
