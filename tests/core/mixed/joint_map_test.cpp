#include "core/mixed/mixed_map.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "core/base/errors.hpp"
#include "core/base/random.hpp"
#include "tests/support/samples/worlds.hpp"

namespace mapproof {
namespace {

TEST(IncreasingFit, PoolsWhatGoesDown) {
  EXPECT_EQ(increasing_fit({1, 2, 3}), (std::vector<double>{1, 2, 3}));
  EXPECT_EQ(increasing_fit({3, 1, 2, 6, 4}), (std::vector<double>{2, 2, 2, 5, 5}));
  EXPECT_TRUE(increasing_fit({}).empty());
}

Points shaken(const Points& points, double by, std::uint64_t seed) {
  Random random(seed);
  Points moved = points;
  for (Eigen::Index i = 0; i < points.size(); ++i) moved(i) += by * random.normal();
  return moved;
}

TEST(JointMap, IsThatOfTheDistancesHoweverEachSensorBendsThem) {
  // Monotone functions of the same distances: their order alone nearly determines the map.
  const Points ground_truth = test::scattered(30, 6);
  const Eigen::MatrixXd D = test::distances_of(ground_truth);
  const Eigen::MatrixXd bent = D.array().square() + 0.3 * D.array();
  const Eigen::MatrixXd saturated = 1.0 - (-3.0 * D.array()).exp();
  const JointMap joint = joint_map({bent, saturated}, shaken(ground_truth, 0.1, 1), {.rounds = 60});
  EXPECT_LT(test::affine_gap(ground_truth, joint.embedding.coordinates), 0.06);
  EXPECT_NEAR(joint.shares[0] + joint.shares[1], 1.0, 1e-12);
}

TEST(JointMap, GivesANoisySensorLessWeight) {
  const Points ground_truth = test::scattered(30, 7);
  const Eigen::MatrixXd D = test::distances_of(ground_truth);
  const Eigen::MatrixXd noise = test::distances_of(test::scattered(30, 99));
  EXPECT_GT(joint_map({D, noise}, shaken(ground_truth, 0.02, 2)).shares[0], 0.9);
}

TEST(JointMap, DoesNotDependOnTheOrderOfTheLandmarks) {
  const Points ground_truth = test::scattered(20, 8);
  const Eigen::MatrixXd D = test::distances_of(ground_truth);
  const Points start = shaken(ground_truth, 0.05, 3);
  const Points once = joint_map({D, D.cwiseSqrt()}, start).embedding.coordinates;
  const Eigen::MatrixXd turned = D.rowwise().reverse().colwise().reverse();
  const Points again =
      joint_map({turned, turned.cwiseSqrt()}, start.colwise().reverse()).embedding.coordinates;
  EXPECT_LT(test::procrustes_gap(once, again.colwise().reverse()), 1e-6);
}

TEST(JointMap, FailsWhereNoSensorTiesTheLandmarks) {
  Eigen::MatrixXd D = Eigen::MatrixXd::Constant(4, 4, HUGE_VAL);
  D.diagonal().setZero();
  D(0, 1) = D(1, 0) = 1.0;
  const JointMap joint = joint_map({D}, test::scattered(4, 1));
  EXPECT_EQ(joint.embedding.statuses.at(0).code, StatusCode::kFailed);
  EXPECT_TRUE(joint.embedding.coordinates.array().isNaN().all());
  EXPECT_THROW(joint_map({}, test::scattered(4, 1)), InvalidInput);
  EXPECT_THROW(joint_map({D}, Points::Zero(3, 2)), InvalidInput);
}

}  // namespace
}  // namespace mapproof
