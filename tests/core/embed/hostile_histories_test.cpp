// Histories of every sensor that no map should come of, or whose numbers are at the ends of what a
// double holds, by every method.
#include <cmath>
#include <limits>
#include <vector>

#include <gtest/gtest.h>

#include "core/embed/embedder.hpp"
#include "core/model/observation_history.hpp"
#include "core/observe/proximities.hpp"
#include "tests/support/samples/worlds.hpp"
#include "tests/support/statuses.hpp"

namespace mapproof {
namespace {

/// A history with a name for what is wrong with it.
struct HostileHistory {
  std::string what;
  ObservationHistory history;
};

ObservationHistory history_of(Sensor sensor, Eigen::MatrixXd values) {
  ObservationHistory history{.sensor = sensor, .names = {}, .values = std::move(values)};
  for (Eigen::Index i = 0; i < history.landmarks(); ++i)
    history.names.push_back("L" + std::to_string(i));
  return history;
}

/// Values of a sensor that would give a map: 12 landmarks, 40 steps.
Eigen::MatrixXd usual_values(Sensor sensor) {
  const Points landmarks = test::scattered(12, 3), robot = test::scattered(40, 5);
  Eigen::MatrixXd values(12, 40);
  for (Eigen::Index i = 0; i < 12; ++i)
    for (Eigen::Index k = 0; k < 40; ++k) {
      const Eigen::RowVector2d way = landmarks.row(i) - robot.row(k);
      values(i, k) = sensor == Sensor::kRange     ? way.norm()
                     : sensor == Sensor::kBearing ? std::atan2(way.y(), way.x())
                                                  : (way.norm() < 0.5 ? 1.0 : 0.0);
    }
  return values;
}

std::vector<HostileHistory> hostile_histories(Sensor sensor) {
  const Eigen::MatrixXd usual = usual_values(sensor);
  std::vector<HostileHistory> all;
  const auto add = [&](const char* what, const Eigen::MatrixXd& values) {
    all.push_back({what, history_of(sensor, values)});
  };
  add("one landmark", usual.topRows(1));
  add("two landmarks", usual.topRows(2));
  add("one step", usual.leftCols(1));
  add("constant columns", usual.row(0).replicate(12, 1));
  add("constant rows", usual.col(0).replicate(1, 40));
  add("all zero", Eigen::MatrixXd::Zero(12, 40));
  add("all one", Eigen::MatrixXd::Ones(12, 40));
  add("nothing observed", Eigen::MatrixXd::Constant(12, 40, kNaN));
  Eigen::MatrixXd pairs = usual, sparse = Eigen::MatrixXd::Constant(12, 40, kNaN);
  for (Eigen::Index i = 0; i < 12; i += 2) pairs.row(i + 1) = pairs.row(i);
  add("each landmark twice", pairs);
  for (Eigen::Index i = 0; i < 12; ++i) sparse(i, i) = usual(i, i);
  add("no step in common", sparse);
  if (sensor == Sensor::kVisibility) return all;
  for (const double scale : {1e300, 1e-300, 1e154, 1e-154, 5e-324, 1.7e308})
    all.push_back(
        {"times " + std::to_string(std::log10(scale)), history_of(sensor, scale * usual)});
  Eigen::MatrixXd mixed = usual;
  mixed.row(0) *= 1e300;
  mixed.row(1) *= 1e-300;
  add("one landmark at 1e300", mixed);
  return all;
}

/// Settings that a user may give: the usual one and the ends.
std::vector<MethodSetting> settings_of(const MethodInfo& method) {
  if (!method.parameter) return {{method.method, std::nullopt}};
  std::vector<MethodSetting> settings;
  for (const double value : {method.parameter->minimum, 11.0, 12.0, 5000.0})
    if (value <= method.parameter->maximum) settings.push_back({method.method, value});
  return settings;
}

class HostileHistories : public ::testing::TestWithParam<MethodInfo> {};

TEST_P(HostileHistories, GiveFinitePositionsOrAReason) {
  for (const Sensor sensor : {Sensor::kVisibility, Sensor::kBearing, Sensor::kRange})
    for (const HostileHistory& one : hostile_histories(sensor)) {
      HistoryEmbedder embedder(one.history, one.history.steps());
      for (const MethodSetting& setting : settings_of(GetParam())) {
        SCOPED_TRACE(testing::Message() << name(sensor) << ", " << one.what << ", "
                                        << setting.parameter.value_or(kNaN));
        const Embedding map = embedder.embed(setting);
        ASSERT_EQ(map.coordinates.rows(), one.history.landmarks());
        EXPECT_FALSE(map.coordinates.array().isInf().any());
        if (!map.coordinates.allFinite()) {
          EXPECT_FALSE(map.statuses.empty());
        }
      }
    }
}

INSTANTIATE_TEST_SUITE_P(OfMethods, HostileHistories, ::testing::ValuesIn(all_methods()),
                         [](const auto& one) {
                           std::string name(one.param.name);
                           std::erase_if(name,
                                         [](unsigned char c) { return std::isalnum(c) == 0; });
                           return name;
                         });

}  // namespace
}  // namespace mapproof
