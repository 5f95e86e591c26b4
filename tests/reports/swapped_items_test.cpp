#include "reports/diff/swapped_items.hpp"

#include <map>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "core/base/files/files.hpp"
#include "core/base/files/temporary_folder.hpp"

namespace mapproof {
namespace {

namespace fs = std::filesystem;

/// Items whose images differ from their baselines, all of one size.
std::vector<DiffItem> changed_items(const fs::path& folder, int count) {
  std::vector<DiffItem> items;
  for (int i = 0; i < count; ++i) {
    DiffItem item;
    item.id = fmt::format("plot-{:04}", i);
    item.kind = ItemKind::kImage;
    item.judgement = {Verdict::kChanged, true, "pixels changed"};
    const fs::path before = folder / "a" / (item.id + ".png"),
                   after = folder / "b" / (item.id + ".png");
    write_file(before, fmt::format("before {:04}", i));
    write_file(after, fmt::format("after  {:04}", i));
    item.images.push_back({"png", "", before, after, {}});
    items.push_back(std::move(item));
  }
  return items;
}

TEST(SwappedItems, AreNamedAmongManyFilesOfOneSize) {
  const TemporaryFolder folder("swapped");
  std::vector<DiffItem> items = changed_items(folder.path(), 50);
  write_file(items[7].images[0].current, read_file(items[30].images[0].baseline));
  name_swapped(items, {});
  EXPECT_EQ(items[7].judgement.cause, "its png is that of plot-0030 in the baseline: swapped");
  for (const std::size_t other : {0U, 6U, 30U, 49U})
    EXPECT_EQ(items[other].judgement.cause, "pixels changed") << other;
}

TEST(SwappedItems, AFileThatEqualsItsOwnBaselineWasNotSwapped) {
  const TemporaryFolder folder("swapped");
  std::vector<DiffItem> items = changed_items(folder.path(), 3);
  for (DiffItem& item : items) {  // Three equal images.
    write_file(item.images[0].baseline, "same");
    write_file(item.images[0].current, "same");
  }
  name_swapped(items, {});
  for (const DiffItem& item : items) EXPECT_EQ(item.judgement.cause, "pixels changed");
}

TEST(SwappedItems, AreFoundWithOneReadingOfEachFile) {
  const TemporaryFolder folder("swapped");
  std::vector<DiffItem> items = changed_items(folder.path(), 200);
  std::map<fs::path, int> reads;
  name_swapped(items, {}, [&](const fs::path& path) {
    ++reads[path];
    return read_file(path);
  });
  EXPECT_EQ(reads.size(), 400U);
  for (const auto& [path, times] : reads) EXPECT_EQ(times, 1) << path;
}

}  // namespace
}  // namespace mapproof
