#pragma once

#include <cstdint>
#include <vector>

#include <Eigen/Core>

#include "core/model/histories/history_blocks.hpp"

namespace mapproof {

/// Rows of bits, 64 of them in a word: what was seen at each step, or observed.
class BitRows {
 public:
  BitRows() = default;
  /// All zero. @note rows * columns / 8 bytes.
  BitRows(Eigen::Index rows, Eigen::Index columns);

  /// Sets 64 columns of a row, of which the first is the lowest bit.
  /// @param first_column  A multiple of 64.
  void set_word(Eigen::Index row, Eigen::Index first_column, std::uint64_t bits) {
    words_[static_cast<std::size_t>(row * words_in_row_ + first_column / 64)] = bits;
  }

  Eigen::Index rows() const { return rows_; }

  /// How many columns have a 1 in row i of this and in row j of the other, for each i and j.
  /// @param other  With as many columns.
  /// @return Exact; what the product of both as matrices of 0 and 1 would be.
  /// @note rows * other.rows * columns / 64 steps.
  Eigen::MatrixXd in_common(const BitRows& other) const;

  /// The same of row i alone with `count` rows of the other from `first` on, into `counts`.
  void in_common(Eigen::Index i, const BitRows& other, Eigen::Index first, Eigen::Index count,
                 double* counts) const;

 private:
  const std::uint64_t* row(Eigen::Index i) const { return words_.data() + i * words_in_row_; }

  Eigen::Index rows_ = 0;
  Eigen::Index words_in_row_ = 0;
  std::vector<std::uint64_t> words_;
};

/// What was seen at each of the first `steps` observations, a row for each landmark: above 0.
BitRows seen_bits(const HistoryBlocks& history, Eigen::Index steps);

/// Where a value is not missing.
BitRows observed_bits(const HistoryBlocks& history, Eigen::Index steps);

/// Whether the history is of visibility and its first `steps` columns hold nothing but 0, 1 and
/// missing entries.
bool are_bits(const HistoryBlocks& history, Eigen::Index steps);

}  // namespace mapproof
