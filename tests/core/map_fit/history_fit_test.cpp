#include "core/map_fit/map_fit.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "core/base/not_finite.hpp"
#include "core/base/random.hpp"
#include "tests/support/samples/worlds.hpp"

namespace mapproof {
namespace {

constexpr int kSteps = 900;

/// What a robot observes that drives about among landmarks in a room of 5 m.
ObservationHistory driven(Sensor sensor, const Points& landmarks, std::uint64_t seed) {
  Random random(seed);
  ObservationHistory history{.sensor = sensor, .names = {}, .values = {}};
  for (Eigen::Index k = 0; k < landmarks.rows(); ++k)
    history.names.push_back("L" + std::to_string(k));
  history.values.resize(landmarks.rows(), kSteps);
  Eigen::RowVector2d at(2.5, 2.5);
  double heading = 0.0;
  for (Eigen::Index step = 0; step < kSteps; ++step) {
    heading += 0.8 * (random.uniform() - 0.5);
    Eigen::RowVector2d next;
    do {
      next = at + 0.12 * Eigen::RowVector2d(std::cos(heading), std::sin(heading));
      if ((next.array() < 0.2).any() || (next.array() > 4.8).any())
        heading = 6.28 * random.uniform();
    } while ((next.array() < 0.2).any() || (next.array() > 4.8).any());
    at = next;
    for (Eigen::Index k = 0; k < landmarks.rows(); ++k) {
      const Eigen::RowVector2d to = landmarks.row(k) - at;
      const double bearing = std::remainder(std::atan2(to.y(), to.x()) - heading, 6.283185307);
      const double noise = 0.05 * (random.uniform() - 0.5);
      history.values(k, step) = sensor == Sensor::kRange                     ? to.norm() + noise
                                : sensor == Sensor::kBearing                 ? bearing + noise
                                : to.norm() < 2.0 && std::abs(bearing) < 1.0 ? 1.0
                                                                             : 0.0;
    }
  }
  return history;
}

Points room(std::uint64_t seed) {
  Random random(seed);
  Points landmarks(30, 2);
  for (Eigen::Index k = 0; k < landmarks.size(); ++k) landmarks(k) = 0.1 + 4.8 * random.uniform();
  return landmarks;
}

Fit fit_of(const ObservationHistory& history, const Points& map, const Points& known_m) {
  return history_fit(history, history.steps(), map, known_m);
}

class HistoryFit : public testing::TestWithParam<Sensor> {};

TEST_P(HistoryFit, FitsASoundWorld) {
  for (const std::uint64_t seed : {1, 2, 3, 4, 5}) {
    const Points landmarks = room(seed);
    const Fit fit = fit_of(driven(GetParam(), landmarks, seed), landmarks, landmarks);
    EXPECT_EQ(fit.verdict, FitVerdict::kFits) << seed;
  }
}

TEST_P(HistoryFit, NamesTwoIdsThatAreExchangedHalfWay) {
  for (const std::uint64_t seed : {1, 2, 3, 4, 5}) {
    const Points landmarks = room(seed);
    ObservationHistory history = driven(GetParam(), landmarks, seed);
    Eigen::Index other = 1;
    while ((landmarks.row(other) - landmarks.row(0)).norm() < 2.0) ++other;
    const Eigen::MatrixXd first = history.values.row(0).tail(kSteps / 2);
    const Eigen::MatrixXd second = history.values.row(other).tail(kSteps / 2);
    history.values.row(0).tail(kSteps / 2) = second;
    history.values.row(other).tail(kSteps / 2) = first;
    const Fit fit = fit_of(history, landmarks, landmarks);
    EXPECT_EQ(fit.verdict, FitVerdict::kDoesNotFit) << seed;
    ASSERT_FALSE(fit.causes.empty());
    EXPECT_EQ(fit.causes[0].code, FitCode::kIdsExchanged);
    EXPECT_EQ(fit.causes[0].landmarks,
              (std::vector<std::string>{"L0", "L" + std::to_string(other)}));
  }
}

INSTANTIATE_TEST_SUITE_P(EverySensor, HistoryFit,
                         testing::Values(Sensor::kVisibility, Sensor::kBearing, Sensor::kRange),
                         [](const auto& one) { return std::string(name(one.param)); });

TEST(HistoryFitKnown, NamesAnExchangeAndAPositionThatIsOff) {
  const Points landmarks = room(6);
  const ObservationHistory history = driven(Sensor::kBearing, landmarks, 6);
  Points map = landmarks;
  Random random(9);
  for (Eigen::Index k = 0; k < map.size(); ++k) map(k) += 0.1 * (random.uniform() - 0.5);
  Points off = landmarks;
  off.row(4) += Eigen::RowVector2d(1.5, -1.5);
  Fit fit = fit_of(history, map, off);
  ASSERT_FALSE(fit.causes.empty());
  EXPECT_EQ(fit.causes[0].code, FitCode::kKnownLandmarkOff);
  EXPECT_EQ(fit.causes[0].landmarks, (std::vector<std::string>{"L4"}));
  Eigen::Index other = 1;
  while ((landmarks.row(other) - landmarks.row(0)).norm() < 2.0) ++other;
  Points exchanged = landmarks;
  exchanged.row(0).swap(exchanged.row(other));
  fit = fit_of(history, map, exchanged);
  ASSERT_FALSE(fit.causes.empty());
  EXPECT_EQ(fit.causes[0].code, FitCode::kKnownLandmarksExchanged);
}

TEST(HistoryFit, CannotBeTestedOverAFewSteps) {
  const Points landmarks = room(7);
  ObservationHistory history = driven(Sensor::kBearing, landmarks, 7);
  const Fit fit = history_fit(history, 20, landmarks, landmarks);
  EXPECT_EQ(fit.verdict, FitVerdict::kNotTestable);
  EXPECT_FALSE(fit.why.empty());
}

}  // namespace
}  // namespace mapproof
