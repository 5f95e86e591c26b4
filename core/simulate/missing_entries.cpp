#include "core/simulate/missing_entries.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

#include "core/base/errors.hpp"
#include "core/base/not_finite.hpp"

namespace mapproof {
namespace {

/// Distance of a point to the segment from the origin to `end`.
double distance_to_ray(const Eigen::RowVector2d& point, const Eigen::RowVector2d& end) {
  const double along = std::clamp(point.dot(end) / end.squaredNorm(), 0.0, 1.0);
  return (point - along * end).norm();
}

}  // namespace

Losses random_losses(Eigen::Index landmarks, Eigen::Index steps, Random& random) {
  Losses losses(landmarks, steps);
  for (double& loss : losses.reshaped()) loss = random.uniform();
  return losses;
}

Losses range_losses(const World& world, const Path& path) {
  Losses losses(world.landmarks_m.rows(), path.positions_m.rows());
  for (Eigen::Index t = 0; t < losses.cols(); ++t)
    losses.col(t) = (world.landmarks_m.rowwise() - path.positions_m.row(t)).rowwise().norm();
  return losses;
}

Losses occlusion_losses(const World& world, const Path& path) {
  const Eigen::MatrixXd distances = range_losses(world, path);
  Losses losses = Losses::Constant(distances.rows(), distances.cols(), -kInfinity);
  for (Eigen::Index t = 0; t < losses.cols(); ++t) {
    const Points offsets = world.landmarks_m.rowwise() - path.positions_m.row(t);
    for (Eigen::Index i = 0; i < losses.rows(); ++i)
      for (Eigen::Index j = 0; j < losses.rows(); ++j)
        if (distances(j, t) < distances(i, t))
          losses(i, t) = std::max(losses(i, t), -distance_to_ray(offsets.row(j), offsets.row(i)));
  }
  return losses;
}

ObservationHistory with_missing(ObservationHistory history, const Losses& losses, double share) {
  if (!(share >= 0.0 && share < 1.0))
    throw InvalidInput("the share of missing data must be in [0, 1)");
  if (losses.rows() != history.landmarks() || losses.cols() != history.steps())
    throw InvalidInput("the losses are of another history");
  std::vector<Eigen::Index> entries(static_cast<std::size_t>(losses.size()));
  std::iota(entries.begin(), entries.end(), 0);
  const auto lost =
      static_cast<std::ptrdiff_t>(std::llround(share * static_cast<double>(losses.size())));
  const auto sooner = [&](Eigen::Index a, Eigen::Index b) {
    const double loss_a = losses.reshaped()(a);
    const double loss_b = losses.reshaped()(b);
    return loss_a > loss_b || (loss_a == loss_b && a < b);
  };
  std::ranges::nth_element(entries, entries.begin() + lost, sooner);
  for (std::ptrdiff_t k = 0; k < lost; ++k)
    history.values.reshaped()(entries[static_cast<std::size_t>(k)]) = kNaN;
  return history;
}

}  // namespace mapproof
