#include "core/observe/bit_rows.hpp"

#include <algorithm>
#include <bit>

#include "core/observe/features.hpp"

namespace mapproof {
namespace {

constexpr Eigen::Index kBits = 64;

// By the processor's own instruction, where it has it.
#if defined(__x86_64__)
#define MAPPROOF_POPCOUNT [[gnu::target_clones("popcnt", "default")]]
#else
#define MAPPROOF_POPCOUNT
#endif

/// The bits that both have, for one row and some others, which follow each other.
MAPPROOF_POPCOUNT void count_in_common(const std::uint64_t* row, const std::uint64_t* others,
                                       Eigen::Index words, Eigen::Index count, double* out) {
  for (Eigen::Index j = 0; j < count; ++j, others += words) {
    std::uint64_t ones = 0;
    for (Eigen::Index k = 0; k < words; ++k)
      ones += static_cast<std::uint64_t>(std::popcount(row[k] & others[k]));
    out[j] = static_cast<double>(ones);
  }
}

}  // namespace

BitRows::BitRows(Eigen::Index rows, Eigen::Index columns)
    : rows_(rows),
      words_in_row_((columns + kBits - 1) / kBits),
      words_(static_cast<std::size_t>(rows_ * words_in_row_)) {}

BitRows::BitRows(const Eigen::Ref<const Eigen::Array<bool, Eigen::Dynamic, Eigen::Dynamic>>& bits)
    : BitRows(bits.rows(), bits.cols()) {
  std::vector<std::uint64_t> together(static_cast<std::size_t>(rows_));
  for (Eigen::Index word = 0; word < words_in_row_; ++word) {
    std::ranges::fill(together, 0);
    const Eigen::Index first = word * kBits;
    for (Eigen::Index j = first; j < std::min(first + kBits, bits.cols()); ++j)
      for (Eigen::Index i = 0; i < rows_; ++i)
        together[static_cast<std::size_t>(i)] |= std::uint64_t{bits(i, j)} << (j - first);
    for (Eigen::Index i = 0; i < rows_; ++i)
      words_[static_cast<std::size_t>(i * words_in_row_ + word)] =
          together[static_cast<std::size_t>(i)];
  }
}

Eigen::MatrixXd BitRows::in_common(const BitRows& other) const {
  // Down the columns of the result: its row i is that of `other`, the rows of this are the columns.
  Eigen::MatrixXd transposed(other.rows(), rows_);
  for (Eigen::Index i = 0; i < rows_; ++i)
    in_common(i, other, 0, other.rows(), transposed.col(i).data());
  return transposed.transpose();
}

void BitRows::in_common(Eigen::Index i, const BitRows& other, Eigen::Index first,
                        Eigen::Index count, double* counts) const {
  count_in_common(row(i), other.row(first), words_in_row_, count, counts);
}

bool are_bits(const HistoryBlocks& history, Eigen::Index steps) {
  if (history.sensor() != Sensor::kVisibility) return false;
  bool all = true;
  for_blocks(history, steps, kStepsAtATime, [&](Eigen::Index, const Eigen::MatrixXd& block) {
    const auto values = block.array();
    all = all && (values == 0.0 || values == 1.0 || values.isNaN()).all();
  });
  return all;
}

}  // namespace mapproof
