#include "core/experiment/run.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <optional>
#include <tuple>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include "core/base/errors.hpp"
#include "core/base/not_finite.hpp"
#include "core/base/random.hpp"
#include "core/base/stopwatch.hpp"
#include "core/embed/embedder.hpp"
#include "core/experiment/external_input.hpp"
#include "core/experiment/scored_map.hpp"
#include "core/experiment/seeds.hpp"
#include "core/external/method_process.hpp"
#include "core/graph/neighbours.hpp"
#include "core/linalg/centering.hpp"
#include "core/linalg/symmetric_eigen.hpp"
#include "core/model/experiment.hpp"
#include "core/model/observation_history.hpp"
#include "core/model/study.hpp"
#include "core/model/world.hpp"
#include "core/observe/proximities.hpp"
#include "core/simulate/robot_walk.hpp"
#include "core/simulate/sensors.hpp"
#include "core/simulate/world.hpp"

namespace mapproof {
namespace {

constexpr Eigen::Index kDimensions = 3;
constexpr Eigen::Index kFewest = 4;

/// Rows left once those with the most unknown distances, one by one, are taken away.
std::vector<Eigen::Index> known_rows(const Eigen::MatrixXd& squared) {
  std::vector<Eigen::Index> rows;
  for (Eigen::Index i = 0; i < squared.rows(); ++i) rows.push_back(i);
  while (!rows.empty()) {
    const auto unknown = [&](Eigen::Index i) {
      return std::ranges::count_if(rows,
                                   [&](Eigen::Index j) { return !std::isfinite(squared(i, j)); });
    };
    const auto worst = std::ranges::max_element(rows, {}, unknown);
    if (unknown(*worst) == 0) break;
    rows.erase(worst);
  }
  return rows;
}

/// The first three principal coordinates of observation histories [torgerson1952] and their
/// neighbour graph (see neighbour_graph), of the landmarks whose distances to all others of them
/// are known.
///
/// @param squared_distances  M x M, symmetric, zero diagonal, entries >= 0; those of a pair without
///                           common step, or of a landmark that was never seen, are not finite.
/// @param neighbours         K >= 1; fewer where there are fewer landmarks.
/// @return Empty if fewer than four landmarks are left.
/// @note O(M^3) time up to M = 40, above that O(M^2) an iteration.
std::optional<ObservationManifold> observation_manifold(const Eigen::MatrixXd& squared_distances,
                                                        int neighbours) {
  const std::vector<Eigen::Index> rows = known_rows(squared_distances);
  const auto count = std::ssize(rows);
  if (count < kFewest) return std::nullopt;
  const Eigen::MatrixXd squared = squared_distances(rows, rows);
  const Eigen::MatrixXd B = double_centered(squared);
  const EigenPairs pairs = largest_eigenpairs(B, kDimensions);

  ObservationManifold found;
  found.coordinates.setConstant(squared_distances.rows(), kDimensions, kNaN);
  const double spread = B.trace();
  for (Eigen::Index k = 0; k < kDimensions; ++k) {
    const double value = std::max(pairs.values(k), 0.0);
    found.shares[static_cast<std::size_t>(k)] = spread > 0.0 ? value / spread : 0.0;
    for (Eigen::Index i = 0; i < count; ++i)
      found.coordinates(rows[static_cast<std::size_t>(i)], k) =
          std::sqrt(value) * pairs.vectors(i, k);
  }

  found.neighbours = static_cast<int>(std::min<Eigen::Index>(neighbours, count - 1));
  const Graph graph = neighbour_graph(squared.cwiseSqrt(), {.neighbours = found.neighbours});
  for (std::size_t i = 0; i < graph.size(); ++i)
    for (const Edge& edge : graph[i])
      if (static_cast<std::size_t>(edge.to) > i)
        found.edges.emplace_back(static_cast<int>(rows[i]),
                                 static_cast<int>(rows[static_cast<std::size_t>(edge.to)]));
  return found;
}

/// To the bit: values that were not observed are NaN, and equal.
bool begins_with(const Eigen::MatrixXd& values, const Eigen::MatrixXd& beginning) {
  return values.rows() == beginning.rows() && values.cols() >= beginning.cols() &&
         std::memcmp(values.data(), beginning.data(),
                     static_cast<std::size_t>(beginning.size()) * sizeof(double)) == 0;
}

/// All options: one that is added does not compile before it is here.
std::tuple<double, double, bool> all_of(const SolverOptions& solver) {
  const auto& [smacof_relative_fall, smacof_knn_relative_fall, only_seen_together] = solver;
  return {smacof_relative_fall, smacof_knn_relative_fall, only_seen_together};
}

/// Whether both make the same embeddings.
bool are_equal(const SolverOptions& a, const SolverOptions& b) { return all_of(a) == all_of(b); }

/// Maps that the sensors' studies of a run have made, for its variations: their first level often
/// observes the same, and an embedding depends on nothing but the observations and its options.
class RememberedMaps {
 public:
  /// @param variations  Only maps at steps that they use are kept.
  explicit RememberedMaps(const std::vector<Variation>& variations) : variations_(variations) {}

  /// Keeps the map of the first `steps` observations of a history.
  void add(const ObservationHistory& history, int steps, const MethodSetting& setting,
           const Embedding& map);

  /// The map of the first `steps` observations, if those of an equal history were kept.
  const Embedding* find(const ObservationHistory& history, int steps,
                        const MethodSetting& setting) const;

 private:
  struct Observed {
    ObservationHistory history;  ///< Of those steps alone.
    std::vector<std::pair<MethodSetting, Embedding>> maps;
  };

  const Observed* equal(const ObservationHistory& history, int steps) const;

  const std::vector<Variation>& variations_;
  std::vector<Observed> observed_;
};

const RememberedMaps::Observed* RememberedMaps::equal(const ObservationHistory& history,
                                                      int steps) const {
  for (const Observed& observed : observed_)
    if (observed.history.sensor == history.sensor && observed.history.steps() == steps &&
        observed.history.names == history.names &&
        begins_with(history.values, observed.history.values))
      return &observed;
  return nullptr;
}

void RememberedMaps::add(const ObservationHistory& history, int steps, const MethodSetting& setting,
                         const Embedding& map) {
  if (std::ranges::none_of(variations_, [&](const Variation& variation) {
        return variation.sensor == history.sensor && variation.step == steps &&
               std::ranges::count(variation.settings, setting) > 0;
      }))
    return;
  if (observed_.empty() || equal(history, steps) != &observed_.back())
    observed_.push_back({.history = {.sensor = history.sensor,
                                     .names = history.names,
                                     .values = history.values.leftCols(steps)},
                         .maps = {}});
  observed_.back().maps.emplace_back(setting, map);
}

const Embedding* RememberedMaps::find(const ObservationHistory& history, int steps,
                                      const MethodSetting& setting) const {
  const Observed* const observed = equal(history, steps);
  if (observed == nullptr) return nullptr;
  const auto known =
      std::ranges::find(observed->maps, setting, &std::pair<MethodSetting, Embedding>::first);
  return known == observed->maps.end() ? nullptr : &known->second;
}

/// One variation in one run; keeps what its levels share.
class Varying {
 public:
  Varying(const Experiment& experiment, const Variation& variation, const RunResult& result,
          const RememberedMaps& remembered)
      : experiment_(experiment),
        variation_(variation),
        run_(result.run),
        path_(result.details.path),
        remembered_(remembered) {
    if (variation.step < 1 || variation.step > path_.positions_m.rows())
      throw InvalidInput("a variation names a step that the path does not have");
  }

  void add_level(double level, std::vector<VariationRecord>& records) {
    Experiment varied = experiment_;
    set_level(varied, variation_.sensor, variation_.factor, level);
    const std::vector<Eigen::Index> anchors = anchors_of(varied);
    prepare(varied);
    for (std::size_t i = 0; i < variation_.settings.size(); ++i) {
      ScoredMap map =
          scored_map(embeddings_[i], run_.world.landmarks_m, anchors, experiment_.affine_fit);
      records.push_back({.variation = variation_.id,
                         .level = level,
                         .setting = variation_.settings[i],
                         .statuses = std::move(map.statuses),
                         .score = map.score});
    }
  }

 private:
  std::vector<Eigen::Index> anchors_of(const Experiment& varied) const {
    if (variation_.factor != Factor::kAnchors && !variation_.placement) return run_.anchors;
    // A larger number of random anchors holds the smaller one.
    Random random(
        derive_seed(experiment_.seed, {kPlacement, static_cast<std::uint64_t>(run_.id.layout)}));
    return place_anchors(run_.world, varied.anchors,
                         variation_.placement.value_or(experiment_.anchor_placement), random);
  }

  /// Observes and embeds again where the level asks for it.
  void prepare(const Experiment& varied) {
    const bool same_history = history_ && variation_.factor != Factor::kNoise &&
                              variation_.factor != Factor::kDropoutShare;
    if (!same_history) history_ = observed(find_sensor(varied, variation_.sensor)->sensor);
    if (same_history && variation_.factor == Factor::kAnchors) return;
    embed(varied.solver);
  }

  void embed(const SolverOptions& solver) {
    embeddings_.clear();
    std::optional<HistoryEmbedder> embedder;
    for (const MethodSetting& setting : variation_.settings) {
      const Embedding* const known = are_equal(solver, experiment_.solver)
                                         ? remembered_.find(*history_, variation_.step, setting)
                                         : nullptr;
      if (known == nullptr && !embedder)
        embedder.emplace(*history_, variation_.step, embedder_options(solver));
      embeddings_.push_back(known != nullptr ? *known : embedder->embed(setting));
    }
  }

  ObservationHistory observed(const SensorOptions& sensor) const {
    Random noise(derive_seed(
        experiment_.seed,
        {kVariationNoise, static_cast<std::uint64_t>(run_.id.layout),
         static_cast<std::uint64_t>(run_.id.pose), static_cast<std::uint64_t>(variation_.sensor)}));
    return observe(run_.world, path_, sensor, noise);
  }

  const Experiment& experiment_;
  const Variation& variation_;
  const Run& run_;
  const Path& path_;
  const RememberedMaps& remembered_;
  std::optional<ObservationHistory> history_;
  std::vector<Embedding> embeddings_;
};

/// Makes the maps of every variation of the experiment for one run and scores them.
///
/// The levels of a variation share their random numbers: a higher noise level is the same noise,
/// larger. Variations of the anchors and of the solver share one history over all levels.
/// @param result      Its world, anchors and path are read; the path is as long as the latest step
///                    of any variation, or longer.
/// @param remembered  Maps of the run that need not be made again.
/// @return In order of variation, level, setting.
std::vector<VariationRecord> vary(const Experiment& experiment, const RunResult& result,
                                  const RememberedMaps& remembered) {
  std::vector<VariationRecord> records;
  for (const Variation& variation : experiment.variations) {
    Varying varying(experiment, variation, result, remembered);
    for (const double level : variation.levels) varying.add_level(level, records);
  }
  return records;
}

constexpr Eigen::Index kFirstSteps = 60;
constexpr int kManifoldNeighbours = 5;

/// Counted from 0.
Eigen::Index informative_scan(const SensorStudy& study, const World& world, const Path& path,
                              Eigen::Index steps) {
  Eigen::Index best = 0;
  if (study.sensor.sensor != Sensor::kVisibility) {
    const Eigen::RowVector2d center(world.side_m / 2.0, world.side_m / 2.0);
    (path.positions_m.topRows(steps).rowwise() - center).rowwise().squaredNorm().minCoeff(&best);
    return best;
  }
  std::pair<std::ptrdiff_t, std::ptrdiff_t> most{-1, -1};
  for (Eigen::Index t = 0; t < steps; ++t) {
    const std::vector<View> views = views_from(world, path.positions_m.row(t), study.sensor);
    const std::pair found{std::ranges::count(views, View::kHidden),
                          std::ranges::count(views, View::kVisible)};
    if (found > most) {
      most = found;
      best = t;
    }
  }
  return best;
}

/// The entries above the diagonal, row by row.
Eigen::VectorXd upper_triangle(const Eigen::MatrixXd& squared) {
  const Eigen::Index n = squared.rows();
  Eigen::VectorXd distances(n * (n - 1) / 2);
  Eigen::Index k = 0;
  for (Eigen::Index i = 0; i < n; ++i)
    for (Eigen::Index j = i + 1; j < n; ++j) {
      const double distance = std::sqrt(squared(i, j));
      distances(k++) = std::isfinite(distance) ? distance : kNaN;
    }
  return distances;
}

Eigen::MatrixXd observed_squares(const ObservationHistory& history, Eigen::Index steps) {
  Eigen::MatrixXd squared = proximities(history, steps).squared_distances;
  for (const Eigen::Index i : unseen_landmarks(history, steps)) {
    squared.row(i).setConstant(kNaN);
    squared.col(i).setConstant(kNaN);
  }
  return squared;
}

/// What figures show of one sensor's history, without spectra.
///
/// The scan is the one that shows most: for visibility the step with the most hidden landmarks (of
/// those the one with the most visible), for other sensors the step nearest the room's centre; of
/// equals the first.
/// @param history  Of that sensor, along `path`, as long as the last checkpoint or longer.
SensorDetails sensor_details(const SensorStudy& study, const World& world, const Path& path,
                             const ObservationHistory& history) {
  const int step = study.checkpoints.back();
  const Eigen::MatrixXd squared = observed_squares(history, step);
  const Eigen::Index scan = informative_scan(study, world, path, step);
  SensorDetails details{
      .sensor = study.sensor.sensor,
      .scan_step = static_cast<int>(scan) + 1,
      .views = {},
      .values = history.values.col(scan),
      .first_steps = history.values.leftCols(std::min<Eigen::Index>(kFirstSteps, step)),
      .step = step,
      .distances = upper_triangle(squared),
      .manifold = observation_manifold(squared, kManifoldNeighbours),
      .spectra = {}};
  if (study.sensor.sensor == Sensor::kVisibility) {
    details.reach_m = visibility_reach(world, study.sensor);
    details.views = views_from(world, path.positions_m.row(scan), study.sensor);
  }
  return details;
}

/// Where one checkpoint of a sensor is mapped by methods of others.
class ExternalEmbedder {
 public:
  /// @param others  Null where the experiment has no methods of others.
  ExternalEmbedder(const Experiment& experiment, const RunId& run,
                   const ObservationHistory& history, int step, MethodProcesses* others)
      : experiment_(experiment), run_(run), history_(history), step_(step), others_(others) {}

  int step() const { return step_; }

  /// Landmarks that were never observed get no position, as by mapproof's methods.
  Embedding embed(const ExternalMethod& method, const MethodSetting& setting) {
    if (others_ == nullptr)
      throw InvalidInput(method.name + ": a method of others, which has no process");
    const ExternalReply reply = others_->map(
        method.name, {.id = checkpoint_id(run_, history_.sensor, step_),
                      .sensor = std::string(name(history_.sensor)),
                      .steps = step_,
                      .landmarks = history_.names,
                      .input = external_input(history_, step_, method.input),
                      .parameter = setting.parameter,
                      .seed = checkpoint_seed(experiment_.seed, run_, history_.sensor, step_)});
    Embedding map;
    map.coordinates = Points::Constant(history_.landmarks(), 2, kNaN);
    if (reply.failure)
      map.statuses.push_back(*reply.failure);
    else
      map.coordinates = reply.coordinates;
    add_unmapped(map);
    return map;
  }

 private:
  void add_unmapped(Embedding& map) const {
    const std::vector<Eigen::Index> unseen = unseen_landmarks(history_, step_);
    for (const Eigen::Index row : unseen) map.coordinates.row(row).setConstant(kNaN);
    std::vector<Eigen::Index> left_out;
    for (Eigen::Index row = 0; row < history_.landmarks(); ++row)
      if (!map.coordinates.row(row).allFinite() && !std::ranges::binary_search(unseen, row))
        left_out.push_back(row);
    if (map.statuses.empty() && !left_out.empty())
      map.statuses.push_back(status_of<StatusReason::kMethodLeftOut>(names_of(history_, left_out)));
    if (!unseen.empty())
      map.statuses.push_back(status_of<StatusReason::kNeverObserved>(
          names_of(history_, unseen), unseen.size(), history_.landmarks()));
  }

  const Experiment& experiment_;
  const RunId& run_;
  const ObservationHistory& history_;
  int step_;
  MethodProcesses* others_;
};

/// What a run gave, and what its variations need not make again.
struct RunMaps {
  RunResult& result;
  RememberedMaps& remembered;
};

/// Builds, scores and keeps the maps of one sensor after external.step() observations.
void map_at(const Experiment& experiment, const ObservationHistory& history,
            const SensorStudy& study, ExternalEmbedder external, const RunMaps& maps) {
  RunResult& result = maps.result;
  const Run& run = result.run;
  const int step = external.step();
  HistoryEmbedder embedder(history, step, embedder_options(experiment.solver));
  for (const MethodSetting& setting : settings_of(study)) {
    const Stopwatch stopwatch;
    const ExternalMethod* method = find_external(experiment, setting.method);
    const Embedding embedding =
        method == nullptr ? embedder.embed(setting) : external.embed(*method, setting);
    const double seconds = stopwatch.seconds();
    if (method == nullptr) maps.remembered.add(history, step, setting, embedding);
    ScoredMap map =
        scored_map(embedding, run.world.landmarks_m, run.anchors, experiment.affine_fit);
    result.timings.push_back({run.id, history.sensor, setting, step, seconds});
    result.run.records.push_back({.sensor = history.sensor,
                                  .setting = setting,
                                  .step = step,
                                  .statuses = map.statuses,
                                  .score = map.score,
                                  .iterations = embedding.iterations,
                                  .stress = embedding.stress,
                                  .certificate = embedding.certificate});
    if (step == study.checkpoints.back() && embedding.spectrum.size() > 0)
      result.details.sensors.back().spectra.emplace_back(setting, embedding.spectrum);
    result.maps.push_back(map_record({.id = record_id(run.id, history.sensor, setting, step),
                                      .origin = FromSensor{history.sensor, setting},
                                      .step = step,
                                      .names = history.names,
                                      .ground_truth_m = run.world.landmarks_m,
                                      .anchors = run.anchors},
                                     std::move(map)));
  }
}

/// One walk, long enough for every part of the experiment, so that sensors can be compared on it.
int observations_of(const Experiment& experiment) {
  int observations = 1;
  for (const SensorStudy& study : experiment.sensors) {
    if (study.checkpoints.empty()) throw InvalidInput("a sensor's study has no checkpoints");
    observations = std::max(observations, study.checkpoints.back());
  }
  for (const Variation& variation : experiment.variations)
    observations = std::max(observations, variation.step);
  return observations;
}

}  // namespace

std::vector<RunId> runs_of(const Experiment& experiment) {
  std::vector<RunId> runs;
  for (int layout = 1; layout <= experiment.layouts; ++layout)
    for (int pose = 1; pose <= experiment.poses; ++pose) runs.push_back({layout, pose});
  return runs;
}

RunWorld make_run_world(const Experiment& experiment, const RunId& id) {
  const auto layout = static_cast<std::uint64_t>(id.layout);
  const auto pose = static_cast<std::uint64_t>(id.pose);
  // The same layout for all its poses.
  Random scatter(derive_seed(experiment.seed, {kLayout, layout}));
  Random choice(derive_seed(experiment.seed, {kPlacement, layout}));
  Random wander(derive_seed(experiment.seed, {kWalk, layout, pose}));
  RunWorld made;
  made.world = scatter_landmarks(experiment.world, scatter);
  made.anchors = place_anchors(made.world, experiment.anchors, experiment.anchor_placement, choice);
  made.path = random_walk(made.world, experiment.walk, observations_of(experiment), wander);
  return made;
}

ObservationHistory observed_in(const Experiment& experiment, const RunId& id, const RunWorld& made,
                               const SensorOptions& sensor) {
  Random noise(derive_seed(experiment.seed, {kNoise, static_cast<std::uint64_t>(id.layout),
                                             static_cast<std::uint64_t>(id.pose),
                                             static_cast<std::uint64_t>(sensor.sensor)}));
  return observe(made.world, made.path, sensor, noise);
}

RunResult simulate_run(const Experiment& experiment, const RunId& id, MethodProcesses* others) {
  const RunWorld made = make_run_world(experiment, id);
  RunResult result;
  Run& run = result.run;
  run.id = result.details.id = id;
  run.world = made.world;
  run.anchors = made.anchors;
  result.details.path = made.path;
  const Path& path = result.details.path;
  RememberedMaps remembered(experiment.variations);

  for (const SensorStudy& study : experiment.sensors) {
    const ObservationHistory history = observed_in(experiment, id, made, study.sensor);
    if (study.sensor.sensor == Sensor::kVisibility && study.sensor.occlusion)
      run.occlusion = count_occlusion(run.world, path, study.sensor);
    result.details.sensors.push_back(sensor_details(study, run.world, path, history));
    for (const int step : study.checkpoints)
      map_at(experiment, history, study, {experiment, result.run.id, history, step, others},
             {result, remembered});
  }
  run.variations = vary(experiment, result, remembered);
  return result;
}

void observe_run(const Experiment& experiment, const RunId& run,
                 const std::function<void(const ObservedCheckpoint&)>& use) {
  const RunWorld made = make_run_world(experiment, run);
  for (const SensorStudy& study : experiment.sensors) {
    const ObservationHistory history = observed_in(experiment, run, made, study.sensor);
    for (const int steps : study.checkpoints)
      use({.run = run,
           .sensor = study.sensor.sensor,
           .steps = steps,
           .history = ObservationHistory{.sensor = history.sensor,
                                         .names = history.names,
                                         .values = history.values.leftCols(steps)},
           .ground_truth_m = made.world.landmarks_m,
           .anchors = made.anchors,
           .seed = checkpoint_seed(experiment.seed, run, study.sensor.sensor, steps)});
  }
}

}  // namespace mapproof
