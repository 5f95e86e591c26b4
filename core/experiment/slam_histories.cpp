#include <numeric>

#include "core/align/affine.hpp"
#include "core/base/errors.hpp"
#include "core/base/random.hpp"
#include "core/embed/embedder.hpp"
#include "core/experiment/seeds.hpp"
#include "core/experiment/slam_worlds.hpp"
#include "core/observe/features.hpp"
#include "core/observe/proximities.hpp"
#include "core/range_slam/factors/metric_upgrade.hpp"
#include "core/score/map_score.hpp"

namespace mapproof {
namespace {

/// Rows less their means over time, as features() has them.
Eigen::MatrixXd centred(const Eigen::MatrixXd& rows) {
  return rows.colwise() - Eigen::VectorXd(rows.rowwise().mean());
}

/// Lays a map on the truth by all landmarks, and scores it.
void fit_and_score(RangeHistoryMap& map, const Points& coordinates, const Points& truth_m) {
  std::vector<Eigen::Index> all(static_cast<std::size_t>(truth_m.rows()));
  std::iota(all.begin(), all.end(), Eigen::Index{0});
  AlignedMap aligned = align_to_anchors(coordinates, truth_m, all, AffineFit::kLeastSquares);
  map.statuses.insert(map.statuses.end(), aligned.statuses.begin(), aligned.statuses.end());
  map.positions_m = std::move(aligned.positions_m);
  if (aligned.aligned)
    map.score = score_map(map.positions_m, truth_m, {}, AffineFit::kLeastSquares);
}

MethodSetting setting_of(const Embedder& embedder, Method method, int neighbours) {
  if (on_graph(method)) return {method, static_cast<double>(neighbours)};
  return embedder.usual_setting(method);
}

void add_embeddings(const RangeHistoryOptions& options, const Eigen::MatrixXd& rows, bool squared,
                    RangeHistoryStudy& study) {
  Embedder embedder(proximities({.values = centred(rows), .observed = {}}, Sensor::kRange));
  for (const Method method : options.methods) {
    const MethodSetting setting = setting_of(embedder, method, options.neighbours);
    const Embedding embedding = embedder.embed(setting);
    RangeHistoryMap map{.setting = setting,
                        .squared = squared,
                        .positions_m = {},
                        .statuses = embedding.statuses,
                        .score = std::nullopt};
    fit_and_score(map, embedding.coordinates, study.landmarks_m);
    study.maps.push_back(std::move(map));
  }
}

void add_spectral(const Eigen::MatrixXd& Y, RangeHistoryStudy& study) {
  const Factorization factors = factorize(Y, 4);
  const SpectralMap found = metric_upgrade(factors).map;
  RangeHistoryMap map{.setting = std::nullopt,
                      .squared = true,
                      .positions_m = Points::Constant(study.landmarks_m.rows(), 2, NAN),
                      .statuses = factors.statuses,
                      .score = std::nullopt};
  map.statuses.insert(map.statuses.end(), found.statuses.begin(), found.statuses.end());
  if (!found.empty()) fit_and_score(map, landmarks_of(found.C), study.landmarks_m);
  study.maps.push_back(std::move(map));
}

}  // namespace

RangeHistoryStudy make_histories(const SlamExperiment& experiment) {
  if (!experiment.histories) throw InvalidInput("the experiment has no range histories");
  const RangeHistoryOptions& options = *experiment.histories;
  const RangeWorld world = simulate_range_world(
      range_world_options(experiment.world, options.noise, options.landmarks, options.steps),
      derive_seed(experiment.seed, {kSlamHistories}));
  RangeHistoryStudy study{.landmarks_m = world.landmarks_m, .steps = options.steps, .maps = {}};
  const Eigen::MatrixXd squares =
      2.0 * half_squared_ranges(world.ranges_m, range_noise(options.noise));
  add_embeddings(options, world.ranges_m, false, study);
  add_embeddings(options, squares, true, study);
  add_spectral(0.5 * squares, study);
  return study;
}

}  // namespace mapproof
