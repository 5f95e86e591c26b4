#include <algorithm>
#include <numbers>
#include <optional>
#include <utility>

#include <fmt/format.h>

#include "core/align/aligned_to.hpp"
#include "core/base/not_finite.hpp"
#include "core/base/random.hpp"
#include "core/base/stopwatch.hpp"
#include "core/embed/isomap.hpp"
#include "core/embed/landmark_isomap.hpp"
#include "core/embed/landmark_mvu.hpp"
#include "core/embed/sde/sde.hpp"
#include "core/experiment/scored_map.hpp"
#include "core/observe/history_distances.hpp"
#include "core/observe/proximities.hpp"
#include "core/simulate/sensors.hpp"
#include "core/topics/topics.hpp"

namespace mapproof {
namespace {

constexpr Sensor kReferenceSensors[] = {Sensor::kBearing, Sensor::kVisibility};

/// A method, and what approximates it from reference landmarks.
struct Approximation {
  Method exact;
  Method approximate;
};

constexpr Approximation kApproximations[] = {{Method::kIsomap, Method::kLandmarkIsomap},
                                             {Method::kSde, Method::kLandmarkMvu}};

MethodSetting setting_of(const TopicExperiment& experiment, Method method) {
  return {method, number_option(experiment, "neighbours")};
}

/// SDE of many landmarks takes minutes.
bool solves_exactly(const TopicExperiment& experiment, Method method) {
  return method != Method::kSde ||
         experiment.world.landmarks <= number_option(experiment, "most_of_sde");
}

/// The programs of landmark MVU of many references take minutes.
bool solves_from(const TopicExperiment& experiment, Method method, double references) {
  return method != Method::kLandmarkMvu ||
         references <= number_option(experiment, "most_mvu_references");
}

TopicDesign references_design(const TopicExperiment& experiment) {
  TopicDesign design;
  for (const Sensor sensor : kReferenceSensors)
    design.setups.push_back(
        {std::string(name(sensor)),
         fmt::format("Reference landmarks, from {}", name(sensor)),
         {{"references", "reference landmarks", "", list_option(experiment, "references")}}});
  for (const auto& [exact, approximate] : kApproximations)
    for (const Method method : {exact, approximate})
      if (solves_exactly(experiment, method)) {
        const MethodSetting setting = setting_of(experiment, method);
        design.methods.push_back({slug(setting), label(setting)});
      }
  design.quantities = {known_quantity("mpe_m"), known_quantity("moe_unmirrored_percent"),
                       study_quantity("gap_percent", "Distance from the map of the exact method",
                                      "%", Better::kLower)};
  return design;
}

/// What a sensor observed, and the neighbour graph that all methods share.
struct ReferenceGraph {
  std::vector<Eigen::Index> seen;
  Eigen::Index landmarks = 0;
  ConnectedGraph graph;
  NeighbourLists nearest;
  PairDistance distance;      ///< Of the pairs of neighbourhoods.
  Eigen::MatrixXd distances;  ///< Of all pairs; empty unless SDE is solved.
  int neighbours = 0;

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
  ReferenceGraph result{.seen = seen_landmarks(history, history.steps()),
                        .landmarks = history.landmarks(),
                        .graph = ConnectedGraph{},
                        .nearest = {},
                        .distance = {},
                        .distances = {}};
  const double most = static_cast<double>(result.seen.size()) - 1.0;
  const int neighbours =
      static_cast<int>(std::min(number_option(context.experiment, "neighbours"), most));
  result.neighbours = neighbours;
  const HistoryBlocks seen = HistoryBlocks(history).only(result.seen);
  const HistoryDistances distances = history_distances(seen, history.steps());
  if (solves_exactly(context.experiment, Method::kSde))
    result.distances = proximities(seen, history.steps()).squared_distances.cwiseSqrt();
  result.nearest = nearest_neighbours(distances, {.neighbours = neighbours});
  result.graph = connected_neighbour_graph(distances, result.nearest, neighbours);
  if (result.graph.connected)
    result.distance = neighbourhood_distances(distances, result.graph.graph);
  return result;
}

/// The map of a method; of one without references their number does not count.
Embedding map_from(const ReferenceGraph& from, Method method, int references, int neighbours) {
  switch (method) {
    case Method::kIsomap:
      return isomap(from.graph.graph);
    case Method::kLandmarkIsomap:
      return landmark_isomap(from.graph.graph, {.references = references});
    case Method::kLandmarkMvu:
      return landmark_mvu(from.graph.graph, from.nearest, from.distance,
                          {.references = references});
    default:
      return sde(from.distances, {.neighbours = {.neighbours = neighbours}});
  }
}

/// One sensor: the map of each exact method, and one for each number of references.
void add_reference_maps(const TopicTask& context, const TopicSetup& setup, Sensor sensor,
                        TopicPart& part) {
  const TopicExperiment& experiment = context.experiment;
  const ReferenceGraph from = graph_of(context, sensor);
  const auto outcome = [&](double level, Method method, const Embedding& map, double gap) {
    const ScoredMap scored =
        scored_map(map, context.world->landmarks_m, context.anchors, AffineFit::kLeastSquares);
    part.outcomes.push_back(
        {.at = condition_at(setup, level),
         .method = slug(setting_of(experiment, method)),
         .values = {{"mpe_m", scored.score ? scored.score->mpe_m : kNaN},
                    {"moe_unmirrored_percent",
                     scored.score ? scored.score->moe_unmirrored_percent : kNaN},
                    {"gap_percent", 100.0 * gap}},
         .statuses = scored.statuses});
  };
  const auto timed = [&](Method method, double references) {
    if (!from.graph.connected) {
      Embedding none;
      none.coordinates = Points::Constant(from.landmarks, 2, kNaN);
      none.statuses = from.graph.statuses;
      return none;
    }
    const Stopwatch stopwatch;
    Embedding map =
        from.in_all_rows(map_from(from, method, static_cast<int>(references), from.neighbours));
    add_seconds(part, slug(setting_of(experiment, method)), stopwatch.seconds());
    return map;
  };
  for (const auto& [exact, approximate] : kApproximations) {
    std::optional<Embedding> whole;
    if (solves_exactly(experiment, exact)) whole = timed(exact, 0.0);
    for (const double level : levels_of(setup)) {
      if (whole) outcome(level, exact, *whole, from.graph.connected ? 0.0 : kNaN);
      if (!solves_from(experiment, approximate, level)) continue;
      const Embedding map = timed(approximate, level);
      const bool are_both = whole && from.graph.connected;
      outcome(level, approximate, map,
              are_both ? relative_gap(map.coordinates, whole->coordinates) : kNaN);
    }
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
                {"most_mvu_references", {100}, 3, 5000, true, false},
                {"most_of_sde", {300}, 3, 5000, true, false},
                {"visual_angle_deg", {1.2}, 0.01, 180, false, false}},
    .design = references_design,
    .make = make_references,
    .data_sets = nullptr};

}  // namespace mapproof
