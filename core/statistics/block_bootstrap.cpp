#include "core/statistics/block_bootstrap.hpp"

#include "core/base/errors.hpp"

namespace mapproof {

std::vector<Eigen::Index> block_resample(Eigen::Index steps, Eigen::Index block, BlockEnds ends,
                                         Random& random) {
  if (block < 1 || block > steps)
    throw InvalidInput("a block needs 1 step to as many as there are");
  const Eigen::Index starts = ends == BlockEnds::kCircular ? steps : steps - block + 1;
  std::vector<Eigen::Index> drawn;
  drawn.reserve(static_cast<std::size_t>(steps));
  while (std::ssize(drawn) < steps) {
    const auto first = static_cast<Eigen::Index>(random.uniform() * static_cast<double>(starts));
    for (Eigen::Index i = 0; i < block && std::ssize(drawn) < steps; ++i)
      drawn.push_back((first + i) % steps);
  }
  return drawn;
}

}  // namespace mapproof
