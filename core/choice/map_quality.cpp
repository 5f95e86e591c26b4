#include "core/choice/map_quality.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "core/align/affine.hpp"
#include "core/base/errors.hpp"
#include "core/base/not_finite.hpp"

namespace mapproof {
namespace {

Eigen::MatrixXd distances_in(const Points& map) {
  const Eigen::Index n = map.rows();
  Eigen::MatrixXd D(n, n);
  for (Eigen::Index j = 0; j < n; ++j) D.col(j) = (map.rowwise() - map.row(j)).rowwise().norm();
  return D;
}

/// Sums over the pairs whose distances are both finite.
struct PairSums {
  double count = 0, x = 0, y = 0, xx = 0, xy = 0, yy = 0;

  PairSums(const Eigen::MatrixXd& distances, const Points& map) {
    for (Eigen::Index j = 0; j < map.rows(); ++j)
      for (Eigen::Index i = j + 1; i < map.rows(); ++i) {
        const double delta = distances(i, j);
        const double d = (map.row(i) - map.row(j)).norm();
        if (!std::isfinite(delta) || !std::isfinite(d)) continue;
        count += 1.0, x += delta, y += d;
        xx += delta * delta, xy += delta * d, yy += d * d;
      }
  }
};

/// Rank of each other landmark about landmark i: 1 the nearest; the mean rank of equal distances.
Eigen::VectorXd ranks_about(const Eigen::MatrixXd& D, Eigen::Index i) {
  const Eigen::Index n = D.rows();
  std::vector<Eigen::Index> order;
  for (Eigen::Index j = 0; j < n; ++j)
    if (j != i) order.push_back(j);
  std::ranges::sort(order, {}, [&](Eigen::Index j) { return std::pair(D(j, i), j); });
  Eigen::VectorXd ranks = Eigen::VectorXd::Zero(n);
  for (std::size_t first = 0; first < order.size();) {
    std::size_t end = first + 1;
    while (end < order.size() && D(order[end], i) == D(order[first], i)) ++end;
    const double mean = 0.5 * static_cast<double>(first + 1 + end);
    for (; first < end; ++first) ranks(order[first]) = mean;
  }
  return ranks;
}

/// How many ranks too far in `there` those are that are among the nearest in `here`.
double intruders(const Eigen::VectorXd& here, const Eigen::VectorXd& there, Eigen::Index self,
                 double neighbours) {
  double sum = 0.0;
  for (Eigen::Index j = 0; j < here.size(); ++j)
    if (j != self && here(j) <= neighbours && there(j) > neighbours) sum += there(j) - neighbours;
  return sum;
}

}  // namespace

double normalised_stress(const Eigen::MatrixXd& distances, const Points& map) {
  const PairSums sums(distances, map);
  if (!(sums.xx > 0.0 && sums.yy > 0.0)) return 1.0;
  return std::clamp(1.0 - sums.xy * sums.xy / (sums.xx * sums.yy), 0.0, 1.0);
}

double residual_variance(const Eigen::MatrixXd& distances, const Points& map) {
  const PairSums s(distances, map);
  const double xx = s.xx - s.x * s.x / s.count;
  const double yy = s.yy - s.y * s.y / s.count;
  const double xy = s.xy - s.x * s.y / s.count;
  if (!(xx > 1e-14 * s.xx && yy > 1e-14 * s.yy)) return 1.0;
  // Distances that fall where the others rise are no better than none.
  return xy <= 0.0 ? 1.0 : std::clamp(1.0 - xy * xy / (xx * yy), 0.0, 1.0);
}

NeighbourhoodsKept neighbourhoods_kept(const Eigen::MatrixXd& distances, const Points& map,
                                       int neighbours) {
  const Eigen::Index n = map.rows();
  if (neighbours < 1 || 2 * neighbours >= n)
    throw InvalidInput("neighbourhoods need 1 to fewer than half of the landmarks");
  const double size = static_cast<double>(n);
  const double k = neighbours;
  const Eigen::MatrixXd D = distances_in(map);
  double added = 0.0, dropped = 0.0;
  for (Eigen::Index i = 0; i < n; ++i) {
    const Eigen::VectorXd observed = ranks_about(distances, i);
    const Eigen::VectorXd mapped = ranks_about(D, i);
    added += intruders(mapped, observed, i, k);
    dropped += intruders(observed, mapped, i, k);
  }
  const double scale = 2.0 / (size * k * (2.0 * size - 3.0 * k - 1.0));
  return {.trustworthiness = 1.0 - scale * added, .continuity = 1.0 - scale * dropped};
}

double anchors_left_out(const Points& map, const Points& anchors_m,
                        const std::vector<Eigen::Index>& anchors, AffineFit fit) {
  std::vector<Eigen::Index> mapped;
  for (const Eigen::Index anchor : anchors)
    if (map.row(anchor).allFinite()) mapped.push_back(anchor);
  double sum = 0.0;
  int count = 0;
  for (std::size_t left_out = 0; mapped.size() >= 4 && left_out < mapped.size(); ++left_out) {
    std::vector<Eigen::Index> others = mapped;
    others.erase(others.begin() + static_cast<std::ptrdiff_t>(left_out));
    const Points from = map(others, Eigen::all);
    if (planarity(from) <= kFlatPlanarity) continue;
    const Affine affine = fit_affine(from, anchors_m(others, Eigen::all), fit);
    const Points put = affine(map.row(mapped[left_out]));
    sum += (put.row(0) - anchors_m.row(mapped[left_out])).norm();
    ++count;
  }
  return count > 0 ? sum / count : kNaN;
}

}  // namespace mapproof
