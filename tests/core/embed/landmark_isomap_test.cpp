#include "core/embed/landmark_isomap.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include <gtest/gtest.h>

#include "core/base/errors.hpp"
#include "core/base/random.hpp"
#include "core/embed/embedder.hpp"
#include "core/embed/isomap.hpp"
#include "core/graph/shortest_paths.hpp"
#include "core/simulate/robot_walk.hpp"
#include "core/simulate/sensors.hpp"
#include "core/simulate/world.hpp"
#include "tests/support/samples/worlds.hpp"
#include "tests/support/statuses.hpp"

namespace mapproof {
namespace {

using Eigen::Index;
using test::distances_of;
using test::has;
using test::procrustes_gap;
using test::scattered;

/// What a walk through a room of so many landmarks shows.
ObservationHistory walked(Sensor sensor, int landmarks, int steps, std::uint64_t seed) {
  Random random(seed);
  WorldOptions room;
  room.landmarks = landmarks;
  room.side_m *= std::sqrt(landmarks / 50.0);
  const World world = scatter_landmarks(room, random);
  SensorOptions options{.sensor = sensor};
  options.visual_angle_rad = 0.03;
  options.occlusion = false;
  options.reach_m = 2.0;
  return observe(world, random_walk(world, {}, steps, random), options, random);
}

EmbedderOptions with_references(int references) {
  EmbedderOptions options;
  options.landmark_isomap.references = references;
  return options;
}

TEST(LandmarkIsomap, WithAllAsReferencesIsIsomap) {
  for (const int neighbours : {4, 8}) {
    const Eigen::MatrixXd D = distances_of(scattered(120, 3));
    const ConnectedGraph graph = connected_neighbour_graph(D, {.neighbours = neighbours});
    const Embedding whole = isomap(graph.graph);
    const Embedding found = landmark_isomap(graph.graph, {.references = 120});
    EXPECT_LT(procrustes_gap(whole.coordinates, found.coordinates), 1e-10);
    EXPECT_LT((whole.coordinates - found.coordinates).cwiseAbs().maxCoeff(), 1e-8);
    EXPECT_LT((whole.spectrum - found.spectrum).norm(), 1e-10 * whole.spectrum.norm());
    EXPECT_EQ(landmark_isomap(graph.graph, {.references = 5000}).coordinates, found.coordinates);
  }
}

TEST(LandmarkIsomap, RecoversAPlaneFromAFewReferences) {
  // With all as neighbours the shortest paths are straight: lengths to three references not on one
  // line determine all positions.
  const Points points = scattered(50, 8);
  const ConnectedGraph graph = connected_neighbour_graph(distances_of(points), {.neighbours = 49});
  for (const int references : {4, 7, 20})
    EXPECT_LT(procrustes_gap(points,
                             landmark_isomap(graph.graph, {.references = references}).coordinates),
              1e-10);
}

TEST(LandmarkIsomap, IsCentredAndInItsPrincipalAxes) {
  const ConnectedGraph graph =
      connected_neighbour_graph(distances_of(scattered(200, 2)), {.neighbours = 6});
  const Points map = landmark_isomap(graph.graph, {.references = 25}).coordinates;
  EXPECT_LT(map.colwise().mean().norm(), 1e-12);
  EXPECT_LT(std::abs(map.col(0).dot(map.col(1))), 1e-10);
  EXPECT_GT(map.col(0).norm(), map.col(1).norm());
}

TEST(LandmarkIsomap, RefusesFewerThanThreeReferences) {
  const ConnectedGraph graph =
      connected_neighbour_graph(distances_of(scattered(9, 2)), {.neighbours = 4});
  EXPECT_THROW(landmark_isomap(graph.graph, {.references = 2}), InvalidInput);
  EXPECT_NO_THROW(landmark_isomap(graph.graph, {.references = 3}));
}

TEST(PathSearch, FindsTheLengthsOfFloydAndWarshall) {
  for (const bool with_duplicates : {false, true}) {
    Points points = scattered(60, 4);
    if (with_duplicates) points.row(5) = points.row(6);
    const Eigen::MatrixXd D = distances_of(points);
    const Graph graph = connected_neighbour_graph(D, {.neighbours = 4}).graph;
    Eigen::MatrixXd edges = Eigen::MatrixXd::Constant(60, 60, kInfinity);
    edges.diagonal().setZero();
    for (Index i = 0; i < 60; ++i)
      for (const Edge& edge : graph[static_cast<std::size_t>(i)]) edges(i, edge.to) = edge.length;
    const Eigen::MatrixXd expected = completed_distances(edges);
    PathSearch search(graph);
    Eigen::VectorXd lengths(60);
    for (const Index source : {17, 5, 0, 17}) {
      search.from(source, lengths.data());
      EXPECT_LT((lengths - expected.col(source)).cwiseAbs().maxCoeff(), 1e-12);
    }
  }
}

/// Both ways to the map of a history: without, and by the array of all distances.
void expect_one_map(const ObservationHistory& history, double K, const EmbedderOptions& options,
                    Method method = Method::kLandmarkIsomap) {
  MethodSetting setting{method, K};
  const Embedding found = embed_history(history, history.steps(), setting, options);
  const Embedding expected = HistoryEmbedder(history, history.steps(), options).embed(setting);
  ASSERT_EQ(found.coordinates.array().isNaN().cast<int>().matrix(),
            expected.coordinates.array().isNaN().cast<int>().matrix());
  const double size = expected.coordinates.array().isNaN().select(0.0, expected.coordinates).norm();
  EXPECT_LE((found.coordinates - expected.coordinates)
                .array()
                .isNaN()
                .select(0.0, found.coordinates - expected.coordinates)
                .norm(),
            // A program is solved to a gap of 1e-6, on whichever side of it rounding ends.
            (method == Method::kLandmarkMvu ? 1e-3 : 1e-8) * size);
  ASSERT_EQ(found.statuses.size(), expected.statuses.size());
  for (std::size_t k = 0; k < found.statuses.size(); ++k) {
    EXPECT_EQ(found.statuses[k].reason, expected.statuses[k].reason);
    EXPECT_EQ(found.statuses[k].names, expected.statuses[k].names);
    for (std::size_t v = 0; v < found.statuses[k].values.size(); ++v)
      EXPECT_NEAR(found.statuses[k].values[v], expected.statuses[k].values[v],
                  (method == Method::kLandmarkMvu ? 1e-2 : 1e-9) *
                      std::abs(expected.statuses[k].values[v]));
  }
}

TEST(EmbedHistory, GivesTheMapOfTheArrayOfDistances) {
  for (const Sensor sensor : {Sensor::kVisibility, Sensor::kBearing, Sensor::kRange})
    for (const int references : {30, 1000})
      for (const double K : {4.0, 9.0}) {
        SCOPED_TRACE(testing::Message() << name(sensor) << ", " << references << ", " << K);
        expect_one_map(walked(sensor, 150, 400, 3), K, with_references(references));
      }
}

TEST(EmbedHistory, GivesTheMapOfLandmarkMvuOfTheArray) {
  for (const Sensor sensor : {Sensor::kVisibility, Sensor::kBearing, Sensor::kRange}) {
    SCOPED_TRACE(name(sensor));
    EmbedderOptions options;
    options.landmark_mvu.references = 12;
    expect_one_map(walked(sensor, 80, 200, 3), 5.0, options, Method::kLandmarkMvu);
  }
}

TEST(EmbedHistory, GivesTheMapOfTheArrayWhereFewWereSeenTogether) {
  // Few steps: neighbours are chosen among landmarks never seen together, and groups are bridged.
  for (const bool only_together : {false, true})
    for (const int steps : {5, 20, 60}) {
      SCOPED_TRACE(testing::Message() << only_together << ", " << steps);
      EmbedderOptions options = with_references(40);
      options.only_seen_together = only_together;
      const ObservationHistory history = walked(Sensor::kVisibility, 200, steps, 7);
      expect_one_map(history, 6.0, options);
    }
  const ObservationHistory few = walked(Sensor::kVisibility, 200, 20, 7);
  expect_one_map(few, 90.0, with_references(40));
  MethodSetting setting{Method::kLandmarkIsomap, 90.0};
  EXPECT_TRUE(has(embed_history(few, 20, setting), StatusCode::kArbitraryNeighbours));
  EXPECT_TRUE(has(embed_history(few, 20, setting), StatusCode::kLandmarkUnseen));
}

TEST(EmbedHistory, BridgesRoomsThatAreNeverSeenTogetherAsTheArrayDoes) {
  const ObservationHistory one = walked(Sensor::kVisibility, 90, 300, 7);
  const ObservationHistory other = walked(Sensor::kVisibility, 70, 300, 8);
  ObservationHistory both{.sensor = Sensor::kVisibility,
                          .names = landmark_names(160),
                          .values = Eigen::MatrixXd::Zero(160, 600)};
  both.values.topLeftCorner(90, 300) = one.values;
  both.values.bottomRightCorner(70, 300) = other.values;
  for (const double missing : {0.0, static_cast<double>(NAN)}) {
    both.values(3, 400) = missing;
    expect_one_map(both, 6.0, with_references(30));
    MethodSetting setting{Method::kLandmarkIsomap, 6.0};
    const Embedding map = embed_history(both, 600, setting);
    EXPECT_TRUE(has(map, StatusCode::kBridged));
    EXPECT_TRUE(has(map, StatusCode::kUndetermined));
  }
}

TEST(EmbedHistory, FailsWhereNoObservationTiesTwoGroups) {
  ObservationHistory history = walked(Sensor::kBearing, 40, 60, 2);
  history.values.array() = history.values.array().isNaN().select(0.1, history.values);
  history.values.topLeftCorner(20, 30).setConstant(NAN);
  history.values.bottomRightCorner(20, 30).setConstant(NAN);
  expect_one_map(history, 5.0, {});
  MethodSetting setting{Method::kLandmarkIsomap, 5.0};
  EXPECT_TRUE(has(embed_history(history, 60, setting), StatusCode::kFailed));
}

TEST(EmbedHistory, MapsIdenticalHistoriesToOnePoint) {
  ObservationHistory history{.sensor = Sensor::kVisibility,
                             .names = landmark_names(12),
                             .values = Eigen::MatrixXd::Ones(12, 9)};
  expect_one_map(history, 4.0, {});
  MethodSetting usual{Method::kLandmarkIsomap, std::nullopt};
  const Embedding map = embed_history(history, 9, usual);
  EXPECT_EQ(usual.parameter, 6.0);
  EXPECT_TRUE(map.coordinates.isZero(0.0));
}

TEST(EmbedHistory, MapsEqualRowsOfAnyNumbersToOnePoint) {
  Random random(4);
  Eigen::RowVectorXd row(40);
  for (double& value : row) value = random.uniform(0.1, 3.0);
  for (const Sensor sensor : {Sensor::kRange, Sensor::kBearing})
    for (const double missing : {0.0, 0.2})
      for (const Method method : {Method::kLandmarkIsomap, Method::kLandmarkMvu}) {
        ObservationHistory history{
            .sensor = sensor, .names = landmark_names(12), .values = row.replicate(12, 1)};
        for (double& value : history.values.reshaped())
          if (random.uniform() < missing && sensor == Sensor::kBearing) value = NAN;
        MethodSetting setting{method, 4.0};
        const Embedding map = embed_history(history, 40, setting);
        EXPECT_TRUE(map.coordinates.isZero(0.0)) << name(sensor) << ", " << missing;
        EXPECT_TRUE(has(map, StatusCode::kRankDeficient)) << name(sensor) << ", " << missing;
      }
}

TEST(EmbedHistory, DoesNotDependOnTheOrderOfTheLandmarks) {
  const ObservationHistory history = walked(Sensor::kBearing, 120, 300, 5);
  std::vector<Index> order(120);
  for (std::size_t i = 0; i < 120; ++i) order[i] = static_cast<Index>(i * 7 % 120);
  MethodSetting setting{Method::kLandmarkIsomap, 7.0};
  const Points map =
      embed_history(history, 300, setting, with_references(1000)).coordinates(order, Eigen::all);
  const Points other =
      embed_history(with_rows(history, order), 300, setting, with_references(1000)).coordinates;
  EXPECT_LT(procrustes_gap(map, other), 1e-8 * map.norm());
}

TEST(EmbedDetected, GivesTheMapOfTheHistory) {
  for (const Sensor sensor : {Sensor::kVisibility, Sensor::kBearing}) {
    ObservationHistory history = walked(sensor, 90, 200, 6);
    DetectionLog log{.names = history.names, .steps = 200};
    for (int t = 0; t < 200; ++t)
      for (int i = 0; i < 90; ++i) {
        const double value = history.values(i, t);
        if (std::isnan(value) || (sensor == Sensor::kVisibility && value == 0.0)) continue;
        log.detections.push_back({.step = t, .landmark = i, .bearing_rad = value});
      }
    ASSERT_TRUE(unseen_in(log).empty());
    MethodSetting of_log{Method::kLandmarkIsomap, std::nullopt}, of_history = of_log;
    const Embedding found = embed_detected(log, sensor, of_log);
    const Embedding expected = embed_history(history, 200, of_history);
    EXPECT_EQ(of_log, of_history);
    EXPECT_LT((found.coordinates - expected.coordinates).norm(),
              1e-9 * expected.coordinates.norm());
    EXPECT_EQ(found.statuses, expected.statuses);
    const HistoryBlocks blocks = blocks_of(log, sensor);
    const Eigen::ArrayXXd at_once = blocks.values(0, 200);
    EXPECT_TRUE(((at_once == history.values.array()) ||
                 (at_once.isNaN() && history.values.array().isNaN()))
                    .all());
    const auto part = blocks.every(3).only({2, 30, 31, 80}).values_of(1, 2, 5, 40);
    for (Index i = 0; i < 2; ++i)
      for (Index t = 0; t < 40; ++t) {
        const double expected_value = history.values(30 + i, 3 * (5 + t));
        EXPECT_TRUE(part(i, t) == expected_value ||
                    (std::isnan(part(i, t)) && std::isnan(expected_value)));
      }
  }
}

TEST(NeededBytes, GrowBySquaresUnlessThePathsAreToReferencesAlone) {
  const auto isomap = [](Eigen::Index n) { return needed_bytes(Method::kIsomap, n); };
  const auto of_references = [](Eigen::Index n) {
    return needed_bytes(Method::kLandmarkIsomap, n);
  };
  EXPECT_DOUBLE_EQ(isomap(20'000), 4.0 * isomap(10'000));
  EXPECT_DOUBLE_EQ(of_references(30'000) - of_references(20'000),
                   of_references(20'000) - of_references(10'000));
  EXPECT_GT(isomap(100'000), 1e11);
  EXPECT_LT(of_references(100'000), 1e9);
}

}  // namespace
}  // namespace mapproof
