#include "core/map_fit/pair_fit.hpp"

#include <gtest/gtest.h>

namespace mapproof {
namespace {

MeasuredPair pair(int a, int b, int scans = 5) {
  return {.first = a, .second = b, .distance_m = 1.0, .precision = 1.0, .scans = scans};
}

/// All pairs of some landmarks.
void add_clique(std::vector<MeasuredPair>& pairs, int begin, int end) {
  for (int a = begin; a < end; ++a)
    for (int b = a + 1; b < end; ++b) pairs.push_back(pair(a, b));
}

std::vector<std::vector<int>> parts_of(const std::vector<MeasuredPair>& pairs,
                                       std::size_t landmarks,
                                       const std::vector<SeenOrientation>& turns = {}) {
  std::vector<std::vector<int>> parts;
  for (const RigidPart& part : rigid_parts(pairs, turns, std::vector<bool>(landmarks, true)).parts)
    parts.push_back(part.landmarks);
  return parts;
}

TEST(RigidParts, AreOneWhereEveryPairIsMeasured) {
  std::vector<MeasuredPair> pairs;
  add_clique(pairs, 0, 6);
  EXPECT_EQ(parts_of(pairs, 6), (std::vector<std::vector<int>>{{0, 1, 2, 3, 4, 5}}));
}

TEST(RigidParts, TwoGroupsNeedFourPairs) {
  std::vector<MeasuredPair> pairs;
  add_clique(pairs, 0, 4);
  add_clique(pairs, 4, 8);
  for (const auto& [a, b] : {std::pair(0, 4), std::pair(1, 5), std::pair(2, 6)})
    pairs.push_back(pair(a, b));
  EXPECT_EQ(parts_of(pairs, 8).size(), 2U);  // Three bars leave folds.
  pairs.push_back(pair(3, 7));
  EXPECT_EQ(parts_of(pairs, 8).size(), 1U);
}

TEST(RigidParts, PairsOfOneOrTwoScansHoldNothing) {
  std::vector<MeasuredPair> pairs;
  add_clique(pairs, 0, 4);
  add_clique(pairs, 4, 8);
  for (int k = 0; k < 4; ++k) pairs.push_back(pair(k, k + 4, 2));
  const RigidParts found = rigid_parts(pairs, {}, std::vector<bool>(8, true));
  ASSERT_EQ(found.parts.size(), 2U);
  EXPECT_EQ(found.parts[1].pairs, 4);
  EXPECT_EQ(found.parts[1].scans, 8);
}

TEST(RigidParts, AnOrientationThatWasSeenReplacesTheThirdPair) {
  std::vector<MeasuredPair> pairs;
  add_clique(pairs, 0, 4);
  pairs.push_back(pair(0, 4));
  pairs.push_back(pair(1, 4));
  EXPECT_EQ(parts_of(pairs, 5).size(), 2U);
  const SeenOrientation seen{.first = 0, .second = 1, .third = 4, .scans = 5, .direction = 1.0};
  EXPECT_EQ(parts_of(pairs, 5, {seen}).size(), 1U);
}

TEST(RigidParts, EachLandmarkIsInOnePart) {
  std::vector<MeasuredPair> pairs;
  add_clique(pairs, 0, 4);
  add_clique(pairs, 3, 7);  // They share a landmark, and turn about it.
  const auto parts = parts_of(pairs, 8);
  EXPECT_EQ(parts, (std::vector<std::vector<int>>{{0, 1, 2, 3}, {4, 5, 6}, {7}}));
}

}  // namespace
}  // namespace mapproof
