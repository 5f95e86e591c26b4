#include "core/range_slam/factors/spread_rows.hpp"

#include <algorithm>

#include "core/base/errors.hpp"

namespace mapproof {

std::vector<Eigen::Index> spread_rows(Eigen::Index n, Eigen::Index count) {
  if (n < 0 || count < 0) throw InvalidInput("rows cannot be fewer than none");
  const Eigen::Index shown = std::min(n, count);
  std::vector<Eigen::Index> rows;
  for (Eigen::Index i = 0; i < shown; ++i)
    rows.push_back(shown > 1 ? i * (n - 1) / (shown - 1) : 0);
  return rows;
}

}  // namespace mapproof
