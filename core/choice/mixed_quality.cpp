#include "core/choice/mixed_quality.hpp"

#include <algorithm>

#include "core/base/errors.hpp"
#include "core/base/not_finite.hpp"
#include "core/choice/map_quality.hpp"

namespace mapproof {
namespace {

constexpr Eigen::Index kFewest = 8;

std::vector<Eigen::Index> known_and_mapped(const Eigen::MatrixXd& distances, const Points& map) {
  std::vector<Eigen::Index> rows;
  for (Eigen::Index i = 0; i < map.rows(); ++i)
    if (map.row(i).allFinite() && distances.row(i).array().isFinite().count() > 1)
      rows.push_back(i);
  return rows;
}

}  // namespace

double mixed_continuity(const std::vector<Eigen::MatrixXd>& distances,
                        const std::vector<double>& weights, const Points& map) {
  if (distances.size() != weights.size())
    throw InvalidInput("the continuity of a mixed map needs one weight per sensor");
  double sum = 0.0, total = 0.0;
  for (std::size_t s = 0; s < distances.size(); ++s) {
    if (distances[s].rows() != map.rows() || distances[s].cols() != map.rows())
      throw InvalidInput("a map and its sensors' distances must be of the same landmarks");
    const std::vector<Eigen::Index> rows = known_and_mapped(distances[s], map);
    const auto n = std::ssize(rows);
    if (n < kFewest || !(weights[s] > 0.0)) continue;
    const auto neighbours = static_cast<int>(std::min<std::ptrdiff_t>(10, n / 4));
    sum +=
        weights[s] *
        neighbourhoods_kept(distances[s](rows, rows), map(rows, Eigen::all), neighbours).continuity;
    total += weights[s];
  }
  return total > 0.0 ? sum / total : kNaN;
}

}  // namespace mapproof
