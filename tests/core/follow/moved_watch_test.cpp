#include "core/follow/moved_watch.hpp"

#include <algorithm>

#include <gtest/gtest.h>

#include "core/base/random.hpp"
#include "tests/core/labels/noisy_looks.hpp"
#include "tests/support/looks.hpp"

namespace mapproof::test {
namespace {

/// Landmark 7 stands half a metre elsewhere from one look on.
SightingLog half_metre_move(int looks, int from) {
  return looks_with_move(looks, 7, {0.3, -0.4}, from);
}

/// Feeds a log look by look; calls `each` after every one, with the log so far.
template <class Each>
void follow(const SightingLog& log, FollowedLog& looks, const Each& each) {
  auto at = log.sightings.begin();
  for (int step = 0; step < log.steps; ++step) {
    std::vector<Sighting> look;
    for (; at != log.sightings.end() && at->step == step; ++at) look.push_back(*at);
    looks.add({0, static_cast<double>(step)}, look);
    each(step + 1);
  }
}

TEST(MovedWatch, NoticesAMoveSoonAfterItWithItsTimeAndOnce) {
  const SightingLog log = half_metre_move(800, 400);
  FollowedLog looks;
  MovedWatch watch;
  std::vector<std::pair<int, NoticedMove>> noticed;
  follow(log, looks, [&](int so_far) {
    if (!watch.is_due(so_far)) return;
    for (const NoticedMove& move : watch.check(looks, looks.log(log.names, false)))
      noticed.emplace_back(so_far, move);
  });
  ASSERT_EQ(noticed.size(), 1U);
  EXPECT_LT(noticed.front().first, 620);
  EXPECT_EQ(noticed.front().second.found.landmark, 7);
  EXPECT_NEAR(watch.moved().front().from.key, 400.0, 15.0);
  EXPECT_LT(noticed.front().second.found.earliest_step, noticed.front().second.found.latest_step);

  const SightingLog split = watch.split(looks, looks.log(log.names, false));
  ASSERT_EQ(split.names.size(), log.names.size() + 1);
  EXPECT_EQ(split.names.back(), log.names[7] + " (moved)");
  const auto later = static_cast<int>(split.names.size()) - 1;
  for (const Sighting& one : split.sightings) {
    EXPECT_FALSE(one.step < 380 && one.landmark == later) << one.step;
    EXPECT_FALSE(one.step > 420 && one.landmark == 7) << one.step;
  }
}

TEST(MovedWatch, RaisesHardlyAnAlarmOverAllItsChecksWhereNothingMoves) {
  int alarms = 0;
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const SightingLog log = noisy_looks(600, seed);
    FollowedLog looks;
    MovedWatch watch({.permutations = 399, .least_move = 0.0});
    follow(log, looks, [&](int so_far) {
      if (watch.is_due(so_far)) watch.check(looks, looks.log(log.names, false));
    });
    alarms += watch.moved().empty() ? 0 : 1;
  }
  // 5 % of 20 is one; five or more come by chance in 3 of 1000.
  EXPECT_LT(alarms, 5);
}

}  // namespace
}  // namespace mapproof::test
