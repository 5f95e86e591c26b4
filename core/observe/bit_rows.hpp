#pragma once

#include <bit>
#include <cstdint>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "core/model/histories/history_blocks.hpp"

namespace mapproof {

/// A way to count the bits that a row has in common with some others, which follow each other: all
/// give the same counts.
struct BitCounter {
  std::string name;
  void (*count)(const std::uint64_t* row, const std::uint64_t* others, Eigen::Index words,
                Eigen::Index count, double* counts);
};

/// Those that this processor can run, the fastest first.
std::vector<BitCounter> bit_counters();

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

  /// How many bits are 1.
  Eigen::Index ones() const;

  /// Calls take(column) for each 1 of row i, ascending.
  template <typename Take>
  void for_each_one(Eigen::Index i, const Take& take) const {
    for (Eigen::Index word = 0; word < words_in_row_; ++word)
      for (std::uint64_t left = row(i)[word]; left != 0; left &= left - 1)
        take(64 * word + std::countr_zero(left));
  }

  /// How many columns have a 1 in row i of this and in row j of the other, for each i and j.
  /// @param other  With as many columns.
  /// @return Exact; what the product of both as matrices of 0 and 1 would be.
  /// @note rows * other.rows * columns / 64 steps.
  Eigen::MatrixXd in_common(const BitRows& other) const;

  /// The same of all pairs of rows of this alone, at half the cost.
  Eigen::MatrixXd in_common() const;

  /// The same of row i alone with `count` rows of the other from `first` on, into `counts`.
  void in_common(Eigen::Index i, const BitRows& other, Eigen::Index first, Eigen::Index count,
                 double* counts) const;

 private:
  const std::uint64_t* row(Eigen::Index i) const { return words_.data() + i * words_in_row_; }

  Eigen::Index rows_ = 0;
  Eigen::Index words_in_row_ = 0;
  std::vector<std::uint64_t> words_;
};

/// The first observations of a history as bits, a row for each landmark.
struct HistoryBits {
  BitRows seen;      ///< Above 0.
  BitRows observed;  ///< Not missing.
  bool misses_any = false;
  bool are_all = false;  ///< Visibility of 0, 1 and missing values alone: nothing else is known.
};

/// @param steps  How many observations to use, from the first.
HistoryBits history_bits(const HistoryBlocks& history, Eigen::Index steps);

}  // namespace mapproof
