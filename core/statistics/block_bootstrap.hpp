#pragma once

#include <vector>

#include <Eigen/Core>

#include "core/base/random.hpp"

namespace mapproof {

/// How the blocks of a block bootstrap lie in the series.
enum class BlockEnds {
  kCircular,  ///< A block that reaches the end continues at the beginning: all steps are equally
              ///< likely [politis1992].
  kInside,    ///< Every block lies within the series [kuensch1989].
};

/// A bootstrap resample of the steps of a series: blocks of consecutive steps drawn with
/// replacement, as many steps as the series has; the last block is cut.
/// @param steps  N of the series; the result holds N indices in [0, N).
/// @param block  Consecutive steps drawn together.
/// @throws InvalidInput unless 1 <= block <= steps.
/// @note One uniform draw per block.
std::vector<Eigen::Index> block_resample(Eigen::Index steps, Eigen::Index block, BlockEnds ends,
                                         Random& random);

}  // namespace mapproof
