#include "core/submaps/join.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "core/base/errors.hpp"
#include "core/base/random.hpp"
#include "core/submaps/submap_embedding.hpp"
#include "tests/support/samples/drawn_points.hpp"
#include "tests/support/samples/worlds.hpp"

namespace mapproof {
namespace {

/// A random change of frame, with a reflection every other time.
Points elsewhere(const Points& points, JoinKind kind, Random& random) {
  const double angle = random.uniform(0.0, 2.0 * std::numbers::pi);
  Eigen::Matrix2d linear;
  linear << std::cos(angle), -std::sin(angle), std::sin(angle), std::cos(angle);
  if (random.uniform() < 0.5) linear.row(0) *= -1.0;
  linear *= std::exp(random.uniform(-1.0, 1.0));
  if (kind == JoinKind::kAffine) linear.col(1) *= std::exp(random.uniform(-0.5, 0.5));
  const Eigen::RowVector2d offset = test::uniform_point(random, -5, 5);
  return (points * linear).rowwise() + offset;
}

std::vector<Submap> taken_apart(const Points& points, JoinKind kind, int size, double noise,
                                std::uint64_t seed) {
  Random random(seed);
  std::vector<Submap> maps;
  for (const LandmarkGroup& group :
       overlapping_groups(test::distances_of(points), {.size = size})) {
    Points part = points(group.members, Eigen::all);
    for (double& entry : part.reshaped()) entry += noise * random.normal();
    maps.push_back({.landmarks = group.members, .positions = elsewhere(part, kind, random)});
  }
  return maps;
}

double gap(const Points& points, const Points& estimate, JoinKind kind) {
  if (kind == JoinKind::kAffine) return test::affine_gap(points, estimate);
  const auto spread = [](const Points& of) { return (of.rowwise() - of.colwise().mean()).norm(); };
  return test::procrustes_gap(points, estimate * (spread(points) / spread(estimate)));
}

TEST(Join, BringsPiecesOfAMapTogetherWhateverTheirFrames) {
  const Points points = test::scattered(120, 1);
  for (const JoinKind kind : {JoinKind::kSimilarity, JoinKind::kAffine})
    for (const std::uint64_t seed : {1, 2, 3}) {
      const JoinResult result = join_submaps(taken_apart(points, kind, 20, 0.0, seed), kind, 120);
      EXPECT_TRUE(result.statuses.empty());
      EXPECT_LT(gap(points, result.joined.positions, kind), 1e-6);
      for (const SubmapJoin& join : result.joined.joins) EXPECT_LT(join.residual, 1e-6);
    }
}

TEST(Join, LosesLittleToNoiseAndShowsItInTheResiduals) {
  const Points points = test::scattered(120, 2);
  const JoinResult result = join_submaps(taken_apart(points, JoinKind::kSimilarity, 24, 0.005, 4),
                                         JoinKind::kSimilarity, 120);
  EXPECT_LT(gap(points, result.joined.positions, JoinKind::kSimilarity), 0.05);
  int in_tree = 0;
  for (const SubmapJoin& join : result.joined.joins) {
    EXPECT_GT(join.residual, 0.005);
    EXPECT_LT(join.residual, 0.3);
    in_tree += join.in_tree ? 1 : 0;
  }
  EXPECT_EQ(in_tree, std::ssize(result.joined.submaps) - 1);
}

TEST(Join, IsNotMovedByOneLandmarkThatASubmapHasWrong) {
  const Points points = test::scattered(60, 3);
  std::vector<Submap> maps = taken_apart(points, JoinKind::kSimilarity, 30, 0.0, 5);
  ASSERT_GT(maps.size(), 1U);
  const Eigen::Index wrong = maps.front().landmarks.front();
  maps.front().positions.row(0) += Eigen::RowVector2d(3.0, 3.0);
  const JoinResult result = join_submaps(maps, JoinKind::kSimilarity, 60);
  Points others = result.joined.positions;
  std::vector<Eigen::Index> rows;
  for (Eigen::Index i = 0; i < 60; ++i)
    if (i != wrong) rows.push_back(i);
  EXPECT_LT(gap(points(rows, Eigen::all), others(rows, Eigen::all), JoinKind::kSimilarity), 0.02);
}

TEST(Join, LeavesOutAndReportsWhatSharesTooLittle) {
  const Points points = test::grid(4, 4);
  const auto part = [&](std::vector<Eigen::Index> rows) {
    return Submap{.landmarks = rows, .positions = points(rows, Eigen::all)};
  };
  // Of the second map two landmarks are in the first; of the third three, on one line.
  const JoinResult result =
      join_submaps({part({0, 1, 2, 3, 4, 5, 6, 7}), part({6, 7, 8, 9}), part({4, 5, 6, 12, 13})},
                   JoinKind::kSimilarity, 16);
  ASSERT_EQ(result.statuses.size(), 1U);
  EXPECT_EQ(result.statuses.front(), status_of<StatusReason::kSubmapsLeftOut>(2, 3));
  EXPECT_TRUE(result.joined.positions.topRows(8).allFinite());
  EXPECT_TRUE(result.joined.positions.bottomRows(8).array().isNaN().all());
  EXPECT_TRUE(result.joined.submaps[0].placed);
  EXPECT_FALSE(result.joined.submaps[1].placed);
}

TEST(Join, RefusesWhatAreNotMaps) {
  EXPECT_THROW(join_submaps({}, JoinKind::kSimilarity, 4), InvalidInput);
  const Submap good{.landmarks = {0, 1, 2}, .positions = test::scattered(3, 1)};
  EXPECT_THROW(join_submaps({good}, JoinKind::kRigid, 4), InvalidInput);
  EXPECT_THROW(join_submaps({good}, JoinKind::kSimilarity, 2), InvalidInput);
  Submap bad = good;
  bad.landmarks = {0, 2, 1};
  EXPECT_THROW(join_submaps({bad}, JoinKind::kSimilarity, 4), InvalidInput);
  bad = good;
  bad.positions(0, 0) = std::nan("");
  EXPECT_THROW(join_submaps({bad}, JoinKind::kSimilarity, 4), InvalidInput);
}

}  // namespace
}  // namespace mapproof
