#include <cstdlib>
#include <filesystem>

#include <gtest/gtest.h>

#include "core/align/diagonal_anchors.hpp"
#include "core/pairs/pair_map.hpp"
#include "core/records/mrclam.hpp"
#include "core/score/map_score.hpp"

namespace mapproof {
namespace {

/// A set of the real data with the most that its map may be off.
struct RealSet {
  const char* name;
  double most_m;  ///< Mean over the landmarks that are no anchors.
};

class MrclamPairs : public testing::TestWithParam<RealSet> {};

TEST_P(MrclamPairs, LieWhereTheyWereSurveyed) {
  const char* folder = std::getenv("MAPPROOF_MRCLAM");
  if (folder == nullptr) GTEST_SKIP() << "MAPPROOF_MRCLAM does not name the folder of the sets";
  const SightingSource source =
      read_mrclam_sightings(std::filesystem::path(folder) / GetParam().name);
  ASSERT_TRUE(source.truth_m.has_value());
  const std::vector<Eigen::Index> anchors = diagonal_anchors(*source.truth_m);
  const AffineFit fit = AffineFit::kLeastDistances;
  const AlignedMap map = align_to_anchors(sighted_map(source.log).embedding.coordinates,
                                          *source.truth_m, anchors, fit);
  const std::optional<Score> score = score_map(map.positions_m, *source.truth_m, anchors, fit);
  ASSERT_TRUE(score.has_value());
  EXPECT_LE(score->mpe_m, GetParam().most_m);
  RecordProperty("mpe_m", std::to_string(score->mpe_m));
}

INSTANTIATE_TEST_SUITE_P(Sets, MrclamPairs,
                         testing::Values(RealSet{"dataset2", 0.20}, RealSet{"dataset3", 0.07}),
                         [](const auto& set) { return std::string(set.param.name); });

}  // namespace
}  // namespace mapproof
