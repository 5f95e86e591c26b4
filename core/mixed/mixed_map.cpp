#include "core/mixed/mixed_map.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include <fmt/format.h>

#include "core/base/errors.hpp"
#include "core/base/not_finite.hpp"
#include "core/embed/smacof.hpp"
#include "core/graph/components.hpp"
#include "core/mixed/mixed_distances.hpp"

namespace mapproof {
namespace {

constexpr double kLeastVariance = 1e-4;  ///< In the map's mean square distance from its centre.

struct Pair {
  Eigen::Index i;
  Eigen::Index j;
};

/// The pairs that a sensor knows, nearest first.
std::vector<Pair> sorted_pairs(const Eigen::MatrixXd& distances) {
  std::vector<Pair> pairs;
  for (Eigen::Index j = 0; j < distances.cols(); ++j)
    for (Eigen::Index i = j + 1; i < distances.rows(); ++i)
      if (std::isfinite(distances(i, j))) pairs.push_back({i, j});
  std::ranges::stable_sort(pairs, {}, [&](const Pair& pair) { return distances(pair.i, pair.j); });
  return pairs;
}

/// One sensor's estimate of its pairs on the map's scale: expected distance and its variance.
struct Voice {
  std::vector<double> expected;
  std::vector<double> variance;
};

/// @param pairs  Sorted by the sensor's distances; equal ones have their mean, so that their order
///               does not matter.
Voice voice_of(const std::vector<Pair>& pairs, const Eigen::MatrixXd& distances, const Points& map,
               double least_variance) {
  std::vector<double> here;
  for (const Pair& pair : pairs) here.push_back((map.row(pair.i) - map.row(pair.j)).norm());
  std::vector<double> level = here;
  for (std::size_t first = 0; first < pairs.size();) {
    std::size_t end = first;
    double sum = 0.0;
    const double delta = distances(pairs[first].i, pairs[first].j);
    for (; end < pairs.size() && distances(pairs[end].i, pairs[end].j) == delta; ++end)
      sum += here[end];
    std::fill(level.begin() + static_cast<std::ptrdiff_t>(first),
              level.begin() + static_cast<std::ptrdiff_t>(end),
              sum / static_cast<double>(end - first));
    first = end;
  }
  Voice voice{.expected = increasing_fit(level), .variance = std::vector<double>(pairs.size())};
  // The variance of a pair is that of the tenth of the pairs about it.
  const std::size_t half = std::max<std::size_t>(5, pairs.size() / 20);
  std::vector<double> sums(pairs.size() + 1, 0.0);
  for (std::size_t k = 0; k < pairs.size(); ++k)
    sums[k + 1] = sums[k] + (here[k] - voice.expected[k]) * (here[k] - voice.expected[k]);
  for (std::size_t k = 0; k < pairs.size(); ++k) {
    const std::size_t low = k > half ? k - half : 0, high = std::min(pairs.size(), k + half + 1);
    voice.variance[k] =
        std::max((sums[high] - sums[low]) / static_cast<double>(high - low), least_variance);
  }
  return voice;
}

void check(const std::vector<Eigen::MatrixXd>& distances, const Points& start,
           const JointMapOptions& options) {
  const Eigen::Index M = start.rows();
  if (distances.empty() || M < 3 || options.rounds < 1 || !start.allFinite())
    throw InvalidInput("a joint map needs sensors, three landmarks, a round and a finite start");
  for (const Eigen::MatrixXd& one : distances)
    if (one.rows() != M || one.cols() != M || one.array().isNaN().any())
      throw InvalidInput("a joint map needs the distances of all its landmarks");
}

/// Whether pairs that some sensor knows tie all landmarks together.
bool connected(const std::vector<Eigen::MatrixXd>& distances) {
  Graph graph(static_cast<std::size_t>(distances.front().rows()));
  for (Eigen::Index j = 0; j < distances.front().cols(); ++j)
    for (Eigen::Index i = 0; i < distances.front().rows(); ++i)
      if (i != j && std::ranges::any_of(distances, [&](const Eigen::MatrixXd& one) {
            return std::isfinite(one(i, j));
          }))
        graph[static_cast<std::size_t>(j)].push_back({i, 1.0});
  return std::ranges::max(components(graph)) == 0;
}

/// Mean square distance from the centre.
double size_of(const Points& map) {
  return (map.rowwise() - map.colwise().mean()).squaredNorm() / static_cast<double>(map.rows());
}

using Rows = std::vector<Eigen::Index>;

void check(const std::vector<ObservationHistory>& histories, Eigen::Index steps) {
  if (histories.empty()) throw InvalidInput("a map of several sensors needs one or more");
  for (std::size_t a = 0; a < histories.size(); ++a) {
    require_steps(histories[a], steps > 0 ? steps : histories[a].steps());
    if (histories[a].names != histories.front().names)
      throw InvalidInput("several sensors must have observed the same landmarks");
    for (std::size_t b = 0; b < a; ++b)
      if (histories[a].sensor == histories[b].sensor)
        throw InvalidInput(fmt::format("the sensor {} is given twice", name(histories[a].sensor)));
  }
}

Eigen::MatrixXd squared_of(const ObservationHistory& history) {
  Eigen::MatrixXd D = proximities(history, history.steps()).squared_distances;
  for (const Eigen::Index row : unseen_landmarks(history, history.steps())) {
    D.row(row).setConstant(kInfinity);
    D.col(row).setConstant(kInfinity);
    D(row, row) = 0.0;
  }
  return D;
}

/// Rows that some sensor has data of.
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
  Points points = Points::Constant(all, 2, kNaN);
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
  result.coordinates.setConstant(landmarks, 2, kNaN);
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
/// none of them maps all the rows.
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

std::vector<double> increasing_fit(const std::vector<double>& values) {
  struct Block {
    double sum;
    std::size_t count;
    double mean() const { return sum / static_cast<double>(count); }
  };
  std::vector<Block> blocks;
  for (const double value : values) {
    blocks.push_back({value, 1});
    while (blocks.size() > 1 && blocks[blocks.size() - 2].mean() >= blocks.back().mean()) {
      const Block last = blocks.back();
      blocks.pop_back();
      blocks.back().sum += last.sum;
      blocks.back().count += last.count;
    }
  }
  std::vector<double> fit;
  for (const Block& block : blocks) fit.insert(fit.end(), block.count, block.mean());
  return fit;
}

double order_misfit(const std::vector<Eigen::MatrixXd>& distances, const Points& map) {
  check(distances, map, {});
  const Points centred = map.rowwise() - map.colwise().mean();
  const double size = size_of(centred);
  if (!(size > 0.0)) throw InvalidInput("a map that is a point has no order of distances");
  double sum = 0.0, count = 0.0;
  for (const Eigen::MatrixXd& one : distances) {
    const Voice voice = voice_of(sorted_pairs(one), one, centred, kLeastVariance * size);
    for (const double variance : voice.variance) sum += 0.5 * std::log(variance / size);
    count += static_cast<double>(voice.variance.size());
  }
  return count > 0.0 ? sum / count : 0.0;
}

JointMap joint_map(const std::vector<Eigen::MatrixXd>& distances, const Points& start,
                   const JointMapOptions& options) {
  check(distances, start, options);
  const Eigen::Index M = start.rows();
  std::vector<std::vector<Pair>> pairs;
  for (const Eigen::MatrixXd& one : distances) pairs.push_back(sorted_pairs(one));
  JointMap result{.embedding = Embedding{}, .shares = std::vector<double>(distances.size(), 0.0)};
  if (!connected(distances)) {
    result.embedding.coordinates.setConstant(M, 2, kNaN);
    result.embedding.statuses.push_back(status_of<StatusReason::kNoSensorShares>());
    return result;
  }
  Points map = start.rowwise() - start.colwise().mean();
  const double size = size_of(map);
  if (!(size > 0.0)) throw InvalidInput("a joint map needs a start that is not a point");
  for (int round = 0; round < options.rounds; ++round) {
    Eigen::MatrixXd sum = Eigen::MatrixXd::Zero(M, M), weights = Eigen::MatrixXd::Zero(M, M);
    for (std::size_t s = 0; s < distances.size(); ++s) {
      const Voice voice = voice_of(pairs[s], distances[s], map, kLeastVariance * size);
      result.shares[s] = 0.0;
      for (std::size_t k = 0; k < pairs[s].size(); ++k) {
        const auto [i, j] = pairs[s][k];
        const double weight = size / voice.variance[k];
        sum(i, j) += weight * voice.expected[k];
        weights(i, j) += weight;
        result.shares[s] += weight;
      }
    }
    const Eigen::MatrixXd means =
        (weights.array() > 0.0).select(sum.array() / weights.array(), 0.0);
    result.embedding = smacof(means + means.transpose(), weights + weights.transpose(), map,
                              {.relative_fall = 1e-3, .max_iterations = 10});
    // Monotone regression lets the map shrink: its size is free and kept.
    const double now = size_of(result.embedding.coordinates);
    if (!(now > 0.0)) break;
    map = std::sqrt(size / now) * result.embedding.coordinates;
  }
  // Rounds decide when to stop: a SMACOF that did not converge within a round is not a problem.
  std::erase_if(result.embedding.statuses,
                [](const Status& one) { return one.code == StatusCode::kNotConverged; });
  result.embedding.coordinates = map;
  double total = 0.0;
  for (const double share : result.shares) total += share;
  for (double& share : result.shares) share /= total;
  return result;
}

JointMap best_joint_map(const std::vector<Eigen::MatrixXd>& distances,
                        const std::vector<Points>& starts, const JointMapOptions& options) {
  if (starts.empty()) throw InvalidInput("a joint map needs a start");
  JointMap best;
  double least = kInfinity;
  for (const Points& start : starts) {
    JointMap map = joint_map(distances, start, options);
    const Points& positions = map.embedding.coordinates;
    const bool has_order =
        positions.allFinite() && size_of(positions.rowwise() - positions.colwise().mean()) > 0.0;
    const double misfit = has_order ? order_misfit(distances, positions) : HUGE_VAL;
    if (!best.shares.empty() && misfit >= least) continue;
    least = misfit;
    best = std::move(map);
  }
  return best;
}

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
  // Even a nearly uninformative sensor has more information on its own pairs than no sensor.
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
