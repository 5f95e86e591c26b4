#include <cmath>
#include <limits>
#include <numbers>

#include <gtest/gtest.h>
#include <Eigen/Cholesky>

#include "core/base/errors.hpp"
#include "core/base/random.hpp"
#include "core/observe/features.hpp"
#include "core/observe/proximities.hpp"
#include "core/simulate/sensors.hpp"
#include "tests/support/samples/worlds.hpp"

namespace mapproof {
namespace {

constexpr double kMissing = std::numeric_limits<double>::quiet_NaN();

ObservationHistory history(Sensor sensor, const Eigen::MatrixXd& values) {
  return {.sensor = sensor, .names = landmark_names(values.rows()), .values = values};
}

TEST(Proximities, OfVisibilityAreTwoLessTwoCosines) {
  Eigen::MatrixXd seen(3, 4);
  seen << 1, 1, 0, 0,  //
      1, 1, 1, 1,      //
      0, 0, 1, 0;
  const Proximities result = proximities(history(Sensor::kVisibility, seen), 4);
  EXPECT_NEAR(result.squared_distances(0, 1), 2.0 - 2.0 * 2.0 / std::sqrt(8.0), 1e-15);
  EXPECT_NEAR(result.squared_distances(0, 2), 2.0, 1e-15);
  EXPECT_EQ(result.squared_distances(0, 0), 0.0);
}

TEST(Proximities, OfBearingsDoNotJumpAtPi) {
  Eigen::MatrixXd angles(2, 1);
  angles << std::numbers::pi - 0.01, -std::numbers::pi + 0.01;
  const Proximities result = proximities(history(Sensor::kBearing, angles), 1);
  EXPECT_NEAR(std::sqrt(result.squared_distances(0, 1)), 2.0 * std::sin(0.01), 1e-12);
}

TEST(Proximities, OfBearingsDoNotDependOnTheHeading) {
  Eigen::MatrixXd angles(3, 2);
  angles << 0.1, -2.0, 1.0, 3.0, -0.7, 0.4;
  Eigen::MatrixXd turned = angles;
  turned.col(0).array() += 1.3;
  turned.col(1).array() -= 2.9;
  EXPECT_LT((proximities(history(Sensor::kBearing, angles), 2).squared_distances -
             proximities(history(Sensor::kBearing, turned), 2).squared_distances)
                .cwiseAbs()
                .maxCoeff(),
            1e-14);
}

TEST(Proximities, OfRangesAreAnAffineImageOfTheMap) {
  const Points landmarks = test::scattered(8, 1);
  const Points robot = test::scattered(60, 2);
  Eigen::MatrixXd ranges(8, 60);
  for (Eigen::Index t = 0; t < 60; ++t)
    ranges.col(t) = (landmarks.rowwise() - robot.row(t)).rowwise().norm();
  // |2 (m_i - m_j)' X_c| with X_c the robot's centred path.
  const Points centered = robot.rowwise() - robot.colwise().mean();
  const Points image = 2.0 * landmarks * (centered.transpose() * centered).llt().matrixL();
  const Proximities result = proximities(history(Sensor::kRange, ranges), 60);
  EXPECT_LT(
      (result.squared_distances.cwiseSqrt() - test::distances_of(image)).cwiseAbs().maxCoeff(),
      1e-7);
}

TEST(Proximities, UseTheCommonStepsOfEachPairAndScaleThem) {
  Eigen::MatrixXd ranges(3, 4);
  ranges << 1, 2, 3, kMissing,  //
      2, 2, kMissing, 5,        //
      kMissing, kMissing, kMissing, 1;
  Eigen::MatrixXd angles = ranges / 3.0;
  const Proximities result = proximities(history(Sensor::kBearing, angles), 4);
  const double first = std::pow(2.0 * std::sin((2.0 - 1.0) / 6.0), 2);  // steps 1 and 2 are common
  EXPECT_NEAR(result.squared_distances(0, 1), 4.0 / 2.0 * first, 1e-12);
  EXPECT_TRUE(std::isinf(result.squared_distances(0, 2)));
}

TEST(Proximities, OfVisibilityWithMissingDataArePairwiseComplete) {
  Eigen::MatrixXd seen(2, 4);
  seen << 1, 1, 0, 1,  //
      1, 0, 1, kMissing;
  const Proximities result = proximities(history(Sensor::kVisibility, seen), 4);
  EXPECT_NEAR(result.inner_products(0, 1), 1.0 / 2.0, 1e-15);  // (1,1,0) against (1,0,1)
}

TEST(Proximities, OfThePrefixAreThoseOfAShorterHistory) {
  Eigen::MatrixXd angles = Eigen::MatrixXd::NullaryExpr(5, 20, [](Eigen::Index i, Eigen::Index j) {
    return std::sin(static_cast<double>(7 * i + 3 * j * j));
  });
  EXPECT_EQ(proximities(history(Sensor::kBearing, angles), 12).squared_distances,
            proximities(history(Sensor::kBearing, angles.leftCols(12)), 12).squared_distances);
  EXPECT_THROW(proximities(history(Sensor::kBearing, angles), 21), InvalidInput);
  EXPECT_THROW(proximities(history(Sensor::kBearing, angles), 0), InvalidInput);
}

/// Entries from 0 to 1, some of them missing.
Eigen::MatrixXd random_values(Eigen::Index rows, Eigen::Index steps, double missing) {
  Random random(11);
  return Eigen::MatrixXd::NullaryExpr(rows, steps, [&](Eigen::Index, Eigen::Index) {
    const double value = random.uniform();
    return random.uniform() < missing ? kMissing : value;
  });
}

TEST(Proximities, OfBitsAreThoseOfTheirProductsToTheBit) {
  for (const Eigen::Index steps : {1, 63, 64, 65, 300})
    for (const double missing : {0.0, 0.3}) {
      const Eigen::MatrixXd values = random_values(37, steps, missing);
      const Eigen::MatrixXd bits =
          values.array().isNaN().select(values, values.array().round().matrix());
      const ObservationHistory seen = history(Sensor::kVisibility, bits);
      const Proximities expected = proximities(features(seen, steps), Sensor::kVisibility);
      const Proximities counted = proximities(seen, steps);
      EXPECT_EQ(counted.inner_products, expected.inner_products) << steps << " " << missing;
      EXPECT_EQ(counted.squared_distances, expected.squared_distances) << steps << " " << missing;
    }
}

TEST(Proximities, OfManyStepsAreThoseOfAllVectorsAtOnce) {
  for (const double missing : {0.0, 0.2}) {
    const ObservationHistory many = history(Sensor::kBearing, random_values(9, 9000, missing));
    const Eigen::MatrixXd expected =
        proximities(features(many, 9000), Sensor::kBearing).squared_distances;
    EXPECT_LT((proximities(many, 9000).squared_distances - expected).norm(),
              1e-12 * expected.norm());
  }
}

TEST(Proximities, AreFiniteWhereMissingEntriesBeginLate) {
  Eigen::MatrixXd angles = random_values(4, 9000, 0.0);
  angles(2, 8999) = kMissing;
  EXPECT_TRUE(proximities(history(Sensor::kBearing, angles), 9000).squared_distances.allFinite());
}

TEST(UnseenLandmarks, AreRowsWithoutInformation) {
  Eigen::MatrixXd seen(4, 3);
  seen << 0, 0, 1,  //
      0, 0, 0,      //
      kMissing, kMissing, kMissing, kMissing, 0, 0;
  EXPECT_EQ(unseen_landmarks(history(Sensor::kVisibility, seen), 3),
            (std::vector<Eigen::Index>{1, 2, 3}));
  EXPECT_EQ(unseen_landmarks(history(Sensor::kVisibility, seen), 2),
            (std::vector<Eigen::Index>{0, 1, 2, 3}));
  EXPECT_EQ(unseen_landmarks(history(Sensor::kRange, seen), 3), (std::vector<Eigen::Index>{2}));
}

}  // namespace
}  // namespace mapproof
