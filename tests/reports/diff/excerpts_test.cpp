#include "reports/diff/documents/excerpts.hpp"

#include <gtest/gtest.h>

namespace mapproof {
namespace {

std::string long_text() {
  std::string text;
  for (int i = 0; i < 40; ++i) text += "word " + std::to_string(i) + " m²: ";
  return text;
}

TEST(Excerpts, DifferWhereverTheTextsDo) {
  const std::string text = long_text();
  for (std::size_t at = 0; at < text.size(); ++at) {
    if (static_cast<unsigned char>(text[at]) >= 0x80U) continue;
    std::string other = text;
    other[at] = '#';
    const auto [before, after] = excerpts(text, other, 60);
    EXPECT_NE(before, after) << at;
    EXPECT_NE(after.find('#'), std::string::npos) << at;
    EXPECT_EQ(before.find("\\x"), std::string::npos) << before;  // No half a character.
    EXPECT_LT(before.size(), 200U);
  }
  const auto [whole, longer] = excerpts(text, text + "more", 60);
  EXPECT_NE(whole, longer);
}

TEST(Excerpts, LeaveShortTextsAsTheyAre) {
  const auto [before, after] = excerpts("a b", "a c", 60);
  EXPECT_EQ(before, "a b");
  EXPECT_EQ(after, "a c");
  EXPECT_EQ(excerpts("", "a", 60), (std::pair<std::string, std::string>("", "a")));
}

}  // namespace
}  // namespace mapproof
