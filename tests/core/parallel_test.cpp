#include "core/base/parallel.hpp"

#include <array>
#include <atomic>
#include <stdexcept>
#include <vector>

#include <gtest/gtest.h>

namespace mapproof {
namespace {

TEST(Parallel, CallsForEveryNumberOnce) {
  for (const int jobs : {1, 2, 7})
    for (const std::size_t count : {0U, 1U, 2U, 1000U}) {
      std::vector<std::atomic<int>> calls(count);
      parallel_for(count, [&](std::size_t i) { ++calls[i]; });
      parallel_for(jobs, count, [&](std::size_t i) { ++calls[i]; });
      for (const std::atomic<int>& made : calls) EXPECT_EQ(made, 2);
    }
}

TEST(Parallel, ThrowsWhatAPieceThrew) {
  const auto fail = [](std::size_t i) {
    if (i == 7) throw std::out_of_range("seven");
  };
  EXPECT_THROW(parallel_for(100, fail), std::out_of_range);
  EXPECT_THROW(parallel_for(3, 100, fail), std::out_of_range);
  EXPECT_THROW(parallel_invoke([] {}, [&] { fail(7); }), std::out_of_range);
  EXPECT_THROW(run_isolated([&] { fail(7); }), std::out_of_range);
}

/// What fails around it must not let inner work return undone: its callers would go on with
/// nothing.
TEST(Parallel, WorkWithinWorkIsDoneThoughOtherWorkFails) {
  for (int round = 0; round < 300; ++round) {
    std::atomic<int> undone = 0;
    const auto outer = [&](std::size_t i) {
      if (i == 1) throw std::runtime_error("as if memory had run out");
      std::array<bool, 2> invoked{};
      parallel_invoke([&] { invoked[0] = true; }, [&] { invoked[1] = true; });
      std::atomic<int> calls = 0;
      run_isolated([&] { parallel_for(50, [&](std::size_t) { ++calls; }); });
      if (!invoked[0] || !invoked[1] || calls != 50) ++undone;
    };
    EXPECT_THROW(parallel_for(2, 8, outer), std::runtime_error);
    EXPECT_EQ(undone, 0);
  }
}

}  // namespace
}  // namespace mapproof
