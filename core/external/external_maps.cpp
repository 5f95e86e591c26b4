#include "core/external/external_maps.hpp"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "core/base/errors.hpp"
#include "core/base/not_finite.hpp"
#include "core/base/random.hpp"
#include "core/experiment/run.hpp"
#include "core/experiment/scored_map.hpp"
#include "core/observe/features.hpp"
#include "core/observe/proximities.hpp"

namespace mapproof {
namespace {

constexpr std::uint64_t kExternalSeed = 0x65787465726e616cULL;  // Of no other purpose.

ObservationHistory first_steps(const ObservationHistory& history, int steps) {
  return {
      .sensor = history.sensor, .names = history.names, .values = history.values.leftCols(steps)};
}

}  // namespace

void observe_run(const Experiment& experiment, const RunId& run,
                 const std::function<void(const ObservedCheckpoint&)>& use) {
  const RunWorld made = make_run_world(experiment, run);
  for (const SensorStudy& study : experiment.sensors) {
    const ObservationHistory history = observed_in(experiment, run, made, study.sensor);
    for (const int steps : study.checkpoints) {
      constexpr int kUnusedBits = 11;  // 53 are exact in JSON of any language.
      const auto sensor = static_cast<std::uint64_t>(study.sensor.sensor);
      use({.run = run,
           .sensor = study.sensor.sensor,
           .steps = steps,
           .id = fmt::format("{}/{}/{}", slug(run), name(study.sensor.sensor), steps),
           .history = first_steps(history, steps),
           .ground_truth_m = made.world.landmarks_m,
           .anchors = made.anchors,
           .seed =
               derive_seed(experiment.seed, {kExternalSeed, static_cast<std::uint64_t>(run.layout),
                                             static_cast<std::uint64_t>(run.pose), sensor,
                                             static_cast<std::uint64_t>(steps)}) >>
               kUnusedBits});
    }
  }
}

Eigen::MatrixXd external_input(const ObservedCheckpoint& checkpoint, ExternalInput input) {
  const ObservationHistory& history = checkpoint.history;
  switch (input) {
    case ExternalInput::kDistances: {
      Eigen::MatrixXd distances =
          proximities(history, checkpoint.steps).squared_distances.cwiseSqrt();
      for (const Eigen::Index i : unseen_landmarks(history, checkpoint.steps)) {
        distances.row(i).setConstant(kInfinity);
        distances.col(i).setConstant(kInfinity);
        distances(i, i) = 0.0;
      }
      return distances;
    }
    case ExternalInput::kFeatures:
      return features(history, checkpoint.steps).values;
    case ExternalInput::kHistory:
      return history.values;
  }
  throw InvalidInput("unknown input of a method");
}

ExternalMap scored_external_map(const Experiment& experiment, const ObservedCheckpoint& checkpoint,
                                const std::string& method, const Points& coordinates) {
  if (coordinates.rows() != checkpoint.ground_truth_m.rows())
    throw InvalidInput("a map has one row per landmark");
  Embedding embedding;
  embedding.coordinates = coordinates;
  ScoredMap scored =
      scored_map(embedding, checkpoint.ground_truth_m, checkpoint.anchors, experiment.affine_fit);
  ExternalMap map{.method = method,
                  .run = checkpoint.run,
                  .sensor = checkpoint.sensor,
                  .steps = checkpoint.steps,
                  .id = checkpoint.id};
  if (!scored.score) map.failure = "the map cannot be aligned to the anchors";
  map.map = map_record({.id = fmt::format("{}-{}", slug(checkpoint.run), method),
                        .origin = {},
                        .step = checkpoint.steps,
                        .names = checkpoint.history.names,
                        .ground_truth_m = checkpoint.ground_truth_m,
                        .anchors = checkpoint.anchors},
                       std::move(scored));
  return map;
}

void add_rows(const ExternalMap& map, std::vector<Result>& rows) {
  const std::optional<Score> score = map.map ? map.map->score : std::nullopt;
  const auto add = [&](const char* quantity, double Score::*value) {
    rows.push_back({.at = condition(std::string(name(map.sensor)),
                                    {{std::string(kStepsFactor), static_cast<double>(map.steps)}}),
                    .method = map.method,
                    .quantity = quantity,
                    .run = slug(map.run),
                    .group = fmt::format("layout-{}", map.run.layout),
                    .value = score ? (*score).*value : kNaN});
  };
  add("mpe_m", &Score::mpe_m);
  add("moe_percent", &Score::moe_percent);
  add("mpe_all_fitted_m", &Score::mpe_all_fitted_m);
  add("moe_unmirrored_percent", &Score::moe_unmirrored_percent);
}

}  // namespace mapproof
