// Numbers of this processor and of another one, whose MAPPROOF_NUMBERS names the file: what
// mapproof_numbers printed there. scripts/check aarch64 makes it.
#include <algorithm>
#include <cmath>
#include <cstdlib>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "core/base/files/files.hpp"
#include "core/model/method.hpp"
#include "core/model/slam/slam_study.hpp"
#include "tests/core/processors/numbers.hpp"
#include "tests/support/temporary_folder.hpp"

namespace mapproof {
namespace {

using test::differences;
using test::Numbers;

double largest(const std::map<std::string, double>& differences) {
  double largest = 0.0;
  for (const auto& [block, difference] : differences) largest = std::max(largest, difference);
  return largest;
}

TEST(AcrossProcessors, NumbersAgreeWithinTheTolerance) {
  const char* other = std::getenv("MAPPROOF_NUMBERS");
  if (other == nullptr) GTEST_SKIP() << "MAPPROOF_NUMBERS names no numbers of another processor";
  const std::map<std::string, double> found =
      differences(test::numbers(), test::read_numbers(other));
  for (const auto& [block, difference] : found) {
    fmt::print("{:.1e} {}\n", difference, block);
    EXPECT_LE(difference, test::across_processors(block)) << block;
  }
  fmt::print("{} blocks, {} with the same bits, largest difference {:.1e}\n", found.size(),
             std::ranges::count(found, 0.0, &std::pair<const std::string, double>::second),
             largest(found));
}

TEST(AcrossProcessors, EveryMethodGivesNumbersToCompare) {
  const Numbers numbers = test::numbers();
  const auto is_reported = [](const std::string& block, const std::vector<double>& values) {
    EXPECT_FALSE(values.empty()) << block;
    EXPECT_TRUE(std::ranges::all_of(values, [](double v) { return std::isfinite(v); })) << block;
  };
  for (const MethodInfo& method : all_methods()) {
    const std::string start = "map/bearing-1/" + std::string(method.name);
    const auto map = numbers.lower_bound(start);
    ASSERT_TRUE(map != numbers.end() && map->first.starts_with(start)) << start;
    is_reported(map->first, map->second);
  }
  for (const SlamMethodInfo& method : all_slam_methods()) {
    if (method.method == SlamMethod::kRepaired) continue;  // Only of logs that do not fit.
    for (const char* part : {"slam/path/", "slam/landmarks/"}) {
      const std::string block = part + std::string(method.name);
      ASSERT_TRUE(numbers.contains(block)) << block;
      if (block != "slam/landmarks/dead-reckoning") is_reported(block, numbers.at(block));
    }
  }
}

TEST(AcrossProcessors, ADifferenceIsOfTheLargestNumberOfItsBlock) {
  const Numbers one{{"map", {100.0, 1.0}}, {"error", {1.0}}};
  const Numbers other{{"map", {100.0, 1.5}}, {"error", {1.25}}};
  EXPECT_EQ(differences(one, other),
            (std::map<std::string, double>{{"error", 0.2}, {"map", 0.005}}));
}

TEST(AcrossProcessors, WhatOneSideLacksIsInfinitelyFar) {
  const double nan = std::nan("");
  const Numbers one{{"map", {1.0, nan}}};
  for (const Numbers& other : {Numbers{}, Numbers{{"map", {1.0}}}, Numbers{{"map", {1.0, 0.0}}},
                               Numbers{{"other", {1.0, nan}}}}) {
    EXPECT_TRUE(std::isinf(largest(differences(one, other))));
    EXPECT_TRUE(std::isinf(largest(differences(other, one))));
  }
  EXPECT_EQ(largest(differences(one, one)), 0.0);
}

TEST(AcrossProcessors, AFileKeepsEveryBit) {
  const test::TemporaryFolder folder;
  const Numbers numbers{{"map", {1.0 / 3.0, -5e-324, 1e300, std::nan("")}}, {"path", {0.1}}};
  write_file(folder.path() / "numbers.json", test::text_of(numbers));
  const Numbers read = test::read_numbers(folder.path() / "numbers.json");
  EXPECT_EQ(largest(differences(numbers, read)), 0.0);
  EXPECT_EQ(read.at("map")[1], -5e-324);
}

}  // namespace
}  // namespace mapproof
