// Slow: how often a landmark that stands still is reported as moved, and how often one that moved
// is found. Prints the numbers of docs/methods/measurements.md.
#include <algorithm>
#include <cmath>
#include <iostream>
#include <numbers>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "core/association/moved.hpp"
#include "core/base/angle.hpp"
#include "core/base/random.hpp"
#include "noisy_scans.hpp"

namespace mapproof::test {
namespace {

constexpr int kScans = 3000;
constexpr int kStill = 200;  ///< Logs in which nothing moves.
constexpr int kMoves = 50;   ///< Logs of each length of move.

/// The errors of a robot's sensor.
struct SensorErrors {
  const char* name;
  double measurement_share = 0.02;  ///< Of a range, independent for each detection.
  double common_share = 0.0;        ///< Of all ranges of some 100 scans alike.
  double bearing_rad = 0.0175;      ///< Independent for each detection.
};

/// A move of one landmark from a scan on; none: of no length.
struct Move {
  int landmark = 0;
  int from = 0;
  Eigen::RowVector2d by_m = Eigen::RowVector2d::Zero();
};

/// A robot that drives straight from one random position to the next, .1 m per scan, and sees
/// landmarks within 5 m and 35 degrees of its heading.
DetectionLog driven_scans(const SensorErrors& errors, const Move& move, Random& random) {
  const Points landmarks = noisy_landmarks();
  const Eigen::RowVector2d low = landmarks.colwise().minCoeff();
  const Eigen::RowVector2d extent = landmarks.colwise().maxCoeff() - low;
  const auto somewhere = [&] {
    return Eigen::RowVector2d(low.x() + random.uniform() * extent.x(),
                              low.y() + random.uniform() * extent.y());
  };
  DetectionLog log;
  for (int i = 0; i < landmarks.rows(); ++i) log.names.push_back(std::to_string(i));
  Eigen::RowVector2d position = somewhere();
  Eigen::RowVector2d goal = somewhere();
  double common = random.normal();
  for (log.steps = 0; log.steps < kScans; ++log.steps) {
    while ((goal - position).norm() < 0.1) goal = somewhere();
    const Eigen::RowVector2d ahead = (goal - position).normalized();
    const double heading = std::atan2(ahead.y(), ahead.x());
    position += 0.1 * ahead;
    common = 0.99 * common + std::sqrt(1.0 - 0.99 * 0.99) * random.normal();
    for (int i = 0; i < landmarks.rows(); ++i) {
      Eigen::RowVector2d to = landmarks.row(i) - position;
      if (i == move.landmark && log.steps >= move.from) to += move.by_m;
      const double bearing = wrapped(std::atan2(to.y(), to.x()) - heading);
      if (to.norm() > 5.0 || std::abs(bearing) > 35.0 / 180.0 * std::numbers::pi) continue;
      const double error =
          errors.measurement_share * random.normal() + errors.common_share * common;
      log.detections.push_back({.step = log.steps,
                                .landmark = i,
                                .range_m = std::abs(to.norm() * (1.0 + error)),
                                .bearing_rad = bearing + errors.bearing_rad * random.normal()});
    }
  }
  return log;
}

class MovedRates : public testing::TestWithParam<SensorErrors> {};

TEST_P(MovedRates, FewStandStillAndAreReported) {
  int named = 0;
  int named_at_any_length = 0;
  for (std::uint64_t k = 0; k < kStill; ++k) {
    Random random(derive_seed(1, {k}));
    const DetectionLog log = driven_scans(GetParam(), {}, random);
    named += find_moved(log).moved.empty() ? 0 : 1;
    named_at_any_length += find_moved(log, {.least_move = 0.0}).moved.empty() ? 0 : 1;
  }
  std::cout << fmt::format("{}: of {} logs in which nothing moves {} name one, {} at any length\n",
                           GetParam().name, kStill, named, named_at_any_length);
  EXPECT_LE(named, named_at_any_length);
  // 5 % and three standard deviations.
  EXPECT_LE(named, 0.05 * kStill + 3.0 * std::sqrt(0.05 * 0.95 * kStill));
}

TEST_P(MovedRates, MostThatMoveFarAreReported) {
  for (const double length : {0.1, 0.2, 0.5, 1.0, 2.0}) {
    int named = 0;
    int others = 0;
    double off_m = 0.0;
    for (std::uint64_t k = 0; k < kMoves; ++k) {
      Random random(derive_seed(2, {k, static_cast<std::uint64_t>(1000.0 * length)}));
      const double angle = 2.0 * std::numbers::pi * random.uniform();
      const Move move{static_cast<int>(15.0 * random.uniform()),
                      static_cast<int>(kScans * random.uniform(0.25, 0.75)),
                      {length * std::cos(angle), length * std::sin(angle)}};
      const MovedCheck check = find_moved(driven_scans(GetParam(), move, random));
      bool is_named = false;
      bool is_other = false;
      for (const MovedLandmark& moved : check.moved) {
        (moved.landmark == move.landmark ? is_named : is_other) = true;
        if (moved.landmark == move.landmark) off_m += std::abs(moved.distance_m - length);
      }
      named += is_named ? 1 : 0;
      others += is_other ? 1 : 0;
    }
    std::cout << fmt::format("{}: {:g} m: {} of {} named, length {:.3f} m off, another in {}\n",
                             GetParam().name, length, named, kMoves, off_m / std::max(1, named),
                             others);
    if (length >= 1.0) {
      EXPECT_GE(named, 0.9 * kMoves) << length;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(
    Moved, MovedRates,
    testing::Values(SensorErrors{.name = "errors of each detection alone"},
                    SensorErrors{.name = "errors in common", .common_share = 0.03}),
    [](const auto& one) { return one.param.common_share > 0.0 ? "common" : "alone"; });

}  // namespace
}  // namespace mapproof::test
