#include "core/embed/lle.hpp"

#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "core/base/errors.hpp"
#include "core/embed/embedder.hpp"
#include "tests/support/samples/worlds.hpp"

namespace mapproof {
namespace {

using test::affine_gap;
using test::distances_of;
using test::scattered;

Graph nearest(const Eigen::MatrixXd& distances, int neighbours) {
  return nearest_neighbours(distances, {.neighbours = neighbours});
}

TEST(HessianLle, RecoversAPlaneUpToAnAffineMap) {
  for (const Eigen::Index n : {40, 600})  // dense, and by the inverse
    for (const int neighbours : {6, 9}) {
      const Points points = scattered(n, 1);
      const Eigen::MatrixXd D = distances_of(points);
      const Embedding map = hessian_lle(D.cwiseAbs2(), nearest(D, neighbours));
      EXPECT_TRUE(map.statuses.empty()) << n << " " << neighbours;
      EXPECT_LT(affine_gap(points, map.coordinates), 1e-7) << n << " " << neighbours;
    }
}

TEST(HessianLle, UnrollsASheetWithAHole) {
  const Points all = scattered(500, 4);
  std::vector<Eigen::Index> kept;
  for (Eigen::Index i = 0; i < all.rows(); ++i)
    if ((all.row(i) - Eigen::RowVector2d(0.5, 0.5)).norm() > 0.2) kept.push_back(i);
  const Points sheet = all(kept, Eigen::all);
  // Rolled into two thirds of a cylinder.
  Eigen::MatrixX3d rolled(sheet.rows(), 3);
  rolled << (4.0 * sheet.col(0)).array().cos() / 4.0, (4.0 * sheet.col(0)).array().sin() / 4.0,
      sheet.col(1);
  Eigen::MatrixXd D(sheet.rows(), sheet.rows());
  for (Eigen::Index i = 0; i < D.rows(); ++i)
    D.col(i) = (rolled.rowwise() - rolled.row(i)).rowwise().norm();
  const Embedding map = hessian_lle(D.cwiseAbs2(), nearest(D, 10));
  EXPECT_LT(affine_gap(sheet, map.coordinates), 0.03);
}

TEST(HessianLle, ReportsThatALineHasNoTangentPlanes) {
  Points line = scattered(12, 1);
  line.col(1).setZero();
  const Eigen::MatrixXd D = distances_of(line);
  const Embedding map = hessian_lle(D.cwiseAbs2(), nearest(D, 6));
  ASSERT_FALSE(map.statuses.empty());
  EXPECT_EQ(map.statuses.back(), status_of<StatusReason::kNoTangentPlane>(12, 12));
}

TEST(HessianLle, RefusesFewerThanSixNeighbours) {
  const Eigen::MatrixXd D = distances_of(scattered(20, 1));
  EXPECT_THROW(hessian_lle(D.cwiseAbs2(), nearest(D, 5)), InvalidInput);
}

TEST(HessianLle, MapsALandmarkThatIsNotANeighbourOfAnother) {
  Points points(31, 2);
  points << scattered(30, 3), 3.0, 0.4;  // far from all others
  Embedder embedder({.inner_products = {}, .squared_distances = distances_of(points).cwiseAbs2()});
  const Embedding map = embedder.embed({Method::kHessianLle, 6.0});
  ASSERT_FALSE(map.statuses.empty());
  EXPECT_EQ(map.statuses.front().code, StatusCode::kBridged);
  EXPECT_LT(affine_gap(points, map.coordinates), 1e-6);
}

}  // namespace
}  // namespace mapproof
