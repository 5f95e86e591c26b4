#pragma once

#include <Eigen/Core>

#include "core/linalg/symmetric_eigen.hpp"
#include "core/model/histories/history_blocks.hpp"
#include "core/observe/seen_lists.hpp"

namespace mapproof {

/// The observation vectors of M landmarks (see features.hpp), X with M rows, of which only products
/// are known: neither they nor an array of M x M need be held.
struct HistoryVectors {
  Eigen::Index landmarks = 0;
  BlockProduct product;         ///< V to X X' V, M x 8.
  double largest_square = 0.0;  ///< The squared length of the longest.
};

/// Of complete bearings or ranges.
///
/// @param history  Without missing values. What it reads from has to outlive the result.
/// @param most_held  So many entries of the vectors are held; if there are more, each product reads
///        the history once, some steps at a time.
/// @throws InvalidInput unless 1 <= steps <= history.steps(); for visibility.
/// @note A product takes 16 C additions and multiplications for each landmark's C numbers, and
///       their cosines and sines where they are not held; 320 MB, or two blocks of 128 MB and
///       their vectors.
HistoryVectors history_vectors(const HistoryBlocks& history, Eigen::Index steps,
                               Eigen::Index most_held = 40'000'000);

/// Of visibility: rows of length 1, whose products are the cosines between landmarks.
/// @param seen  Each landmark at some step. It has to outlive the result.
/// @note A product takes 16 additions for each entry that was seen.
HistoryVectors visibility_vectors(const SeenLists& seen);

}  // namespace mapproof
