#include "core/observe/bit_rows.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "core/base/not_finite.hpp"
#include "core/base/random.hpp"
#include "core/model/observation_history.hpp"

namespace mapproof {
namespace {

// Less than a word, whole words and one over, and the same of eight words.
constexpr Eigen::Index kColumns[] = {1, 63, 64, 65, 511, 512, 513, 1100};

Eigen::MatrixXd ones_and_zeros(Eigen::Index rows, Eigen::Index columns, std::uint64_t seed) {
  Random random(seed);
  return Eigen::MatrixXd::NullaryExpr(rows, columns, [&](Eigen::Index, Eigen::Index) {
    return random.uniform() < 0.4 ? 1.0 : 0.0;
  });
}

ObservationHistory visibility(Eigen::MatrixXd values) {
  return {.sensor = Sensor::kVisibility,
          .names = std::vector<std::string>(static_cast<std::size_t>(values.rows()), "a"),
          .values = std::move(values)};
}

TEST(BitCounters, AllGiveTheSameCounts) {
  const std::vector<BitCounter> counters = bit_counters();
  ASSERT_EQ(counters.back().name, "words");
  Random random(1);
  for (const Eigen::Index words : {1, 7, 8, 9, 16, 33}) {
    std::vector<std::uint64_t> bits(static_cast<std::size_t>(6 * words));
    for (std::uint64_t& word : bits) word = random.next();
    std::vector<double> expected(5);
    counters.back().count(bits.data(), bits.data() + words, words, 5, expected.data());
    for (const BitCounter& counter : counters) {
      std::vector<double> counts(5, -1.0);
      counter.count(bits.data(), bits.data() + words, words, 5, counts.data());
      EXPECT_EQ(counts, expected) << counter.name << " " << words;
    }
  }
}

TEST(HistoryBits, CountWhatTheProductOfMatricesHas) {
  for (const Eigen::Index columns : kColumns) {
    Eigen::MatrixXd seen = ones_and_zeros(37, columns, 2);
    Eigen::MatrixXd values = seen, observed = Eigen::MatrixXd::Ones(37, columns);
    for (Eigen::Index t = 0; t < columns; t += 3) {
      seen(t % 37, t) = observed(t % 37, t) = 0.0;
      values(t % 37, t) = kNaN;
    }
    const ObservationHistory history = visibility(values);
    const HistoryBits bits = history_bits(history, columns);
    EXPECT_TRUE(bits.are_all) << columns;
    EXPECT_TRUE(bits.misses_any) << columns;
    EXPECT_EQ(bits.seen.in_common(), seen * seen.transpose()) << columns;
    EXPECT_EQ(bits.seen.in_common(bits.observed), seen * observed.transpose()) << columns;
    EXPECT_EQ(bits.observed.in_common(), observed * observed.transpose()) << columns;
  }
}

TEST(HistoryBits, KnowWhetherTheyAreAllThereIs) {
  const Eigen::MatrixXd values = ones_and_zeros(5, 300, 3);
  EXPECT_FALSE(history_bits(visibility(values), 300).misses_any);
  EXPECT_TRUE(history_bits(visibility(values), 300).are_all);

  ObservationHistory often = visibility(values);
  often.values(4, 299) = 0.5;
  EXPECT_TRUE(history_bits(often, 299).are_all);  // The last step is not used.
  EXPECT_FALSE(history_bits(often, 300).are_all);
  EXPECT_FALSE(history_bits(often, 300).misses_any);

  ObservationHistory bearings = visibility(values);
  bearings.sensor = Sensor::kBearing;
  EXPECT_FALSE(history_bits(bearings, 300).are_all);
}

}  // namespace
}  // namespace mapproof
