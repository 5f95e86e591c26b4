#include "core/uncertainty/pair_uncertainty.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "core/base/errors.hpp"
#include "core/base/random.hpp"
#include "core/pairs/pair_map.hpp"
#include "tests/support/samples/scans.hpp"
#include "tests/support/samples/worlds.hpp"

namespace mapproof::test {
namespace {

constexpr int kScans = 400;

Points hall() { return 6.0 * scattered(9, 5); }

/// Scans with errors of 5 % of each range, equal in `together` consecutive scans.
DetectionLog erring_scans(std::uint64_t seed, int together) {
  DetectionLog log = scans_at(hall(), kScans, 4, seed);
  Random random(1000 + seed);
  std::vector<double> errors(9 * (kScans / static_cast<std::size_t>(together) + 1));
  for (double& error : errors) error = 0.05 * random.normal();
  for (Detection& seen : log.detections)
    seen.range_m *=
        1.0 + errors[static_cast<std::size_t>(9 * (seen.step / together) + seen.landmark)];
  return log;
}

/// Mean squared distance of a landmark from its mean position, over maps of many logs.
double spread(int together, const UncertaintyFrame& frame) {
  constexpr int kMaps = 240;
  std::vector<Points> maps;
  Points mean = Points::Zero(9, 2);
  for (int k = 0; k < kMaps; ++k) {
    const Points own = pair_map_of(erring_scans(100 + static_cast<std::uint64_t>(k), together))
                           .embedding.coordinates;
    maps.push_back(*in_frame(own, frame, AffineFit::kLeastDistances));
    mean += maps.back() / kMaps;
  }
  double sum = 0.0;
  for (const Points& map : maps) sum += (map - mean).squaredNorm();
  return sum / (9.0 * (kMaps - 1));
}

/// The same by the covariances of several logs.
double reported(int together, const UncertaintyFrame& frame,
                const PairUncertaintyOptions& options) {
  constexpr int kLogs = 8;
  double sum = 0.0;
  for (std::uint64_t k = 1; k <= kLogs; ++k)
    for (const Eigen::Matrix2d& C :
         pair_uncertainty(erring_scans(k, together), frame, options).covariances)
      sum += C.trace();
  return sum / (9.0 * kLogs);
}

class UncertaintyOfPairs
    : public ::testing::TestWithParam<std::pair<const char*, UncertaintyFrame>> {};

TEST_P(UncertaintyOfPairs, IsHowFarMapsOfOtherScansLieApart) {
  const UncertaintyFrame& frame = GetParam().second;
  const double ratio = reported(1, frame, {.replicates = 60}) / spread(1, frame);
  EXPECT_GT(ratio, 0.7);
  EXPECT_LT(ratio, 1.6);
}

TEST_P(UncertaintyOfPairs, IsZeroWhereScansHaveNoErrors) {
  for (const Eigen::Matrix2d& C :
       pair_uncertainty(scans_at(hall(), kScans, 4, 1), GetParam().second, {.replicates = 20})
           .covariances)
    EXPECT_LT(C.norm(), 1e-12);
}

INSTANTIATE_TEST_SUITE_P(
    Uncertainty, UncertaintyOfPairs,
    ::testing::Values(std::pair("rigid", UncertaintyFrame{hall(), {}, true}),
                      std::pair("anchors", UncertaintyFrame{hall(), {0, 3, 5, 8}, false}),
                      std::pair("rigid_on_anchors", UncertaintyFrame{hall(), {0, 3, 5, 8}, true})),
    [](const auto& one) { return std::string(one.param.first); });

TEST(PairUncertainty, DrawsScansWithCorrelatedErrorsTogether) {
  const UncertaintyFrame frame{hall(), {}, true};
  EXPECT_LE(pair_block_length(erring_scans(1, 1)), 4);
  EXPECT_GE(pair_block_length(erring_scans(1, 40)), 7);
  const double apart = spread(40, frame);
  const double by_blocks = reported(40, frame, {.replicates = 60});
  EXPECT_GT(by_blocks, 1.2 * reported(40, frame, {.replicates = 60, .block = 1}));
  EXPECT_NEAR(by_blocks, apart, 0.4 * apart);
}

TEST(PairUncertainty, DependsOnItsSeedAlone) {
  const DetectionLog log = erring_scans(3, 1);
  const UncertaintyFrame frame{hall(), {}, true};
  const PairUncertaintyOptions options{.replicates = 10, .block = 5, .seed = 4};
  EXPECT_EQ(pair_uncertainty(log, frame, options), pair_uncertainty(log, frame, options));
  PairUncertaintyOptions other = options;
  other.seed = 5;
  EXPECT_NE(pair_uncertainty(log, frame, options), pair_uncertainty(log, frame, other));
  EXPECT_EQ(pair_uncertainty(log, frame, options).block_steps, 5);
}

TEST(PairUncertainty, RefusesOtherFramesAndEmptyLogs) {
  const DetectionLog log = erring_scans(3, 1);
  EXPECT_THROW(pair_uncertainty(log, {Points::Zero(3, 2), {}}), InvalidInput);
  EXPECT_THROW(
      pair_uncertainty({.names = {"a"}, .detections = {}, .times_s = {}}, {Points::Zero(1, 2), {}}),
      InvalidInput);
  EXPECT_THROW(pair_uncertainty(log, {hall(), {}}, {.block = kScans + 1}), InvalidInput);
  EXPECT_EQ(pair_block_length({}), 1);
}

}  // namespace
}  // namespace mapproof::test
