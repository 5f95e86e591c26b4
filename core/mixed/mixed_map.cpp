#include "core/mixed/mixed_map.hpp"

#include <algorithm>
#include <limits>
#include <optional>

#include <fmt/format.h>

#include "core/base/errors.hpp"
#include "core/mixed/joint_map.hpp"
#include "core/mixed/mixed_distances.hpp"

namespace mapproof {
namespace {

constexpr double kInfinite = std::numeric_limits<double>::infinity();
using Rows = std::vector<Eigen::Index>;

void check(const std::vector<ObservationHistory>& histories, Eigen::Index steps) {
  if (histories.empty()) throw InvalidInput("a map of several sensors needs one or more");
  for (std::size_t a = 0; a < histories.size(); ++a) {
    require_steps(histories[a], steps > 0 ? steps : histories[a].steps());
    if (histories[a].names != histories.front().names)
      throw InvalidInput("several sensors must have observed the same landmarks");
    for (std::size_t b = 0; b < a; ++b)
      if (histories[a].sensor == histories[b].sensor)
        throw InvalidInput(fmt::format("{} is there twice", name(histories[a].sensor)));
  }
}

Eigen::MatrixXd squared_of(const ObservationHistory& history) {
  Eigen::MatrixXd D = proximities(history, history.steps()).squared_distances;
  for (const Eigen::Index row : unseen_landmarks(history, history.steps())) {
    D.row(row).setConstant(kInfinite);
    D.col(row).setConstant(kInfinite);
    D(row, row) = 0.0;
  }
  return D;
}

/// Rows that some sensor knows something of.
Rows known_rows(const std::vector<Eigen::MatrixXd>& squared) {
  Rows rows;
  for (Eigen::Index i = 0; i < squared.front().rows(); ++i)
    if (std::ranges::any_of(squared, [&](const Eigen::MatrixXd& D) {
          return D.row(i).array().isFinite().count() > 1;
        }))
      rows.push_back(i);
  return rows;
}

Points spread(const Points& some, const Rows& rows, Eigen::Index all) {
  Points points = Points::Constant(all, 2, std::numeric_limits<double>::quiet_NaN());
  points(rows, Eigen::all) = some;
  return points;
}

Rows mapped_rows(const Embedding& map) {
  Rows rows;
  for (Eigen::Index i = 0; i < map.coordinates.rows(); ++i)
    if (map.coordinates.row(i).allFinite()) rows.push_back(i);
  return rows;
}

/// A joint map of some of the landmarks, the others left out of it.
JointMap joint_of(const std::vector<Eigen::MatrixXd>& distances, const Points& start,
                  const Rows& rows) {
  std::vector<Eigen::MatrixXd> some;
  for (const Eigen::MatrixXd& one : distances) some.emplace_back(one(rows, rows));
  JointMap map = joint_map(some, start(rows, Eigen::all));
  map.embedding.coordinates = spread(map.embedding.coordinates, rows, start.rows());
  return map;
}

bool is_point(const Points& map, const Rows& rows) {
  return (map(rows, Eigen::all).rowwise() - map.row(rows.front())).isZero(0.0);
}

MixedSensor alone(const ObservationHistory& history, MethodSetting setting,
                  const EmbedderOptions& options) {
  MixedSensor result{
      .sensor = history.sensor, .setting = setting, .own = {}, .by_order = {}, .distances = {}};
  HistoryEmbedder embedder(history, history.steps(), options);
  if (!setting.parameter) result.setting = embedder.usual_setting(setting.method);
  result.own = embedder.embed(result.setting);
  result.distances = squared_of(history).cwiseSqrt();
  result.reliability = reliability(history, history.steps());
  const Rows rows = mapped_rows(result.own);
  if (rows.size() >= 3 && !is_point(result.own.coordinates, rows))
    result.by_order = joint_of({result.distances}, result.own.coordinates, rows).embedding;
  return result;
}

Embedding too_few(Eigen::Index landmarks) {
  Embedding result;
  result.coordinates.setConstant(landmarks, 2, std::numeric_limits<double>::quiet_NaN());
  result.statuses.push_back(status_of<StatusReason::kTooFewLandmarks>(landmarks));
  return result;
}

/// The map of the mean distances, of the rows alone.
Embedding start_of(const std::vector<Eigen::MatrixXd>& squared, const std::vector<double>& weights,
                   const Rows& rows, MethodSetting& setting, const EmbedderOptions& options) {
  if (rows.size() < 3) return too_few(std::ssize(rows));
  std::vector<Eigen::MatrixXd> some;
  for (const Eigen::MatrixXd& D : squared) some.emplace_back(D(rows, rows));
  Embedder embedder(mixed_proximities(some, weights), options);
  if (!setting.parameter) setting = embedder.usual_setting(setting.method);
  return embedder.embed(setting);
}

/// The joint map of the rows, from the mean distances' map and each sensor's own by order; empty if
/// none of them places all the rows.
std::optional<JointMap> joint_from_all(const std::vector<Eigen::MatrixXd>& distances,
                                       const Embedding& mean,
                                       const std::vector<MixedSensor>& sensors, const Rows& rows) {
  std::vector<Points> starts;
  const auto add = [&](const Embedding& start) {
    if (rows.size() >= 3 && mapped_rows(start) == rows && !is_point(start.coordinates, rows))
      starts.emplace_back(start.coordinates(rows, Eigen::all));
  };
  add(mean);
  for (const MixedSensor& sensor : sensors) add(sensor.by_order);
  if (starts.empty()) return std::nullopt;
  std::vector<Eigen::MatrixXd> known;
  for (const Eigen::MatrixXd& one : distances) known.emplace_back(one(rows, rows));
  JointMap best = best_joint_map(known, starts);
  best.embedding.coordinates = spread(best.embedding.coordinates, rows, distances.front().rows());
  return best;
}

}  // namespace

MixedMap mixed_map(const std::vector<ObservationHistory>& histories, Eigen::Index steps,
                   const MethodSetting& setting, const EmbedderOptions& options,
                   const std::vector<MethodSetting>& own) {
  check(histories, steps);
  if (!own.empty() && own.size() != histories.size())
    throw InvalidInput(fmt::format("{} settings for {} sensors", own.size(), histories.size()));
  MixedMap result{.joint = {}, .mean = {}, .setting = setting, .sensors = {}};
  std::vector<Eigen::MatrixXd> distances, squared;
  std::vector<double> reliabilities;
  for (const ObservationHistory& history : histories) {
    ObservationHistory used = history;
    if (steps > 0) used.values = history.values.leftCols(steps);
    result.sensors.push_back(
        alone(used, own.empty() ? setting : own[result.sensors.size()], options));
    distances.push_back(result.sensors.back().distances);
    squared.push_back(distances.back().cwiseAbs2());
    reliabilities.push_back(result.sensors.back().reliability);
  }
  std::vector<double> weights = weights_of(reliabilities);
  // A sensor that tells hardly anything still tells more of its own pairs than nothing does.
  for (double& weight : weights) weight = std::max(weight, 1e-9);
  const Rows rows = known_rows(squared);
  const Eigen::Index M = squared.front().rows();
  result.mean = start_of(squared, weights, rows, result.setting, options);
  result.mean.coordinates = spread(result.mean.coordinates, rows, M);
  result.joint = result.mean;
  const std::optional<JointMap> joint =
      joint_from_all(distances, result.mean, result.sensors, rows);
  if (joint) {
    result.joint.coordinates = joint->embedding.coordinates;
    result.joint.statuses.insert(result.joint.statuses.end(), joint->embedding.statuses.begin(),
                                 joint->embedding.statuses.end());
  }
  for (std::size_t s = 0; s < weights.size(); ++s) {
    result.sensors[s].weight = weights[s];
    if (joint) result.sensors[s].share = joint->shares[s];
  }
  if (const auto unseen = M - std::ssize(rows); unseen > 0)
    result.joint.statuses.push_back(status_of<StatusReason::kNoSensorObserved>(unseen));
  return result;
}

}  // namespace mapproof
