#include "core/records/tables/packed_table.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <optional>
#include <system_error>
#include <utility>

#include "core/base/errors.hpp"
#include "core/base/not_finite.hpp"
#include "core/base/vectorised.hpp"

namespace mapproof {
namespace {

constexpr std::size_t kTileColumns = 1024;
constexpr std::size_t kBandNumbers = std::size_t{1} << 16;
constexpr std::size_t kPadding = 8;  // Codes are read by words.
constexpr std::size_t kRaw = 8;      // The width of doubles as they are.

constexpr int kMostDecimals = 9;
constexpr std::array<double, kMostDecimals + 1> kPowersOfTen = {1e0, 1e1, 1e2, 1e3, 1e4,
                                                                1e5, 1e6, 1e7, 1e8, 1e9};
constexpr double kRounding = 6755399441055744.0;  // 1.5 * 2^52: adding it rounds to an integer.
constexpr double kLargestCode = 2147483645.0;

/// The two least codes of a width stand for what is not a decimal number.
constexpr std::int32_t missing_code(std::size_t width) {
  return static_cast<std::int32_t>(-(std::int64_t{1} << (8 * width - 1)));
}
constexpr std::int32_t minus_zero_code(std::size_t width) { return missing_code(width) + 1; }

/// Whether the number is exactly a code over a power of ten.
bool is_decimal(double number, double power) {
  const double code = (number * power + kRounding) - kRounding;
  return std::abs(code) <= kLargestCode && code / power == number;
}

/// How many decimals a number has; empty: too many.
std::optional<int> decimals_of(double number) {
  for (int decimals = 0; decimals <= kMostDecimals; ++decimals)
    if (is_decimal(number, kPowersOfTen[static_cast<std::size_t>(decimals)])) return decimals;
  return std::nullopt;
}

/// The codes of numbers over a power of ten; minus zero and NaN get that of zero.
/// @return The largest of them, disregarding their sign; negative if one is not exactly its number.
MAPPROOF_VECTORISED_WIDE double encode(const double* numbers, std::size_t count, double power,
                                       double* codes) {
  bool are_exact = true;
  double largest = 0.0;
  for (std::size_t i = 0; i < count; ++i) {
    const double number = numbers[i];
    const bool is_number = number == number;
    const double code = ((is_number ? number : 0.0) * power + kRounding) - kRounding;
    codes[i] = code;
    const double size = code < 0.0 ? -code : code;
    largest = size > largest ? size : largest;
    are_exact = are_exact & (!is_number | (code / power == number));
  }
  return are_exact ? largest : -1.0;
}

/// The decimals that all of some numbers have, from a few of them; empty: not all have few.
std::optional<int> common_decimals(std::span<const double> numbers) {
  constexpr std::size_t kSamples = 32;
  const std::size_t step = std::max<std::size_t>(1, numbers.size() / kSamples);
  int most = 0;
  for (std::size_t i = 0; i < numbers.size(); i += step) {
    if (std::isnan(numbers[i])) continue;
    const std::optional<int> decimals = decimals_of(numbers[i]);
    if (!decimals) return std::nullopt;
    most = std::max(most, *decimals);
  }
  return most;
}

/// More decimals, which the first number that has more of them needs.
std::optional<int> more_decimals(std::span<const double> numbers, int decimals) {
  for (const double number : numbers) {
    if (std::isnan(number) || is_decimal(number, kPowersOfTen[static_cast<std::size_t>(decimals)]))
      continue;
    const std::optional<int> needed = decimals_of(number);
    if (!needed || *needed <= decimals) return std::nullopt;
    return needed;
  }
  return std::nullopt;
}

std::size_t width_of(double largest) {
  for (const std::size_t width : {1U, 2U, 3U})
    if (largest < -static_cast<double>(minus_zero_code(width))) return width;
  return largest <= kLargestCode ? 4 : kRaw;
}

template <std::size_t kWidth>
void write_codes(std::span<const double> numbers, const std::vector<double>& codes,
                 std::uint8_t* out) {
  for (std::size_t i = 0; i < numbers.size(); ++i, out += kWidth) {
    auto code = static_cast<std::int32_t>(codes[i]);
    if (std::isnan(numbers[i])) code = missing_code(kWidth);
    if (code == 0 && std::signbit(numbers[i])) code = minus_zero_code(kWidth);
    for (std::size_t b = 0; b < kWidth; ++b)
      out[b] = static_cast<std::uint8_t>(static_cast<std::uint32_t>(code) >> (8 * b));
  }
}

template <std::size_t kWidth>
void read_codes(const std::uint8_t* in, std::size_t count, std::size_t stride, double power,
                double* out, std::size_t step) {
  for (std::size_t i = 0; i < count; ++i, in += stride * kWidth, out += step) {
    std::uint32_t word = 0;
    std::memcpy(&word, in, sizeof word);
    const auto code = static_cast<std::int32_t>(word << (32 - 8 * kWidth)) >> (32 - 8 * kWidth);
    *out = code > minus_zero_code(kWidth)    ? static_cast<double>(code) / power
           : code == minus_zero_code(kWidth) ? -0.0
                                             : kNaN;
  }
}

void read_raw(const std::uint8_t* in, std::size_t count, std::size_t stride, double* out,
              std::size_t step) {
  for (std::size_t i = 0; i < count; ++i, in += stride * kRaw, out += step)
    std::memcpy(out, in, sizeof *out);
}

}  // namespace

PackedTable::PackedTable(std::size_t columns, std::size_t in_memory)
    : columns_(columns),
      in_memory_(in_memory),
      // The first column may hold times, which have more digits than the others.
      tiles_in_band_(1 + (columns + kTileColumns - 2) / kTileColumns),
      band_rows_(std::clamp<std::size_t>(kBandNumbers / std::max<std::size_t>(1, columns), 1,
                                         kTileColumns)) {}

PackedTable::Columns PackedTable::columns_of_tile(std::size_t k) const {
  if (k == 0) return {0, 1};
  const std::size_t first = 1 + (k - 1) * kTileColumns;
  return {first, std::min(kTileColumns, columns_ - first)};
}

void PackedTable::add_row(std::span<const double> row) {
  band_.insert(band_.end(), row.begin(), row.end());
  ++rows_;
  if (band_.size() == band_rows_ * columns_) pack_band();
}

void PackedTable::end() {
  if (!band_.empty()) pack_band();
  band_ = {};
}

void PackedTable::pack_band() {
  const std::size_t rows = band_.size() / columns_;
  std::vector<double> numbers, codes;
  for (std::size_t k = 0; k < tiles_in_band_; ++k) {
    const auto [first, count] = columns_of_tile(k);
    numbers.clear();
    for (std::size_t r = 0; r < rows; ++r) {
      const auto row = band_.begin() + static_cast<std::ptrdiff_t>(r * columns_ + first);
      numbers.insert(numbers.end(), row, row + static_cast<std::ptrdiff_t>(count));
    }
    codes.resize(numbers.size());
    std::optional<int> decimals = common_decimals(numbers);
    double largest = -1.0;
    while (decimals) {
      largest = encode(numbers.data(), numbers.size(),
                       kPowersOfTen[static_cast<std::size_t>(*decimals)], codes.data());
      if (largest >= 0.0) break;
      decimals = more_decimals(numbers, *decimals);
    }
    Tile tile;
    tile.width = static_cast<std::uint8_t>(decimals ? width_of(largest) : kRaw);
    tile.decimals = static_cast<std::uint8_t>(decimals.value_or(0));
    tile.codes.resize(numbers.size() * tile.width + kPadding);
    switch (tile.width) {
      case 1:
        write_codes<1>(numbers, codes, tile.codes.data());
        break;
      case 2:
        write_codes<2>(numbers, codes, tile.codes.data());
        break;
      case 3:
        write_codes<3>(numbers, codes, tile.codes.data());
        break;
      case 4:
        write_codes<4>(numbers, codes, tile.codes.data());
        break;
      default:
        std::memcpy(tile.codes.data(), numbers.data(), numbers.size() * kRaw);
    }
    keep(std::move(tile));
  }
  band_.clear();
}

/// @return Whether all bytes were written from that place on.
bool write_at(int file, std::span<const std::uint8_t> bytes, std::size_t at) {
  while (!bytes.empty()) {
    const ssize_t part = ::pwrite(file, bytes.data(), bytes.size(), static_cast<off_t>(at));
    if (part < 0 && errno == EINTR) continue;
    if (part <= 0) return false;
    bytes = bytes.subspan(static_cast<std::size_t>(part));
    at += static_cast<std::size_t>(part);
  }
  return true;
}

/// In memory, or in the file if that has become too much.
void PackedTable::keep(Tile tile) {
  const std::size_t size = tile.codes.size();
  bytes_ += size;
  if (bytes_ - in_file_ > in_memory_ && !has_no_file_) {
    std::error_code error;
    const std::filesystem::path folder = std::filesystem::temp_directory_path(error);
    if (!file_ && !error)
      file_ = std::make_unique<Descriptor>(
          ::open(folder.c_str(), O_TMPFILE | O_RDWR | O_CLOEXEC, S_IRUSR | S_IWUSR));
    has_no_file_ = !file_ || file_->get() < 0 || !write_at(file_->get(), tile.codes, in_file_);
    if (!has_no_file_) {
      tile.codes = {};
      tile.offset = in_file_;
      in_file_ += size;
    }
  }
  tiles_.push_back(std::move(tile));
}

const std::uint8_t* PackedTable::codes_of(const Tile& tile, std::size_t numbers,
                                          std::vector<std::uint8_t>& buffer) const {
  if (!tile.codes.empty()) return tile.codes.data();
  buffer.resize(numbers * tile.width + kPadding);
  std::size_t got = 0;
  while (got < buffer.size()) {
    const ssize_t part = ::pread(file_->get(), buffer.data() + got, buffer.size() - got,
                                 static_cast<off_t>(tile.offset + got));
    if (part < 0 && errno == EINTR) continue;
    if (part <= 0)
      throw IoError("a temporary file",
                    part < 0 ? "cannot be read: " + std::generic_category().message(errno)
                             : std::string("cannot be read: it ends too early"));
    got += static_cast<std::size_t>(part);
  }
  return buffer.data();
}

void PackedTable::read(const Range& rows, const Range& columns, double* out, std::size_t row_step,
                       std::size_t column_step) const {
  std::vector<std::uint8_t> buffer;
  const std::size_t last_row = rows.first + rows.count * rows.stride;
  for (std::size_t band = rows.first / band_rows_; band * band_rows_ < std::min(last_row, rows_);
       ++band) {
    const std::size_t begin = band * band_rows_;
    const std::size_t height = std::min(band_rows_, rows_ - begin);
    const std::size_t skipped =
        begin <= rows.first ? 0 : (begin - rows.first + rows.stride - 1) / rows.stride;
    for (std::size_t k = 0; k < tiles_in_band_; ++k) {
      const auto [first, count] = columns_of_tile(k);
      const std::size_t passed =
          first <= columns.first ? 0
                                 : (first - columns.first + columns.stride - 1) / columns.stride;
      const std::size_t column = columns.first + passed * columns.stride;
      if (passed >= columns.count || column >= first + count) continue;
      const std::size_t chosen =
          std::min(columns.count - passed, (first + count - column - 1) / columns.stride + 1);
      const Tile& tile = tiles_[band * tiles_in_band_ + k];
      const std::uint8_t* codes = codes_of(tile, height * count, buffer);
      const double power = kPowersOfTen[tile.decimals];
      for (std::size_t i = skipped; i < rows.count; ++i) {
        const std::size_t row = rows.first + i * rows.stride;
        if (row >= begin + height) break;
        const std::uint8_t* in = codes + ((row - begin) * count + (column - first)) * tile.width;
        double* to = out + i * row_step + passed * column_step;
        switch (tile.width) {
          case 1:
            read_codes<1>(in, chosen, columns.stride, power, to, column_step);
            break;
          case 2:
            read_codes<2>(in, chosen, columns.stride, power, to, column_step);
            break;
          case 3:
            read_codes<3>(in, chosen, columns.stride, power, to, column_step);
            break;
          case 4:
            read_codes<4>(in, chosen, columns.stride, power, to, column_step);
            break;
          default:
            read_raw(in, chosen, columns.stride, to, column_step);
        }
      }
    }
  }
}

}  // namespace mapproof
