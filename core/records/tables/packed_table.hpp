#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "core/base/files/descriptor.hpp"

namespace mapproof {

/// Numbers of a table, in as few bytes as hold them exactly: those of few decimals, as files have
/// them, in 1 to 4 bytes, others in 8. NaN is kept, not its bits.
///
/// Beyond kInMemory bytes they go to a file without a name in the folder for temporary files; to
/// memory if there cannot be one.
class PackedTable {
 public:
  static constexpr std::size_t kInMemory = std::size_t{150} << 20;

  /// @param in_memory  Bytes to keep in memory.
  explicit PackedTable(std::size_t columns, std::size_t in_memory = kInMemory);

  /// @param row  As many as there are columns.
  void add_row(std::span<const double> row);

  /// After the last row, before the first read().
  void end();

  std::size_t rows() const { return rows_; }
  std::size_t columns() const { return columns_; }
  std::size_t bytes() const { return bytes_; }

  /// count numbers from first on, `stride` apart.
  struct Range {
    std::size_t first, count, stride;
  };

  /// Writes number (i, k) of the chosen rows and columns to out[i * row_step + k * column_step].
  /// @throws IoError if the file cannot be read.
  void read(const Range& rows, const Range& columns, double* out, std::size_t row_step,
            std::size_t column_step) const;

 private:
  /// Some columns of a band of rows, row by row.
  struct Tile {
    std::vector<std::uint8_t> codes;  ///< Empty: in the file.
    std::size_t offset = 0;           ///< In the file.
    std::uint8_t width = 0;           ///< Bytes of a number.
    std::uint8_t decimals = 0;
  };
  struct Columns {
    std::size_t first, count;
  };

  Columns columns_of_tile(std::size_t k) const;
  void pack_band();
  void keep(Tile tile);
  const std::uint8_t* codes_of(const Tile& tile, std::size_t numbers,
                               std::vector<std::uint8_t>& buffer) const;

  std::size_t columns_;
  std::size_t in_memory_;
  std::size_t tiles_in_band_;
  std::size_t band_rows_;     ///< Of all bands but the last.
  std::vector<double> band_;  ///< Rows that are not packed yet.
  std::vector<Tile> tiles_;   ///< Of each band in turn.
  std::size_t rows_ = 0;
  std::size_t bytes_ = 0;    ///< Of all tiles,
  std::size_t in_file_ = 0;  ///< and of those in the file.
  std::unique_ptr<Descriptor> file_;
  bool has_no_file_ = false;  ///< It could not be made or written.
};

}  // namespace mapproof
