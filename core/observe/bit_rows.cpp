#include "core/observe/bit_rows.hpp"

#include <algorithm>
#include <bit>

#include "core/base/vectorised.hpp"
#include "core/observe/features.hpp"

namespace mapproof {
namespace {

constexpr Eigen::Index kBits = 64;

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

/// Which values of the first steps are as `is` finds them.
template <typename Is>
BitRows bits_of(const HistoryBlocks& history, Eigen::Index steps, const Is& is) {
  BitRows bits(history.landmarks(), steps);
  std::vector<std::uint64_t> words(static_cast<std::size_t>(history.landmarks()));
  for_blocks(history, steps, [&](Eigen::Index first, const Eigen::MatrixXd& values) {
    for (Eigen::Index begin = 0; begin < values.cols(); begin += kBits) {
      std::ranges::fill(words, 0);
      for (Eigen::Index j = begin; j < std::min(begin + kBits, values.cols()); ++j)
        for (Eigen::Index i = 0; i < values.rows(); ++i)
          words[static_cast<std::size_t>(i)] |= std::uint64_t{is(values(i, j))} << (j - begin);
      for (Eigen::Index i = 0; i < values.rows(); ++i)
        bits.set_word(i, first + begin, words[static_cast<std::size_t>(i)]);
    }
  });
  return bits;
}

}  // namespace

BitRows::BitRows(Eigen::Index rows, Eigen::Index columns)
    : rows_(rows),
      words_in_row_((columns + kBits - 1) / kBits),
      words_(static_cast<std::size_t>(rows_ * words_in_row_)) {}

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

BitRows seen_bits(const HistoryBlocks& history, Eigen::Index steps) {
  return bits_of(history, steps, [](double value) { return value > 0.0; });
}

BitRows observed_bits(const HistoryBlocks& history, Eigen::Index steps) {
  return bits_of(history, steps, [](double value) { return value == value; });
}

bool are_bits(const HistoryBlocks& history, Eigen::Index steps) {
  if (history.sensor() != Sensor::kVisibility) return false;
  bool all = true;
  for_blocks(history, steps, [&](Eigen::Index, const Eigen::MatrixXd& block) {
    const auto values = block.array();
    all = all && (values == 0.0 || values == 1.0 || values.isNaN()).all();
  });
  return all;
}

}  // namespace mapproof
