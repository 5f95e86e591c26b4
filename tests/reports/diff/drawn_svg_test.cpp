#include <filesystem>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "core/base/files/files.hpp"
#include "reports/diff/images/change_map.hpp"
#include "reports/diff/images/image_diff.hpp"
#include "tests/support/temporary_folder.hpp"

namespace mapproof::test {
namespace {

namespace fs = std::filesystem;

const fs::path kFolder = fs::path(MAPPROOF_TEST_DATA) / "svg_rewritten";

TEST(DrawnSvg, WhatSvgoWroteAgainIsDrawnTheSame) {
  for (const char* name : {"matplotlib", "gnuplot"}) {
    const ImageDiff found = image_diff(kFolder / (std::string(name) + ".svg"),
                                       kFolder / (std::string(name) + ".svgo.svg"));
    EXPECT_EQ(found.state, ImageState::kWithinTolerance) << name << ": " << found.reason;
    EXPECT_NE(found.reason.find("changes, the first"), std::string::npos) << found.reason;
    EXPECT_NE(found.reason.find("drawn by librsvg"), std::string::npos) << found.reason;
  }
}

/// The text without each second element of that name in turn. Those with an id are definitions that
/// nothing in the two files uses.
std::vector<std::string> without_each(const std::string& text, const std::string& name) {
  std::vector<std::string> texts;
  int seen = 0;
  for (std::size_t at = text.find("<" + name + " "); at != std::string::npos;
       at = text.find("<" + name + " ", at + 1)) {
    const std::size_t size = text.find("/>", at) + 2 - at;
    if (text.substr(at, size).find(" id=") != std::string::npos || ++seen % 2 == 0) continue;
    std::string lost = text;
    texts.push_back(lost.erase(at, size));
  }
  return texts;
}

TEST(DrawnSvg, ALostElementIsFoundAlthoughTheWholeWasWrittenAgain) {
  const TemporaryFolder folder;
  int lost = 0;
  for (const char* name : {"matplotlib", "gnuplot"}) {
    const fs::path original = kFolder / (std::string(name) + ".svg");
    for (const std::string& text :
         without_each(read_file(kFolder / (std::string(name) + ".svgo.svg")), "use")) {
      const ImageDiff found = image_diff(original, folder.file("lost.svg", text));
      EXPECT_EQ(found.state, ImageState::kDifferent) << name << " " << lost << found.reason;
      ++lost;
    }
  }
  EXPECT_GT(lost, 40);
}

TEST(DrawnSvg, ThatDiffersHasAHeatMapAtTwiceItsSize) {
  const TemporaryFolder folder;
  const auto circle = [&](const char* name, int x) {
    return folder.file(name,
                       "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"100\" height=\"80\">"
                       "<circle cx=\"" +
                           std::to_string(x) + "\" cy=\"40\" r=\"9\"/></svg>");
  };
  const HeatMap heat = heat_map(circle("a.svg", 30), circle("b.svg", 60));
  ASSERT_EQ(heat.width, 200);
  EXPECT_EQ(heat.height, 160);
  EXPECT_EQ(heat.colour(60, 80), kChangedColour);
  EXPECT_EQ(heat.colour(120, 80), kChangedColour);
}

}  // namespace
}  // namespace mapproof::test
