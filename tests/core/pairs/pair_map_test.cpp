#include "core/pairs/pair_map.hpp"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>
#include <rapidcheck.h>
#include <rapidcheck/gtest.h>

#include "core/base/errors.hpp"
#include "core/base/random.hpp"
#include "core/pairs/orientation.hpp"
#include "tests/support/samples/scans.hpp"
#include "tests/support/samples/worlds.hpp"

namespace mapproof {
namespace {

using test::procrustes_gap;
using test::scans_at;
using test::scattered;

const Status* first_status(const Embedding& map, StatusCode code) {
  const auto found = std::ranges::find(map.statuses, code, &Status::code);
  return found == map.statuses.end() ? nullptr : &*found;
}

TEST(PairMap, DetectionsWithoutNoiseGiveTheMapToANanometre) {
  for (const std::uint64_t seed : {1, 2, 3}) {
    const Points landmarks = 10.0 * scattered(15, seed);
    const PairMap map = pair_map_of(scans_at(landmarks, 800, 5, seed));
    EXPECT_LT(procrustes_gap(landmarks, map.embedding.coordinates), 1e-9);
    EXPECT_TRUE(map.embedding.statuses.empty());
  }
}

TEST(PairMap, HasTheOrientationThatTheScansShow) {
  const Points landmarks = scattered(12, 4);
  const DetectionLog log = scans_at(landmarks, 300, 4, 4);
  EXPECT_FALSE(seen_mirrored(log, landmarks));
  EXPECT_FALSE(seen_mirrored(log, pair_map_of(log).embedding.coordinates));
  Points mirrored = landmarks;
  mirrored.col(0) *= -1.0;
  EXPECT_TRUE(seen_mirrored(log, mirrored));
}

TEST(PairMap, HasTheScaleOfTheRanges) {
  const Points landmarks = scattered(10, 5);
  DetectionLog log = scans_at(landmarks, 300, 4, 5);
  for (Detection& seen : log.detections) seen.range_m *= 7.0;
  EXPECT_LT(procrustes_gap(7.0 * landmarks, pair_map_of(log).embedding.coordinates), 1e-9);
}

TEST(PairMap, ScansOfSeveralRobotsArePooled) {
  const Points landmarks = scattered(10, 6);
  DetectionLog log = scans_at(landmarks, 150, 4, 6);
  const DetectionLog other = scans_at(landmarks, 150, 4, 7);
  for (Detection seen : other.detections) {
    seen.step += log.steps;
    log.detections.push_back(seen);
  }
  log.steps += other.steps;
  EXPECT_LT(procrustes_gap(landmarks, pair_map_of(log).embedding.coordinates), 1e-9);
}

TEST(PairMap, HalfACentimetreOfNoiseStaysHalfACentimetre) {
  const Points landmarks = 5.0 * scattered(15, 8);
  DetectionLog log = scans_at(landmarks, 800, 5, 8);
  Random random(8);
  for (Detection& seen : log.detections) seen.range_m += 0.005 * random.normal();
  const PairMap map = pair_map_of(log);
  EXPECT_LT(procrustes_gap(landmarks, map.embedding.coordinates), 0.005);
}

TEST(PairMap, AFewWrongNamesHardlyMoveTheMap) {
  const Points landmarks = 5.0 * scattered(15, 9);
  DetectionLog log = scans_at(landmarks, 800, 5, 9);
  Random random(9);
  // In one scan of ten, the first landmark's range and bearing are those of somewhere else.
  int wrong = 0;
  for (std::size_t k = 0; k < log.detections.size(); k += 50) {
    log.detections[k].range_m = 5.0 * random.uniform();
    log.detections[k].bearing_rad = 6.0 * random.uniform() - 3.0;
    ++wrong;
  }
  EXPECT_EQ(wrong, 80);
  EXPECT_LT(procrustes_gap(landmarks, pair_map_of(log).embedding.coordinates), 0.02);
}

TEST(PairMap, APairThatFitsNothingIsIgnored) {
  const Points landmarks = scattered(9, 10);
  const DetectionLog log = scans_at(landmarks, 400, 5, 10);
  std::vector<MeasuredPair> pairs = measured_pairs(log);
  std::erase_if(pairs, [](const MeasuredPair& pair) { return pair.scans < 3; });
  pairs[3].distance_m += 2.0;
  const PairMap map = pair_map(pairs, log.names);
  ASSERT_EQ(map.pairs.size(), pairs.size());
  EXPECT_LT(procrustes_gap(landmarks, map.embedding.coordinates), 1e-3);
  EXPECT_LT(map.pairs[3].precision, 2e-5 * pairs[3].precision);
}

TEST(Triangles, ContradictOnlyTheWrongPair) {
  const Points landmarks = scattered(9, 10);
  std::vector<MeasuredPair> pairs = measured_pairs(scans_at(landmarks, 400, 5, 10));
  EXPECT_EQ(std::ranges::count(against_triangles(pairs, 9), true), 0);
  pairs[3].distance_m += 2.0;
  const std::vector<bool> against = against_triangles(pairs, 9);
  EXPECT_TRUE(against[3]);
  EXPECT_EQ(std::ranges::count(against, true), 1);
}

TEST(PairMap, ALandmarkSeenAloneIsReportedAndLeftOut) {
  const Points landmarks = scattered(8, 11);
  DetectionLog log = scans_at(landmarks, 300, 4, 11);
  log.names.push_back("Alone");
  log.detections.push_back({.step = log.steps++, .landmark = 8, .range_m = 1, .bearing_rad = 1});
  const Embedding map = pair_map_of(log).embedding;
  ASSERT_NE(first_status(map, StatusCode::kLandmarkUnseen), nullptr);
  EXPECT_EQ(first_status(map, StatusCode::kLandmarkUnseen)->names,
            std::vector<std::string>{"Alone"});
  EXPECT_TRUE(std::isnan(map.coordinates(8, 0)));
  EXPECT_LT(procrustes_gap(landmarks, map.coordinates.topRows(8)), 1e-9);
}

TEST(PairMap, OfTwoGroupsNeverSeenTogetherTheLargerIsMapped) {
  const Points landmarks = scattered(8, 12);
  DetectionLog log = scans_at(landmarks, 300, 4, 12);
  const DetectionLog far = scans_at(scattered(5, 13), 300, 3, 13);
  for (const std::string& name : far.names) log.names.push_back("far " + name);
  for (Detection seen : far.detections) {
    seen.step += 300;
    seen.landmark += 8;
    log.detections.push_back(seen);
  }
  log.steps += 300;
  const Embedding map = pair_map_of(log).embedding;
  ASSERT_NE(first_status(map, StatusCode::kTooFewObservations), nullptr);
  EXPECT_TRUE(map.coordinates.bottomRows(5).array().isNaN().all());
  EXPECT_LT(procrustes_gap(landmarks, map.coordinates.topRows(8)), 1e-9);
}

TEST(PairMap, ALandmarkMeasuredAgainstTwoOthersIsUndetermined) {
  const Points landmarks = scattered(6, 14);
  const DetectionLog log = scans_at(landmarks, 300, 4, 14);
  std::vector<MeasuredPair> pairs = measured_pairs(log);
  int kept = 0;
  std::erase_if(pairs, [&](const MeasuredPair& pair) { return pair.second == 5 && ++kept > 2; });
  const Embedding map = pair_map(pairs, log.names).embedding;
  ASSERT_NE(first_status(map, StatusCode::kUndetermined), nullptr);
  EXPECT_EQ(first_status(map, StatusCode::kUndetermined)->names, std::vector<std::string>{"F"});
}

TEST(PairMap, FewScansCountWhereThereAreNoOthers) {
  const Points landmarks = scattered(6, 15);
  const PairMap map = pair_map_of(scans_at(landmarks, 1, 6, 15));
  EXPECT_EQ(map.pairs.size(), 15U);
  EXPECT_LT(procrustes_gap(landmarks, map.embedding.coordinates), 1e-9);
}

TEST(PairMap, NothingMeasuredIsAStatus) {
  const Embedding map = pair_map({}, {"A", "B", "C"}).embedding;
  EXPECT_NE(first_status(map, StatusCode::kFailed), nullptr);
  EXPECT_TRUE(map.coordinates.array().isNaN().all());
}

TEST(PairMap, RefusesWhatAreNotPairs) {
  const std::vector<std::string> names = {"A", "B", "C"};
  EXPECT_THROW(pair_map({{.first = 1, .second = 1}}, names), InvalidInput);
  EXPECT_THROW(pair_map({{.first = 0, .second = 3}}, names), InvalidInput);
  EXPECT_THROW(pair_map({{.first = 0, .second = 1}, {.first = 0, .second = 1}}, names),
               InvalidInput);
  EXPECT_THROW(pair_map({{.first = 0, .second = 1, .distance_m = NAN}}, names), InvalidInput);
  EXPECT_THROW(pair_map({{.first = 0, .second = 1, .precision = 0}}, names), InvalidInput);
  EXPECT_THROW(pair_map({}, names, {.fewest_scans = 0}), InvalidInput);
}

RC_GTEST_PROP(PairMap, WhateverWasMeasuredGivesFiniteRowsOrSaysWhyNot, ()) {
  const int M = *rc::gen::inRange(1, 9);
  DetectionLog log;
  for (int i = 0; i < M; ++i) log.names.push_back(std::to_string(i));
  log.steps = *rc::gen::inRange(1, 8);
  const auto number = [] { return *rc::gen::element(0.0, 1e-300, 1e-6, 0.5, 1.0, 2.0, 1e6); };
  for (int step = 0; step < log.steps; ++step)
    for (int i = 0; i < M; ++i)
      if (*rc::gen::arbitrary<bool>())
        log.detections.push_back(
            {.step = step, .landmark = i, .range_m = number(), .bearing_rad = number()});
  const Embedding map = pair_map_of(log).embedding;
  RC_ASSERT(map.coordinates.rows() == M);
  RC_ASSERT(map.coordinates.allFinite() || !map.statuses.empty());
}

}  // namespace
}  // namespace mapproof
