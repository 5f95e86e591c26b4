#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "core/base/files/files.hpp"
#include "tests/support/program.hpp"
#include "tests/support/temporary_folder.hpp"

namespace mapproof::test {
namespace {

namespace fs = std::filesystem;

// Made by Pillow and matplotlib: tests/data/image_formats/make.py.
const fs::path kFormats = fs::path(MAPPROOF_TEST_DATA) / "image_formats";

/// The first item of a comparison.
nlohmann::json compared(const fs::path& baseline, const fs::path& current) {
  const Outcome outcome = mapproof({"diff", baseline.string(), current.string(), "--json"});
  EXPECT_LE(outcome.exit_code, 1) << outcome.error;
  return nlohmann::json::parse(outcome.out).at("items").at(0);
}

std::string cause(const nlohmann::json& item) { return item.at("cause").get<std::string>(); }

class ImageFormats : public ::testing::TestWithParam<const char*> {
 protected:
  void SetUp() override {
    if (!MAPPROOF_HAS_ANIMATION) GTEST_SKIP() << "built without mapproof-animation";
    if (std::string_view(GetParam()).ends_with(".pdf") && !fs::exists("/usr/bin/pdftoppm"))
      GTEST_SKIP() << "pdftoppm is not installed";
  }
};

TEST_P(ImageFormats, AreIdenticalToThemselves) {
  const fs::path file = kFormats / "before" / GetParam();
  EXPECT_EQ(compared(file, file).at("verdict"), "identical");
}

TEST_P(ImageFormats, ShowAMovedPointByTheirPixels) {
  const nlohmann::json item =
      compared(kFormats / "before" / GetParam(), kFormats / "after" / GetParam());
  EXPECT_EQ(item.at("verdict"), "changed") << item;
  EXPECT_NE(cause(item).find("by its pixels alone"), std::string::npos) << cause(item);
  EXPECT_NE(cause(item).find("pixels changed"), std::string::npos) << cause(item);
}

TEST_P(ImageFormats, AreUnreadableIfTheyAreCut) {
  const TemporaryFolder folder;
  const fs::path file = folder / GetParam();
  const std::string whole = read_file(kFormats / "before" / GetParam());
  write_file(file, whole.substr(0, whole.size() * 2 / 3));
  const nlohmann::json item = compared(kFormats / "before" / GetParam(), file);
  EXPECT_EQ(item.at("verdict"), "unreadable") << item;
  EXPECT_NE(cause(item).find("the current file: "), std::string::npos) << cause(item);
}

TEST_P(ImageFormats, AreNotApprovedIfTheyAreCut) {
  const TemporaryFolder folder;
  fs::create_directories(folder / "baseline");
  fs::create_directories(folder / "current");
  const std::string whole = read_file(kFormats / "before" / GetParam());
  write_file(folder / "baseline" / GetParam(), whole);
  write_file(folder / "current" / GetParam(), whole.substr(0, whole.size() * 2 / 3));
  const Outcome outcome =
      mapproof({"approve", (folder / "baseline").string(), (folder / "current").string(), "--all"});
  EXPECT_NE(outcome.exit_code, 0);
  EXPECT_EQ(read_file(folder / "baseline" / GetParam()), whole);
}

INSTANTIATE_TEST_SUITE_P(OfOthers, ImageFormats,
                         ::testing::Values("plot.jpg", "plot.webp", "plot.tiff", "plot.tif",
                                           "plot.gif", "plot.bmp", "plot.pdf"),
                         [](const auto& file) {
                           return std::string(file.param).substr(std::string_view("plot.").size());
                         });

TEST(AnimatedImages, AreComparedFrameByFrame) {
  if (!MAPPROOF_HAS_ANIMATION) GTEST_SKIP() << "built without mapproof-animation";
  for (const char* film : {"film.gif", "film.png", "film.webp", "film.tif"}) {
    const nlohmann::json item = compared(kFormats / "before" / film, kFormats / "after" / film);
    EXPECT_EQ(item.at("verdict"), "changed") << film;
    const bool has_pages = std::string_view(film).ends_with("tif");
    EXPECT_NE(cause(item).find(has_pages ? "page 2 of 3" : "frame 2 of 3"), std::string::npos)
        << cause(item);
  }
}

TEST(AnimatedImages, OfTheSameFramesAtOtherTimesAreChanged) {
  if (!MAPPROOF_HAS_ANIMATION) GTEST_SKIP() << "built without mapproof-animation";
  const nlohmann::json item =
      compared(kFormats / "before/slower.webp", kFormats / "after/slower.webp");
  EXPECT_EQ(item.at("verdict"), "changed");
  EXPECT_NE(cause(item).find("frame 2 is shown for 500 ms, and was for 300 ms"), std::string::npos)
      << cause(item);
}

TEST(AnimatedImages, OfWebPAreUnreadableIfTheyAreCut) {
  if (!MAPPROOF_HAS_ANIMATION) GTEST_SKIP() << "built without mapproof-animation";
  const TemporaryFolder folder;
  const fs::path file = folder / "film.webp";
  const std::string whole = read_file(kFormats / "before/film.webp");
  write_file(file, whole.substr(0, whole.size() * 2 / 3));
  EXPECT_EQ(compared(kFormats / "before/film.webp", file).at("verdict"), "unreadable");
}

TEST(AnimatedImages, OfWebPAreRefusedByTheSizeThatTheyDeclareBeforeTheyTakeIt) {
  if (!MAPPROOF_HAS_ANIMATION) GTEST_SKIP() << "built without mapproof-animation";
  const TemporaryFolder folder;
  const fs::path file = folder / "film.webp";
  std::string film = read_file(kFormats / "before/film.webp");
  ASSERT_EQ(film.substr(12, 4), "VP8X");
  film.replace(24, 3, std::string("\0\0\x30", 3));  // The width of the canvas, less one.
  write_file(file, film);
  const nlohmann::json item = compared(kFormats / "before/film.webp", file);
  EXPECT_EQ(item.at("verdict"), "unreadable");
  EXPECT_NE(item.dump().find("3145729 x "), std::string::npos) << item;
  EXPECT_NE(item.dump().find("more than the 65535 a side"), std::string::npos) << item;
}

TEST(LargeImages, AreComparedInStrips) {
  const nlohmann::json item = compared(kFormats / "before/large.png", kFormats / "after/large.png");
  EXPECT_EQ(item.at("verdict"), "changed") << item;
  EXPECT_NE(cause(item).find("4 pixels changed"), std::string::npos) << cause(item);
  EXPECT_NE(cause(item).find("the largest cluster at 8001, 931"), std::string::npos) << cause(item);
}

TEST(ColourSpaces, ThatDifferAreAChangeAndOtherWordsForOneAreNone) {
  for (const char* name : {"gamma.png", "wide.png", "profile.png"}) {
    const nlohmann::json item = compared(kFormats / "before" / name, kFormats / "after" / name);
    EXPECT_EQ(item.at("verdict"), "changed") << name;
    EXPECT_NE(cause(item).find("the colour space changed: "), std::string::npos) << cause(item);
  }
  for (const char* name : {"srgb.png", "dated.png"})
    EXPECT_EQ(compared(kFormats / "before" / name, kFormats / "after" / name).at("verdict"),
              "identical")
        << name;
}

TEST(ColourSpaces, OfOtherFormatsAreTheirProfiles) {
  if (!MAPPROOF_HAS_ANIMATION) GTEST_SKIP() << "built without mapproof-animation";
  for (const char* name : {"profile.jpg", "profile.webp", "profile.tiff"}) {
    const nlohmann::json item = compared(kFormats / "before" / name, kFormats / "after" / name);
    EXPECT_EQ(item.at("verdict"), "changed") << name;
    EXPECT_NE(cause(item).find("its colour profile changed"), std::string::npos) << cause(item);
  }
}

TEST(TransparentImages, AreComparedOnBlackToo) {
  const nlohmann::json item =
      compared(kFormats / "before/transparent.png", kFormats / "after/transparent.png");
  EXPECT_EQ(item.at("verdict"), "changed");
  EXPECT_NE(cause(item).find("seen over black"), std::string::npos) << cause(item);
}

TEST(ImageFileOnDisk, ThatIsAPointerOfGitLfsIsNamed) {
  const TemporaryFolder folder;
  const fs::path file = folder / "plot.png";
  write_file(file, "version https://git-lfs.github.com/spec/v1\noid sha256:0\nsize 12345\n");
  const nlohmann::json item = compared(kFormats / "before/film.png", file);
  EXPECT_EQ(item.at("verdict"), "unreadable");
  EXPECT_NE(cause(item).find("git lfs pull"), std::string::npos) << cause(item);
}

}  // namespace
}  // namespace mapproof::test
