#include "core/base/interned.hpp"

#include <array>
#include <sstream>
#include <thread>
#include <unordered_set>

#include <gtest/gtest.h>

#include "core/results/results.hpp"

namespace mapproof {
namespace {

TEST(Interned, IsItsValueToAllThatReadIt) {
  const Name name = std::string("isomap-K6");
  EXPECT_EQ(name, "isomap-K6");
  EXPECT_EQ(name, std::string("isomap-K6"));
  EXPECT_EQ(std::string_view("isomap-K6"), name);
  EXPECT_NE(name, "isomap");
  const std::string text = name;
  const std::string& reference = name;
  EXPECT_EQ(text, reference);
  EXPECT_EQ(name->size(), 9U);
  std::ostringstream out;
  out << name;
  EXPECT_EQ(out.str(), "isomap-K6");
  EXPECT_EQ(sizeof name, 4U);
}

TEST(Interned, OfEqualTextsIsOneValueHoweverItCame) {
  const std::string long_text(200, 'x');
  const Name first = long_text;
  const Name second = std::string_view(long_text);
  EXPECT_EQ(first.id(), second.id());
  EXPECT_EQ(&first.get(), &second.get());
  EXPECT_EQ((std::unordered_set<Name>{first, second, Name("other")}.size()), 2U);
}

TEST(Interned, IsOrderedByContentWhicheverCameFirst) {
  const Name late = "zz-came-first", early = "aa-came-last";
  EXPECT_LT(late.id(), early.id());
  EXPECT_LT(early, late);
  EXPECT_EQ(late <=> late, std::strong_ordering::equal);
}

TEST(Interned, WithoutAValueIsTheEmptyOneAndTakesNoNumber) {
  EXPECT_TRUE(Name().empty());
  EXPECT_EQ(Name(), "");
  EXPECT_EQ(Name().id(), Name("").id());
  EXPECT_EQ(Name().id(), 0U);
  EXPECT_TRUE(Levels().empty());
  EXPECT_EQ(Levels(std::vector<Level>{}).id(), 0U);
}

TEST(Interned, LevelsAreAVectorOfThem) {
  const Levels levels = std::vector<Level>{{"noise", 0.5}, {"terrain", std::string("grass")}};
  ASSERT_EQ(levels.size(), 2U);
  EXPECT_EQ(levels->front().factor, "noise");
  int count = 0;
  for (const Level& level : levels) count += !level.factor.empty();
  EXPECT_EQ(count, 2);
  const auto of = [](const auto& value) { return Levels(std::vector<Level>{{"noise", value}}); };
  EXPECT_LT(of(0.5), of(0.75));
  EXPECT_EQ(of(0.5).id(), of(0.5).id());
  EXPECT_NE(of(1.0), of(std::string("1")));
}

TEST(Interned, ZeroAndMinusZeroAreEqualButReadAsTheyWere) {
  const Levels zero = std::vector<Level>{{"tilt", 0.0}};
  const Levels minus = std::vector<Level>{{"tilt", -0.0}};
  EXPECT_EQ(zero, minus);
  EXPECT_EQ(level_text(zero->front()), "0");
  EXPECT_EQ(level_text(minus->front()), "-0");
}

TEST(Interned, ThreadsThatAddTheSameAndOtherValuesAgreeOnAll) {
  constexpr int kThreads = 8, kValues = 20'000;
  InternPool<std::string> pool;
  std::array<std::vector<std::uint32_t>, kThreads> ids;
  {
    std::vector<std::jthread> threads;
    for (int thread = 0; thread < kThreads; ++thread)
      threads.emplace_back([&pool, &mine = ids[static_cast<std::size_t>(thread)], thread] {
        for (int i = 0; i < kValues; ++i) {
          mine.push_back(pool.id_of("shared " + std::to_string((i + 97 * thread) % kValues)));
          const std::string own = "of " + std::to_string(thread) + " " + std::to_string(i);
          const std::uint32_t id = pool.id_of(own);
          if (pool.at(id) != own) ADD_FAILURE() << own << " reads as " << pool.at(id);
        }
      });
  }
  EXPECT_EQ(pool.size(), 1U + kValues + kThreads * kValues);
  for (int thread = 0; thread < kThreads; ++thread)
    for (int i = 0; i < kValues; ++i)
      EXPECT_EQ(pool.at(ids[static_cast<std::size_t>(thread)][static_cast<std::size_t>(i)]),
                "shared " + std::to_string((i + 97 * thread) % kValues));
}

TEST(Interned, ThatHasNoNumberLeftSaysSoAndKeepsWhatItHas) {
  InternPool<std::string> pool(3);
  const std::uint32_t a = pool.id_of("a"), b = pool.id_of("b");
  EXPECT_THROW(pool.id_of("c"), InvalidInput);
  EXPECT_EQ(pool.id_of("a"), a);
  EXPECT_EQ(pool.at(b), "b");
  EXPECT_EQ(pool.size(), 3U);
}

}  // namespace
}  // namespace mapproof
