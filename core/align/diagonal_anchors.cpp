#include "core/align/diagonal_anchors.hpp"

#include <algorithm>
#include <cmath>

namespace mapproof {

std::vector<Eigen::Index> diagonal_anchors(const Points& ground_truth_m) {
  std::vector<Eigen::Index> known;
  for (Eigen::Index i = 0; i < ground_truth_m.rows(); ++i)
    if (ground_truth_m.row(i).allFinite()) known.push_back(i);
  const Points positions = ground_truth_m(known, Eigen::all);
  std::vector<Eigen::Index> chosen;
  for (const Eigen::RowVector2d& diagonal : {Eigen::RowVector2d(-1, -1), Eigen::RowVector2d(1, -1),
                                             Eigen::RowVector2d(1, 1), Eigen::RowVector2d(-1, 1)}) {
    Eigen::VectorXd outward = positions * diagonal.transpose();
    for (std::size_t k = 0; k < known.size(); ++k)
      if (std::ranges::find(chosen, known[k]) != chosen.end())
        outward(static_cast<Eigen::Index>(k)) = -HUGE_VAL;
    Eigen::Index furthest = 0;
    if (chosen.size() < known.size()) {
      outward.maxCoeff(&furthest);
      chosen.push_back(known[static_cast<std::size_t>(furthest)]);
    }
  }
  std::ranges::sort(chosen);
  return chosen;
}

}  // namespace mapproof
