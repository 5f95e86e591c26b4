// Slow: the landmark IDs of the real sets made wrong in several ways, pair by pair. Prints the
// numbers of docs/methods/measurements.md.
#include <algorithm>
#include <functional>
#include <iostream>
#include <tuple>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "core/association/anchor_ids.hpp"
#include "core/association/association_check.hpp"
#include "noisy_scans.hpp"
#include "real_scans.hpp"

namespace mapproof::test {
namespace {

constexpr int kSeenWell = 30;  ///< Detections of each landmark by that robot, together with others.

bool same_ids(const AssociationFinding& one, int a, int b) {
  return std::minmax(one.first, one.second) == std::minmax(a, b);
}

/// The result of a swap in one robot's log.
struct Sweep {
  int tried = 0;
  int named = 0;
  int corrected = 0;  ///< To nine tenths or more.
  int others = 0;     ///< Logs in which IDs are named that are not named in the clean one.

  void add(const DetectionLog& log, const AssociationCheck& clean, int a, int b,
           const std::function<bool(int)>& in_step) {
    const DetectionLog wrong = swapped(log, a, b, in_step);
    const AssociationCheck check = check_association(wrong);
    const auto is_swap = [&](const AssociationFinding& one) { return same_ids(one, a, b); };
    const auto is_known = [&](const AssociationFinding& one) {
      return is_swap(one) ||
             std::ranges::any_of(clean.findings, [&](const AssociationFinding& other) {
               return same_ids(one, other.first, other.second);
             });
    };
    const bool found = std::ranges::any_of(check.findings, is_swap);
    const int left = wrong_ids(check.repaired, clean.repaired);
    const bool is_corrected = 10 * left <= wrong_ids(wrong, log);
    ++tried;
    named += found ? 1 : 0;
    corrected += is_corrected ? 1 : 0;
    others += std::ranges::all_of(check.findings, is_known) ? 0 : 1;
    if (found && is_corrected) return;
    std::cout << fmt::format("{} and {}, {} IDs, {} left:\n", log.names[a], log.names[b],
                             wrong_ids(wrong, log), left);
    for (const AssociationFinding& one : check.findings)
      std::cout << fmt::format("  {} {}, {}\n", name(one.fault), one.first, one.second);
  }
};

/// The number-th of all pairs of 15 landmarks.
std::pair<int, int> pair_of(int number) {
  int a = 0;
  for (; number >= 14 - a; ++a) number -= 14 - a;
  return {a, a + 1 + number};
}

/// A set, and which third of the pairs.
class AssociationSweep : public testing::TestWithParam<std::tuple<const char*, int>> {};

TEST_P(AssociationSweep, NamesMostPairsSwappedInOneRobotsLog) {
  const auto [set, third] = GetParam();
  const std::optional<DetectionSource> source = real_scans(set);
  if (!source) GTEST_SKIP() << "MAPPROOF_MRCLAM does not name the folder of the sets";
  const DetectionLog& log = source->log;
  const std::vector<int> robots = robots_of(log);
  const AssociationCheck clean = check_association(log);
  Sweep sweep;
  for (int a = 0; a < 15; ++a)
    for (int b = a + 1; b < 15; ++b) {
      if ((a + 14 * b) % 3 != third) continue;
      const int robot = (a + b) % (robots.back() + 1);
      if (shared_detections(log, robots, robot, a) < kSeenWell ||
          shared_detections(log, robots, robot, b) < kSeenWell)
        continue;
      sweep.add(log, clean, a, b,
                [&](int step) { return robots[static_cast<std::size_t>(step)] == robot; });
    }
  std::cout << fmt::format("{}, third {}: {} pairs, {} named, {} corrected, others named in {}\n",
                           set, third, sweep.tried, sweep.named, sweep.corrected, sweep.others);
  EXPECT_GE(sweep.named, 0.9 * sweep.tried);
}

/// Faults in single scans or over a part of the time, of every tenth pair of landmarks.
class FaultSweep : public testing::TestWithParam<std::tuple<const char*, const char*>> {};

TEST_P(FaultSweep, LeavesMostMapsAsGoodAsOnesWithoutFaults) {
  const auto [set, kind] = GetParam();
  const std::optional<DetectionSource> source = real_scans(set);
  if (!source) GTEST_SKIP() << "MAPPROOF_MRCLAM does not name the folder of the sets";
  const DetectionLog& log = source->log;
  const double sound_m = map_error_m(log, *source->ground_truth_m);
  int tried = 0;
  int named = 0;
  int others = 0;
  std::vector<double> ratios;
  for (int number = 3; number < 105; number += 10) {
    const auto [a, b] = pair_of(number);
    const DetectionLog wrong = with_fault(log, kind, a, b, static_cast<std::uint64_t>(number));
    const AssociationCheck check = check_association(wrong);
    const auto is_right = [&](const AssociationFinding& one) { return same_ids(one, a, b); };
    const bool found = std::ranges::any_of(check.findings, is_right);
    const bool other = !std::ranges::all_of(check.findings, is_right);
    const DetectionLog corrected =
        check_anchor_ids(check.repaired, *source->ground_truth_m).repaired;
    ++tried;
    named += found ? 1 : 0;
    others += other ? 1 : 0;
    ratios.push_back(map_error_m(corrected, *source->ground_truth_m) / sound_m);
    std::cout << fmt::format("{} {}, {} and {}: {}{}, map {:.2f} -> {:.2f} times as far off\n", set,
                             kind, log.names[a], log.names[b], found ? "named" : "not named",
                             other ? ", others too" : "",
                             map_error_m(wrong, *source->ground_truth_m) / sound_m, ratios.back())
              << std::flush;
  }
  const auto within = [&](double most) {
    return std::ranges::count_if(ratios, [&](double ratio) { return ratio <= most; });
  };
  std::cout << fmt::format(
      "{} {}: {} pairs, {} named, others named in {}, map within 1.2 in {}, "
      "within 2 in {}\n",
      set, kind, tried, named, others, within(1.2), within(2.0));
  EXPECT_GE(named, 0.7 * tried);
}

INSTANTIATE_TEST_SUITE_P(Mrclam, FaultSweep,
                         testing::Combine(testing::Values("dataset2", "dataset3"),
                                          testing::Values("half", "tenth", "stretch", "replaced30",
                                                          "replaced70")));

INSTANTIATE_TEST_SUITE_P(Mrclam, AssociationSweep,
                         testing::Combine(testing::Values("dataset2", "dataset3"),
                                          testing::Values(0, 1, 2)));

}  // namespace
}  // namespace mapproof::test
