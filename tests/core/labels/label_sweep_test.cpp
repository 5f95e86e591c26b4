// Slow: labels of the real sets swapped in one robot's log, pair by pair. Prints what
// docs/methods.md says of it.
#include <algorithm>
#include <functional>
#include <iostream>
#include <tuple>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "core/labels/mislabelled.hpp"
#include "noisy_looks.hpp"
#include "real_looks.hpp"

namespace mapproof::test {
namespace {

constexpr int kSeenWell = 30;  ///< Sightings of each label by that robot, together with others.

bool same_labels(const LabelFinding& one, int a, int b) {
  return std::minmax(one.first, one.second) == std::minmax(a, b);
}

/// What came of a swap in one robot's log.
struct Sweep {
  int tried = 0;
  int named = 0;
  int mended = 0;  ///< To nine tenths or more.
  int others = 0;  ///< Logs in which labels are named that are not named in the clean one.

  void add(const SightingLog& log, const LabelCheck& clean, int a, int b,
           const std::function<bool(int)>& in_step) {
    const SightingLog wrong = swapped(log, a, b, in_step);
    const LabelCheck check = check_labels(wrong);
    const auto is_swap = [&](const LabelFinding& one) { return same_labels(one, a, b); };
    const auto is_known = [&](const LabelFinding& one) {
      return is_swap(one) || std::ranges::any_of(clean.findings, [&](const LabelFinding& other) {
               return same_labels(one, other.first, other.second);
             });
    };
    const bool found = std::ranges::any_of(check.findings, is_swap);
    const int left = wrong_labels(check.repaired, clean.repaired);
    const bool is_mended = 10 * left <= wrong_labels(wrong, log);
    ++tried;
    named += found ? 1 : 0;
    mended += is_mended ? 1 : 0;
    others += std::ranges::all_of(check.findings, is_known) ? 0 : 1;
    if (found && is_mended) return;
    std::cout << fmt::format("{} and {}, {} labels, {} left:\n", log.names[a], log.names[b],
                             wrong_labels(wrong, log), left);
    for (const LabelFinding& one : check.findings)
      std::cout << "  " << described(one, wrong) << '\n';
  }
};

/// A set, and which third of the pairs.
class LabelSweep : public testing::TestWithParam<std::tuple<const char*, int>> {};

TEST_P(LabelSweep, NamesMostPairsSwappedInOneRobotsLog) {
  const auto [set, third] = GetParam();
  const std::optional<SightingSource> source = real_looks(set);
  if (!source) GTEST_SKIP() << "MAPPROOF_MRCLAM does not name the folder of the sets";
  const SightingLog& log = source->log;
  const std::vector<int> robots = robots_of(log);
  const LabelCheck clean = check_labels(log);
  Sweep sweep;
  for (int a = 0; a < 15; ++a)
    for (int b = a + 1; b < 15; ++b) {
      if ((a + 14 * b) % 3 != third) continue;
      const int robot = (a + b) % (robots.back() + 1);
      if (shared_sightings(log, robots, robot, a) < kSeenWell ||
          shared_sightings(log, robots, robot, b) < kSeenWell)
        continue;
      sweep.add(log, clean, a, b,
                [&](int step) { return robots[static_cast<std::size_t>(step)] == robot; });
    }
  std::cout << fmt::format("{}, third {}: {} pairs, {} named, {} mended, others named in {}\n", set,
                           third, sweep.tried, sweep.named, sweep.mended, sweep.others);
  EXPECT_GE(sweep.named, 0.9 * sweep.tried);
}

INSTANTIATE_TEST_SUITE_P(Mrclam, LabelSweep,
                         testing::Combine(testing::Values("dataset2", "dataset3"),
                                          testing::Values(0, 1, 2)));

}  // namespace
}  // namespace mapproof::test
