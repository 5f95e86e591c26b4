#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "core/align/diagonal_anchors.hpp"
#include "core/pairs/pair_map.hpp"
#include "core/records/detections/mrclam.hpp"
#include "core/score/map_score.hpp"

namespace mapproof {
namespace {

/// A set of the real data with the largest error of its map that passes.
struct RealSet {
  const char* name;
  double most_m;  ///< Mean over the landmarks that are not anchors.
};

class MrclamPairs : public testing::TestWithParam<RealSet> {};

/// MPE of the map of the scans, in the frame of the anchors.
double mpe_m(const DetectionLog& log, const Points& ground_truth_m) {
  const std::vector<Eigen::Index> anchors = diagonal_anchors(ground_truth_m);
  const AffineFit fit = AffineFit::kLeastDistances;
  const AlignedMap map =
      align_to_anchors(pair_map_of(log).embedding.coordinates, ground_truth_m, anchors, fit);
  return score_map(map.positions_m, ground_truth_m, anchors, fit).value().mpe_m;
}

/// The log with so many detections of one landmark, spread evenly, under another's name.
DetectionLog misnamed(DetectionLog log, const std::string& from, const std::string& to, int count) {
  const auto row = [&](const std::string& name) {
    return static_cast<int>(std::ranges::find(log.names, name) - log.names.begin());
  };
  const int a = row(from);
  const int b = row(to);
  std::vector<std::size_t> positions;
  for (std::size_t k = 0; k < log.detections.size(); ++k) {
    const auto is_there = [&](const Detection& other) {
      return other.step == log.detections[k].step && other.landmark == b;
    };
    if (log.detections[k].landmark == a && std::ranges::none_of(log.detections, is_there))
      positions.push_back(k);
  }
  for (int i = 0; i < count; ++i)
    log.detections[positions[positions.size() * static_cast<std::size_t>(i) /
                             static_cast<std::size_t>(count)]]
        .landmark = b;
  std::ranges::sort(log.detections, {},
                    [](const Detection& seen) { return std::pair(seen.step, seen.landmark); });
  return log;
}

TEST_P(MrclamPairs, LieWhereTheyWereSurveyed) {
  const char* folder = std::getenv("MAPPROOF_MRCLAM");
  if (folder == nullptr) GTEST_SKIP() << "MAPPROOF_MRCLAM does not name the folder of the sets";
  const DetectionSource source =
      read_mrclam_detections(std::filesystem::path(folder) / GetParam().name);
  ASSERT_TRUE(source.ground_truth_m.has_value());
  EXPECT_LE(mpe_m(source.log, *source.ground_truth_m), GetParam().most_m);
}

TEST_P(MrclamPairs, StayThereIfAFewDetectionsHaveAWrongName) {
  const char* folder = std::getenv("MAPPROOF_MRCLAM");
  if (folder == nullptr) GTEST_SKIP() << "MAPPROOF_MRCLAM does not name the folder of the sets";
  const DetectionSource source =
      read_mrclam_detections(std::filesystem::path(folder) / GetParam().name);
  for (const auto& [from, to] : {std::pair("20", "7"), std::pair("6", "18"), std::pair("16", "9"),
                                 std::pair("8", "15"), std::pair("19", "12")})
    for (const int count : {5, 15, 25})
      EXPECT_LE(mpe_m(misnamed(source.log, from, to, count), *source.ground_truth_m),
                1.25 * GetParam().most_m)
          << from << " called " << to << " in " << count;
}

INSTANTIATE_TEST_SUITE_P(Sets, MrclamPairs,
                         testing::Values(RealSet{"dataset2", 0.20}, RealSet{"dataset3", 0.07}),
                         [](const auto& set) { return std::string(set.param.name); });

}  // namespace
}  // namespace mapproof
