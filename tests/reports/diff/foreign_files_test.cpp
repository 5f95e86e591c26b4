#include <algorithm>

#include <gtest/gtest.h>

#include "core/base/files/files.hpp"
#include "reports/diff/folder_diff.hpp"
#include "tests/support/temporary_folder.hpp"

namespace mapproof::test {
namespace {

namespace fs = std::filesystem;

const std::string kImages = std::string(MAPPROOF_SOURCE_DIR) + "/tests/baselines/";

/// Folders of images by other programs.
struct Foreign {
  TemporaryFolder folder;
  fs::path before = folder / "before", after = folder / "after";

  Foreign() {
    for (const fs::path& side : {before, after}) write_file(side / "z.jpg", "\xFF\xD8\xFF one");
  }
  void add(const std::string& name, const std::string& first, const std::string& second) const {
    write_file(before / name, first);
    write_file(after / name, second);
  }
  DiffItem item(const std::string& id, const DiffSettings& settings = {}) const {
    const DiffResult result = folder_diff(before, after, settings);
    const auto found = std::ranges::find(result.items, id, &DiffItem::id);
    return found == result.items.end() ? DiffItem{} : *found;
  }
};

std::string image(const std::string& name) { return read_file(kImages + name + ".png"); }

TEST(ForeignFiles, HaveEndingsInUpperCaseToo) {
  const Foreign two;
  two.add("a.PNG", image("map-usual"), image("curve-usual"));
  two.add("b.Svg", "<svg><rect x='1'/></svg>", "<svg><rect x='9'/></svg>");
  EXPECT_EQ(two.item("a").judgement.verdict, Verdict::kChanged);
  EXPECT_EQ(two.item("b").judgement.verdict, Verdict::kChanged);
}

TEST(ForeignFiles, OfKindsThatAreNotComparedNeverPassIfTheirBytesDiffer) {
  const Foreign two;
  EXPECT_EQ(two.item("z").judgement.verdict, Verdict::kIdentical);
  for (const char* kind : {"JPEG", "gif", "webp", "tif", "bmp", "eps"})
    two.add(std::string("y.") + kind, "one", "two");
  const DiffItem item = two.item("y");
  EXPECT_EQ(item.judgement.verdict, Verdict::kUnreadable);
  EXPECT_NE(item.judgement.cause.find("not an image"), std::string::npos) << item.judgement.cause;
  const DiffResult result = folder_diff(two.before, two.after);
  ASSERT_EQ(result.remarks.size(), 1U);
  EXPECT_NE(result.remarks[0].find("y.eps"), std::string::npos) << result.remarks[0];
}

TEST(ForeignFiles, AreNotIdenticalWhereAnIgnoredRegionHidesWhatDiffers) {
  const Foreign two;
  two.add("a.png", image("map-usual"), image("map-usual"));
  DiffSettings settings;
  settings.ignored = {{"a", {0, 0, 100'000, 100'000}}, {"mistyped", {0, 0, 1, 1}}};
  EXPECT_EQ(two.item("a", settings).judgement.verdict, Verdict::kIdentical);
  two.add("a.png", image("curve-usual"), image("curve-log"));
  const DiffItem item = two.item("a", settings);
  EXPECT_EQ(item.judgement.verdict, Verdict::kWithinTolerance);
  EXPECT_NE(item.judgement.cause.find("ignored"), std::string::npos) << item.judgement.cause;
  const std::vector<std::string> remarks = folder_diff(two.before, two.after, settings).remarks;
  EXPECT_TRUE(std::ranges::any_of(
      remarks, [](const std::string& r) { return r.find("mistyped") != std::string::npos; }));
}

TEST(ForeignFiles, AFolderWithTheNameOfAnImageCannotBeRead) {
  const Foreign two;
  write_file(two.before / "a.png", image("map-usual"));
  fs::create_directories(two.after / "a.png");
  const DiffItem item = two.item("a");
  EXPECT_EQ(item.judgement.verdict, Verdict::kUnreadable) << item.judgement.cause;
}

TEST(ForeignFiles, WithInvalidNumbersCannotBeRead) {
  const Foreign two;
  for (const char* bad : {"<svg><circle cx='nan'/></svg>", "<svg><path d='M0 1e999'/></svg>",
                          "<svg><g transform='translate(inf 0)'/></svg>"}) {
    two.add("a.svg", bad, "<svg><circle cx='1'/></svg>");
    EXPECT_EQ(two.item("a").judgement.verdict, Verdict::kUnreadable) << bad;
  }
  two.add("a.svg", "<svg><circle cx='1e2'/></svg>", "<svg><circle cx='100'/></svg>");
  EXPECT_TRUE(two.item("a").passes) << two.item("a").judgement.cause;
  two.add("b.png", "plain text", "other text");
  EXPECT_EQ(two.item("b").judgement.verdict, Verdict::kUnreadable);
}

}  // namespace
}  // namespace mapproof::test
