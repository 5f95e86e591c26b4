#include "core/simulate/world.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>
#include <utility>

#include <fmt/format.h>

#include "core/base/errors.hpp"
#include "core/simulate/landmark_grid.hpp"

namespace mapproof {
namespace {

std::optional<Points> try_to_scatter(const WorldOptions& options, Random& random) {
  const double margin = options.wall_margin_m + options.landmark_diameter_m / 2.0;
  const double apart = options.landmark_diameter_m + options.gap_m;
  Points placed(options.landmarks, 2);
  LandmarkGrid grid(options.side_m, apart);
  for (Eigen::Index i = 0; i < placed.rows(); ++i) {
    bool free = false;
    for (int attempt = 0; attempt < 1000 && !free; ++attempt) {
      placed(i, 0) = random.uniform(margin, options.side_m - margin);
      placed(i, 1) = random.uniform(margin, options.side_m - margin);
      free = !grid.any_near(placed(i, 0), placed(i, 1), apart, [&](Eigen::Index j) {
        return (placed.row(j) - placed.row(i)).norm() < apart;
      });
    }
    if (!free) return std::nullopt;
    grid.add(i, placed(i, 0), placed(i, 1));
  }
  return placed;
}

/// Point `index` of `count` spread over the room's outline; with four, the corners.
Eigen::RowVector2d outline_point(double side, int index, int count) {
  const double along = 4.0 * index / count;
  const int wall = static_cast<int>(along);
  const double part = (along - wall) * side;
  switch (wall) {
    case 0:
      return {part, 0.0};
    case 1:
      return {side, part};
    case 2:
      return {side - part, side};
    default:
      return {0.0, side - part};
  }
}

std::vector<Eigen::Index> along_the_walls(const World& world, int count) {
  std::vector<Eigen::Index> chosen;
  for (int k = 0; k < count; ++k) {
    const Eigen::RowVector2d target = outline_point(world.side_m, k, count);
    Eigen::VectorXd distances = (world.landmarks_m.rowwise() - target).rowwise().norm();
    for (const Eigen::Index taken : chosen) distances(taken) = HUGE_VAL;
    Eigen::Index nearest = 0;
    distances.minCoeff(&nearest);
    chosen.push_back(nearest);
  }
  return chosen;
}

/// The first `count` of a shuffled deck.
std::vector<Eigen::Index> drawn(Eigen::Index landmarks, int count, Random& random) {
  std::vector<Eigen::Index> deck(static_cast<std::size_t>(landmarks));
  std::iota(deck.begin(), deck.end(), 0);
  for (std::size_t i = 0; i < static_cast<std::size_t>(count); ++i) {
    const double left = static_cast<double>(deck.size() - i);
    const auto offset = static_cast<std::size_t>(random.uniform() * left);
    std::swap(deck[i], deck[std::min(i + offset, deck.size() - 1)]);
  }
  deck.resize(static_cast<std::size_t>(count));
  return deck;
}

std::vector<Eigen::Index> nearest(const World& world, const Eigen::RowVector2d& position,
                                  int count) {
  const Eigen::VectorXd distances = (world.landmarks_m.rowwise() - position).rowwise().norm();
  std::vector<Eigen::Index> order(static_cast<std::size_t>(distances.size()));
  std::iota(order.begin(), order.end(), 0);
  std::ranges::stable_sort(order, {}, [&](Eigen::Index i) { return distances(i); });
  order.resize(static_cast<std::size_t>(count));
  return order;
}

}  // namespace

World scatter_landmarks(const WorldOptions& options, Random& random) {
  const double free_side =
      options.side_m - 2.0 * options.wall_margin_m - options.landmark_diameter_m;
  if (free_side > 0.0)
    for (int attempt = 0; attempt < 10; ++attempt)
      if (std::optional<Points> placed = try_to_scatter(options, random))
        return {.side_m = options.side_m,
                .landmark_diameter_m = options.landmark_diameter_m,
                .landmarks_m = std::move(*placed)};
  throw InvalidInput(fmt::format("{} landmarks of {} m do not fit a room of {} m",
                                 options.landmarks, options.landmark_diameter_m, options.side_m));
}

std::vector<Eigen::Index> place_anchors(const World& world, int count, AnchorPlacement placement,
                                        Random& random) {
  const int wanted = std::min<int>(count, static_cast<int>(world.landmarks_m.rows()));
  std::vector<Eigen::Index> chosen;
  switch (placement) {
    case AnchorPlacement::kWalls:
      chosen = along_the_walls(world, wanted);
      break;
    case AnchorPlacement::kRandom:
      chosen = drawn(world.landmarks_m.rows(), wanted, random);
      break;
    case AnchorPlacement::kCluster:
      chosen = nearest(world, {0.0, 0.0}, wanted);
      break;
  }
  std::ranges::sort(chosen);
  return chosen;
}

}  // namespace mapproof
