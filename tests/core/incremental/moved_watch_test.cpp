#include "core/incremental/incremental_map.hpp"

#include <algorithm>

#include <gtest/gtest.h>

#include "core/base/random.hpp"
#include "tests/core/association/noisy_scans.hpp"
#include "tests/support/samples/scans.hpp"

namespace mapproof::test {
namespace {

/// Landmark 7 is half a metre away from one scan on.
DetectionLog half_metre_move(int scans, int from) {
  return scans_with_move(scans, 7, {0.3, -0.4}, from);
}

/// Feeds a log scan by scan; calls `each` after every one, with the log so far.
template <class Each>
void each_step(const DetectionLog& log, IncrementalLog& scans, const Each& each) {
  auto at = log.detections.begin();
  for (int step = 0; step < log.steps; ++step) {
    std::vector<Detection> scan;
    for (; at != log.detections.end() && at->step == step; ++at) scan.push_back(*at);
    scans.add({0, static_cast<double>(step)}, scan);
    each(step + 1);
  }
}

TEST(MovedWatch, NoticesAMoveSoonAfterItWithItsTimeAndOnce) {
  const DetectionLog log = half_metre_move(800, 400);
  IncrementalLog scans;
  MovedWatch watch;
  std::vector<std::pair<int, NoticedMove>> noticed;
  each_step(log, scans, [&](int so_far) {
    if (!watch.is_due(so_far)) return;
    for (const NoticedMove& move : watch.check(scans, scans.log(log.names, false)))
      noticed.emplace_back(so_far, move);
  });
  ASSERT_EQ(noticed.size(), 1U);
  EXPECT_LT(noticed.front().first, 620);
  EXPECT_EQ(noticed.front().second.found.landmark, 7);
  EXPECT_NEAR(watch.moved().front().from.key, 400.0, 15.0);
  EXPECT_LT(noticed.front().second.found.earliest_step, noticed.front().second.found.latest_step);

  const DetectionLog split = watch.split(scans, scans.log(log.names, false));
  ASSERT_EQ(split.names.size(), log.names.size() + 1);
  EXPECT_EQ(split.names.back(), log.names[7] + " (moved)");
  const auto later = static_cast<int>(split.names.size()) - 1;
  for (const Detection& one : split.detections) {
    EXPECT_FALSE(one.step < 380 && one.landmark == later) << one.step;
    EXPECT_FALSE(one.step > 420 && one.landmark == 7) << one.step;
  }
}

TEST(MovedWatch, RaisesHardlyAnAlarmOverAllItsChecksWhereNothingMoves) {
  int alarms = 0;
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const DetectionLog log = noisy_scans(600, seed);
    IncrementalLog scans;
    MovedWatch watch({.permutations = 399, .least_move = 0.0});
    each_step(log, scans, [&](int so_far) {
      if (watch.is_due(so_far)) watch.check(scans, scans.log(log.names, false));
    });
    alarms += watch.moved().empty() ? 0 : 1;
  }
  // 5 % of 20 is one; five or more come by chance in 3 of 1000.
  EXPECT_LT(alarms, 5);
}

}  // namespace
}  // namespace mapproof::test
