#include <algorithm>
#include <chrono>
#include <numbers>
#include <utility>

#include <fmt/format.h>

#include "core/align/aligned_to.hpp"
#include "core/base/not_finite.hpp"
#include "core/base/random.hpp"
#include "core/embed/isomap.hpp"
#include "core/embed/landmark_isomap.hpp"
#include "core/experiment/scored_map.hpp"
#include "core/observe/history_distances.hpp"
#include "core/observe/proximities.hpp"
#include "core/simulate/sensors.hpp"
#include "core/topics/topics.hpp"

namespace mapproof {
namespace {

using Clock = std::chrono::steady_clock;

constexpr Sensor kReferenceSensors[] = {Sensor::kBearing, Sensor::kVisibility};

MethodSetting exact_setting(const TopicExperiment& experiment) {
  return {Method::kIsomap, number_option(experiment, "neighbours")};
}

MethodSetting approximate_setting(const TopicExperiment& experiment) {
  return {Method::kLandmarkIsomap, number_option(experiment, "neighbours")};
}

TopicDesign references_design(const TopicExperiment& experiment) {
  TopicDesign design;
  for (const Sensor sensor : kReferenceSensors)
    design.setups.push_back(
        {std::string(name(sensor)),
         fmt::format("Landmark ISOMAP from {}", name(sensor)),
         {{"references", "reference landmarks", "", list_option(experiment, "references")}}});
  for (const MethodSetting& setting : {exact_setting(experiment), approximate_setting(experiment)})
    design.methods.push_back({slug(setting), label(setting)});
  design.quantities = {
      known_quantity("mpe_m"), known_quantity("moe_unmirrored_percent"),
      study_quantity("gap_percent", "Distance from the map of ISOMAP", "%", Better::kLower)};
  return design;
}

/// What a sensor observed, and the neighbour graph that both methods share.
struct ReferenceGraph {
  std::vector<Eigen::Index> seen;
  Eigen::Index landmarks = 0;
  ConnectedGraph graph;

  /// The map of those rows as one of all landmarks.
  Embedding in_all_rows(Embedding map) const {
    const Points mapped = std::move(map.coordinates);
    map.coordinates.setConstant(landmarks, 2, kNaN);
    map.coordinates(seen, Eigen::all) = mapped;
    map.statuses.insert(map.statuses.begin(), graph.statuses.begin(), graph.statuses.end());
    return map;
  }
};

ReferenceGraph graph_of(const TopicTask& context, Sensor sensor) {
  SensorOptions options{.sensor = sensor};
  options.visual_angle_rad =
      number_option(context.experiment, "visual_angle_deg") * std::numbers::pi / 180.0;
  Random noise(derive_seed(context.seed, {static_cast<std::uint64_t>(sensor)}));
  const ObservationHistory history = observe(*context.world, *context.path, options, noise);
  ReferenceGraph result{.seen = {}, .landmarks = history.landmarks(), .graph = {}};
  const std::vector<Eigen::Index> unseen = unseen_landmarks(history, history.steps());
  for (Eigen::Index i = 0; i < history.landmarks(); ++i)
    if (!std::ranges::binary_search(unseen, i)) result.seen.push_back(i);
  const ObservationHistory seen = with_rows(history, result.seen);
  const double most = static_cast<double>(result.seen.size()) - 1.0;
  result.graph = connected_neighbour_graph(
      history_distances(seen, seen.steps()),
      {.neighbours =
           static_cast<int>(std::min(number_option(context.experiment, "neighbours"), most))});
  return result;
}

double seconds_since_start(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

/// One sensor: the map of ISOMAP, and one for each number of references.
void add_reference_maps(const TopicTask& context, const TopicSetup& setup, Sensor sensor,
                        TopicPart& part) {
  const ReferenceGraph from = graph_of(context, sensor);
  const auto outcome = [&](double level, const MethodSetting& setting, const Embedding& map,
                           double gap) {
    const ScoredMap scored =
        scored_map(map, context.world->landmarks_m, context.anchors, AffineFit::kLeastSquares);
    part.outcomes.push_back(
        {.at = condition_at(setup, level),
         .method = slug(setting),
         .values = {{"mpe_m", scored.score ? scored.score->mpe_m : kNaN},
                    {"moe_unmirrored_percent",
                     scored.score ? scored.score->moe_unmirrored_percent : kNaN},
                    {"gap_percent", 100.0 * gap}},
         .statuses = scored.statuses});
  };
  const MethodSetting exact = exact_setting(context.experiment);
  const MethodSetting approximate = approximate_setting(context.experiment);
  if (!from.graph.connected) {  // Both are lost.
    Embedding none;
    none.coordinates = Points::Constant(from.landmarks, 2, kNaN);
    none.statuses = from.graph.statuses;
    for (const double level : levels_of(setup)) {
      outcome(level, exact, none, kNaN);
      outcome(level, approximate, none, kNaN);
    }
    return;
  }
  Clock::time_point start = Clock::now();
  const Embedding whole = from.in_all_rows(isomap(from.graph.graph));
  add_seconds(part, slug(exact), seconds_since_start(start));
  for (const double level : levels_of(setup)) {
    outcome(level, exact, whole, 0.0);
    start = Clock::now();
    const Embedding map = from.in_all_rows(
        landmark_isomap(from.graph.graph, {.references = static_cast<int>(level)}));
    add_seconds(part, slug(approximate), seconds_since_start(start));
    outcome(level, approximate, map, relative_gap(map.coordinates, whole.coordinates));
  }
}

TopicPart make_references(const TopicTask& context) {
  TopicPart part{.id = context.part, .run = context.run, .outcomes = {}, .maps = {}, .seconds = {}};
  const TopicDesign design = references_design(context.experiment);
  for (std::size_t k = 0; k < design.setups.size(); ++k)
    add_reference_maps(context, design.setups[k], kReferenceSensors[k], part);
  return part;
}

}  // namespace

const Topic kReferencesTopic = {
    .name = "references",
    .of_data = false,
    .options = {{"references", {5, 10, 20, 50, 100, 200, 500}, 3, 5000, true, true},
                {"neighbours", {8}, 1, 1000, true, false},
                {"visual_angle_deg", {1.2}, 0.01, 180, false, false}},
    .design = references_design,
    .make = make_references,
    .data_sets = nullptr};

}  // namespace mapproof
