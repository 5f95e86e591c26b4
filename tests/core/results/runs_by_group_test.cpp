#include <gtest/gtest.h>

#include "core/results/values_by_run.hpp"

namespace mapproof::test {
namespace {

ValuesByRun values_of(const std::vector<std::pair<std::string, double>>& runs) {
  ValuesByRun values;
  for (const auto& [run, value] : runs) values[run] = value;
  return values;
}

std::vector<double> means_of(const ValuesByRun& values, const RunsByGroup& runs) {
  return runs.means(
      [&](std::size_t run) { return values.begin()[static_cast<std::ptrdiff_t>(run)].second; });
}

TEST(RunsByGroup, HaveTheMeanOfEachGroupInTheOrderOfTheGroups) {
  const ValuesByRun values = values_of({{"r1", 1.0}, {"r2", 2.0}, {"r3", 3.0}, {"r4", 8.0}});
  GroupsByRun groups;
  groups.set("r1", "z");
  groups.set("r2", "a");
  groups.set("r3", "z");
  const RunsByGroup runs(values, groups);
  EXPECT_EQ(runs.groups(), 3U);
  EXPECT_EQ(means_of(values, runs), (std::vector<double>{2.0, 8.0, 2.0}))
      << "a; r4, which is a group of its own; z";
}

TEST(RunsByGroup, AreTheRunsWhereEachIsAGroup) {
  const ValuesByRun values = values_of({{"r1", 1.0}, {"r2", 2.0}});
  const RunsByGroup runs(values, {});
  EXPECT_EQ(means_of(values, runs), (std::vector<double>{1.0, 2.0}));
  EXPECT_TRUE(means_of({}, RunsByGroup({}, {})).empty());
}

}  // namespace
}  // namespace mapproof::test
