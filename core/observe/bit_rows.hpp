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
  /// A bit for each entry, 1 where it is not zero.
  /// @note rows * columns / 8 bytes.
  explicit BitRows(
      const Eigen::Ref<const Eigen::Array<bool, Eigen::Dynamic, Eigen::Dynamic>>& bits);

  /// Of rows that are set one by one, all zero at first.
  BitRows(Eigen::Index rows, Eigen::Index columns);
  void set(Eigen::Index row, Eigen::Index column) {
    words_[static_cast<std::size_t>(row * words_in_row_ + column / 64)] |= std::uint64_t{1}
                                                                          << (column % 64);
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

/// Whether the history is of visibility and its first `steps` columns hold nothing but 0, 1 and
/// missing entries.
bool are_bits(const HistoryBlocks& history, Eigen::Index steps);

}  // namespace mapproof
