#include "core/base/inflater.hpp"

#include <gtest/gtest.h>

#include "core/base/errors.hpp"
#include "tests/support/gzip.hpp"

namespace mapproof {
namespace {

using test::gzipped;

std::string inflated(Inflater& inflater, const std::string& bytes, std::size_t piece) {
  std::string text;
  for (std::size_t at = 0; at < bytes.size(); at += piece)
    text += inflater.take(std::string_view(bytes).substr(at, piece));
  return text + inflater.end();
}

std::string rows(int count) {
  std::string text = "step,landmark,value\n";
  for (int k = 0; k < count; ++k)
    text += std::to_string(k) + ",door," + std::to_string(7 * k) + "\n";
  return text;
}

TEST(Inflater, GivesTheTextHoweverItsBytesCome) {
  const std::string text = rows(9000);
  const std::string twice = gzipped(text) + gzipped("the end\n") + std::string(3, '\0');
  for (const std::size_t piece : {1UL, 2UL, 7UL, 1000UL, 1UL << 20}) {
    Inflater packed("f"), plain("f");
    EXPECT_TRUE(inflated(packed, twice, piece) == text + "the end\n");
    EXPECT_FALSE(packed.is_cut());
    EXPECT_TRUE(inflated(plain, text, piece) == text);
    EXPECT_FALSE(plain.is_cut());
  }
}

TEST(Inflater, GivesWhatIsThereOfBytesThatAreCut) {
  const std::string text = rows(9000);
  const std::string packed = gzipped(text);
  Inflater inflater("f");
  const std::string got = inflated(inflater, packed.substr(0, packed.size() / 2), 100);
  EXPECT_TRUE(inflater.is_cut());
  EXPECT_GT(got.size(), text.size() / 4);
  EXPECT_TRUE(text.starts_with(got));
  Inflater one("f");
  EXPECT_EQ(inflated(one, "\x1f", 1), "\x1f");
}

TEST(Inflater, RefusesWhatIsDamagedOrABomb) {
  std::string damaged = gzipped(rows(100));
  for (std::size_t at = 20; at < damaged.size(); ++at)
    damaged[at] = static_cast<char>(damaged[at] ^ 0x55);
  Inflater first("f");
  EXPECT_THROW(inflated(first, damaged, 64), IoError);
  Inflater second("f");
  EXPECT_THROW(inflated(second, gzipped(std::string(std::size_t{80} << 20, '0')), 1 << 16),
               IoError);
}

}  // namespace
}  // namespace mapproof
