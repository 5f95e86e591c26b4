#include <algorithm>
#include <map>

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "core/results/values_by_run.hpp"

namespace mapproof {
namespace {

/// Rows with few names, so that many are equal in some of their members.
std::vector<Result> arbitrary_rows() {
  const auto name = rc::gen::elementOf(std::vector<std::string>{"", "a", "b", "aa", "B", "é"});
  std::vector<Result> rows;
  const int count = *rc::gen::inRange(0, 40);
  for (int i = 0; i < count; ++i) {
    std::vector<Level> levels;
    if (*rc::gen::arbitrary<bool>())
      levels.push_back({"noise", *rc::gen::elementOf(std::vector{-1.0, -0.0, 0.0, 10.0, 9.0})});
    if (*rc::gen::arbitrary<bool>()) levels.push_back({"terrain", *name});
    rows.push_back({.at = condition(*name, std::move(levels)),
                    .method = *name,
                    .quantity = *name,
                    .run = *name,
                    .subject = *name,
                    .value = i * 1.0});
  }
  return rows;
}

RC_GTEST_PROP(ResultsOrder, IsThatOfAStableSortByNamesAndLevels, ()) {
  Results results{.rows = arbitrary_rows()};
  std::vector<Result> expected = results.rows;
  std::ranges::stable_sort(expected, comes_before);
  sort_results(results);
  RC_ASSERT(results.rows.size() == expected.size());
  for (std::size_t i = 0; i < expected.size(); ++i)
    RC_ASSERT(results.rows[i].value == expected[i].value);
}

RC_GTEST_PROP(ValuesByRun, AreWhatAMapOfNamesHas, ()) {
  const auto name = rc::gen::elementOf(std::vector<std::string>{"", "1", "10", "2", "a", "é"});
  std::map<std::string, double> expected, other_expected;
  ValuesByRun values, others;
  const int count = *rc::gen::inRange(0, 20);
  for (int i = 0; i < count; ++i) {
    const std::string run = *name, other = *name;
    values[run] = expected[run] = i;
    others[other] = other_expected[other] = -i;
  }
  for (const char* run : {"", "1", "3", "a"}) {
    RC_ASSERT(values.contains(run) == expected.contains(run));
    if (values.contains(run)) RC_ASSERT(*values.find(run) == expected.at(run));
  }
  values.merge(others);
  expected.merge(other_expected);
  RC_ASSERT(std::ranges::equal(values, expected, [](const auto& a, const auto& b) {
    return a.first == b.first && a.second == b.second;
  }));
  values.keep({"10", "a"});
  std::erase_if(expected, [](const auto& one) { return one.first != "10" && one.first != "a"; });
  RC_ASSERT(values.size() == expected.size());
}

TEST(GroupsByRun, CountEachRunOnce) {
  GroupsByRun groups;
  for (const char* run : {"b2", "a1", "b1", "a1"}) groups.set(run, std::string(run, 1));
  EXPECT_EQ(groups.size(), 3U);
  EXPECT_EQ(groups.runs(), (std::vector<Name>{"a1", "b1", "b2"}));
  EXPECT_EQ(*groups.find("b2"), "b");
  EXPECT_EQ(groups.find("no such run"), std::nullopt);
}

TEST(GroupsByRun, KnowRunsThatAreTheirOwnGroupBesideOthers) {
  GroupsByRun groups;
  for (const char* run : {"alone", "other", "again"}) groups.set(run, run);
  groups.set("other", "group");
  groups.set("nameless", "");
  groups.set("again", "group");
  groups.set("again", "again");
  EXPECT_EQ(*groups.find("alone"), "alone");
  EXPECT_EQ(*groups.find("other"), "group");
  EXPECT_EQ(*groups.find("nameless"), "");
  EXPECT_EQ(*groups.find("again"), "again");
}

}  // namespace
}  // namespace mapproof
