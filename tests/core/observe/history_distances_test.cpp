#include "core/observe/history_distances.hpp"

#include <cmath>
#include <mutex>

#include <gtest/gtest.h>

#include "core/base/errors.hpp"
#include "core/base/random.hpp"
#include "core/observe/proximities.hpp"
#include "core/simulate/sensors.hpp"

namespace mapproof {
namespace {

using Eigen::Index;

/// Values of a sensor, a share of which is missing or, for visibility, not seen.
ObservationHistory drawn(Sensor sensor, Index landmarks, Index steps, double missing,
                         std::uint64_t seed) {
  Random random(seed);
  ObservationHistory history{.sensor = sensor,
                             .names = landmark_names(landmarks),
                             .values = Eigen::MatrixXd(landmarks, steps)};
  for (Index t = 0; t < steps; ++t)
    for (Index i = 0; i < landmarks; ++i) {
      const double value = random.uniform(0.0, 3.0);
      history.values(i, t) = random.uniform() < missing ? NAN : value;
    }
  return history;
}

/// Visibility, a share of which is 1, and a share missing.
ObservationHistory seen(Index landmarks, Index steps, double ones, double missing,
                        std::uint64_t seed) {
  ObservationHistory history = drawn(Sensor::kVisibility, landmarks, steps, missing, seed);
  history.values = history.values.unaryExpr([ones](double value) {
    return std::isnan(value) ? value : value < 3.0 * ones ? 1.0 : 0.0;
  });
  // Each landmark is seen once or more.
  for (Index i = 0; i < landmarks; ++i) history.values(i, i % steps) = 1.0;
  return history;
}

/// All distances as an array. Each pair has to come at both of its landmarks.
Eigen::MatrixXd gathered(const HistoryDistances& from) {
  const Index M = from.landmarks;
  Eigen::MatrixXd D = Eigen::MatrixXd::Constant(M, M, from.distances.others);
  Eigen::MatrixXi times = Eigen::MatrixXi::Zero(M, M);
  std::mutex mutex;
  from.distances.visit([&](Index i, std::span<const Edge> others) {
    const std::lock_guard lock(mutex);
    for (const Edge& edge : others) {
      D(i, edge.to) = edge.length;
      ++times(i, edge.to);
    }
  });
  D.diagonal().setZero();
  EXPECT_TRUE(times.diagonal().isZero());
  EXPECT_LE(times.maxCoeff(), 1);
  EXPECT_EQ(times, Eigen::MatrixXi(times.transpose()));
  return D;
}

void expect_distances_of_proximities(const ObservationHistory& history, Index steps,
                                     Index rows_at_a_time) {
  const Proximities expected = proximities(history, steps);
  const HistoryDistances found = history_distances(history, steps, rows_at_a_time);
  const Eigen::MatrixXd D = gathered(found);
  const Eigen::MatrixXd expected_D = expected.squared_distances.cwiseSqrt();
  ASSERT_EQ(D.array().isInf().cast<int>().matrix(),
            expected_D.array().isInf().cast<int>().matrix());
  const auto finite = expected_D.array().isFinite();
  // Squares are sums of as many terms as there are steps: what cancels is not exact.
  const double size = finite.select(expected_D.array(), 0.0).maxCoeff();
  EXPECT_LT(finite.select(D.cwiseAbs2().array() - expected.squared_distances.array(), 0.0)
                .abs()
                .maxCoeff(),
            1e-12 * size * size);
  EXPECT_EQ(found.apart, std::sqrt(expected.apart_squared));
}

TEST(HistoryDistances, AreThoseOfProximitiesWhateverTheBlocks) {
  for (const Sensor sensor : {Sensor::kBearing, Sensor::kRange, Sensor::kVisibility})
    for (const double missing : {0.0, 0.4, 0.9})
      for (const Index rows : {0, 7, 200}) {
        SCOPED_TRACE(testing::Message() << name(sensor) << ", " << missing << ", " << rows);
        expect_distances_of_proximities(drawn(sensor, 70, 40, missing, 5), 40, rows);
        expect_distances_of_proximities(drawn(sensor, 70, 40, missing, 6), 25, rows);
      }
}

TEST(HistoryDistances, OfBitsAreThoseOfProximitiesHoweverManyAreSeen) {
  for (const double ones : {0.01, 0.05, 0.3, 0.9})
    for (const double missing : {0.0, 0.3}) {
      SCOPED_TRACE(testing::Message() << ones << ", " << missing);
      expect_distances_of_proximities(seen(150, 130, ones, missing, 3), 130, 64);
    }
}

TEST(HistoryDistances, LeaveOutWhatWasNeverSeenTogetherWhereVisibilityIsSparse) {
  const ObservationHistory history = seen(150, 150, 0.01, 0.0, 4);
  const HistoryDistances found = history_distances(history, history.steps());
  EXPECT_EQ(found.distances.others, std::sqrt(2.0));
  std::size_t listed = 0;
  std::mutex mutex;
  found.distances.visit([&](Index, std::span<const Edge> others) {
    const std::lock_guard lock(mutex);
    listed += others.size();
    for (const Edge& edge : others) EXPECT_LT(edge.length, std::sqrt(2.0));
  });
  EXPECT_LT(listed, 150U * 149U / 2U);
}

TEST(HistoryDistances, CountTheGroupsOfLandmarksThatWereSeenTogether) {
  ObservationHistory history{.sensor = Sensor::kVisibility,
                             .names = landmark_names(6),
                             .values = Eigen::MatrixXd::Zero(6, 4)};
  history.values.col(0) << 1, 1, 0, 0, 0, 0;
  history.values.col(1) << 0, 1, 1, 0, 0, 0;
  history.values.col(2) << 0, 0, 0, 1, 1, 0;
  history.values.col(3) << 0, 0, 0, 0, 0, 1;
  EXPECT_EQ(history_distances(history, 4).groups, 3);
  history.values(5, 0) = NAN;
  EXPECT_EQ(history_distances(history, 4).groups, 3);
}

TEST(VisibilityDistances, AreThoseOfTheArrayOfALog) {
  DetectionLog log{.names = landmark_names(40), .steps = 60};
  Random random(9);
  for (int t = 0; t < 60; ++t)
    for (int i = 0; i < 40; ++i)
      if (random.uniform() < 0.1 || i == t) log.detections.push_back({.step = t, .landmark = i});
  const ObservationHistory history = history_of(log, Sensor::kVisibility);
  EXPECT_LT(
      (gathered(visibility_distances(log)) - proximities(history, 60).squared_distances.cwiseSqrt())
          .cwiseAbs()
          .maxCoeff(),
      1e-14);
  log.detections.push_back({.step = 60, .landmark = 0});
  EXPECT_THROW(visibility_distances(log), InvalidInput);
}

}  // namespace
}  // namespace mapproof
