#include <algorithm>
#include <regex>
#include <set>

#include <gtest/gtest.h>

#include "core/base/files/files.hpp"
#include "core/base/text/base64.hpp"
#include "reports/diff/folder_diff.hpp"
#include "reports/html/block_data.hpp"
#include "reports/html/diff/diff_html.hpp"
#include "reports/html/sha256.hpp"
#include "tests/reports/diff_page/page_samples.hpp"
#include "tests/support/temporary_folder.hpp"

namespace mapproof {
namespace {

std::string page_of(const DiffResult& result, const ImageBudget& budget = {}) {
  return diff_html(result, shown_images(result, {}, budget), load_templates(), budget.page_bytes);
}

/// The first group of every match.
std::vector<std::string> all_matches(const std::string& text, const std::string& pattern) {
  const std::regex regex(pattern);
  std::vector<std::string> found;
  for (std::sregex_iterator it(text.begin(), text.end(), regex), end; it != end; ++it)
    found.push_back((*it)[1]);
  return found;
}

int count_of(const std::string& text, const std::string& part) {
  int count = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1))
    ++count;
  return count;
}

/// The page without the data of its images, which are too long for std::regex.
std::string without_images(std::string page) {
  for (const std::string image : {"src=\"data:", "srcset=\"data:"})
    for (std::size_t at = 0; (at = page.find(image, at)) != page.npos;)
      page.erase(at, page.find('"', at + image.size()) + 1 - at);
  return page;
}

std::string uri_of(const std::filesystem::path& path) { return base64(read_file(path)); }

TEST(DiffPage, IsNamedByWhatDistinguishesItsSides) {
  DiffResult result;
  result.baseline = "/data/nightly/a/figures";
  result.current = "/data/nightly/b/figures";
  EXPECT_NE(page_of(result).find("<bdi>a/figures</bdi> &rarr; <bdi>b/figures</bdi>"),
            std::string::npos);
  result.current = "/data/nightly/a/figures/more";
  EXPECT_NE(page_of(result).find("<bdi>figures</bdi> &rarr; <bdi>figures/more</bdi>"),
            std::string::npos);
}

TEST(DiffPage, SaysTheCauseOfTheFirstItemBesideItAndInTheHeadOfANarrowScreen) {
  const test::TemporaryFolder folder;
  DiffResult result = test::compared_folders(folder.path());
  result.items[0].judgement.cause = "the cause of the first";
  result.judgement.cause = "counts. The first is it: the cause of the first";
  const std::string page = page_of(result);
  EXPECT_EQ(all_matches(page, "class=\"([a-z-]*)\"><bdi>the cause of the first<"),
            (std::vector<std::string>{"first-cause", "cause"}));
  EXPECT_EQ(
      all_matches(page, "class=\"subtitle\"><bdi>([^<]*)<"),
      std::vector<std::string>{counts_text(result) + ". The first is " + result.items[0].id + "."});
}

TEST(PercentEncoding, TurnsNoTwoTextsIntoOneAndLeavesNothingThatHtmlReads) {
  EXPECT_EQ(percent_encoded("sub/fig-7.b_c"), "sub/fig-7.b_c");
  EXPECT_EQ(percent_encoded("a b%20:<\"'&\xff"), "a%20b%2520%3A%3C%22%27%26%FF");
}

TEST(DiffPage, HoldsEachImageOnceAsItIsOnDisk) {
  const test::TemporaryFolder folder;
  const std::string page = page_of(test::compared_folders(folder.path()));
  for (const char* name : {"a/moved.png", "b/moved.png", "a/resized.png", "b/resized.png",
                           "drawn-a.svg", "drawn-b.svg", "a/gone.png", "b/added.png"})
    EXPECT_EQ(count_of(page, uri_of(folder / name)), 1) << name;
}

TEST(DiffPage, ListsIdenticalImagesButDoesNotHoldThem) {
  const test::TemporaryFolder folder;
  const std::string page = page_of(test::compared_folders(folder.path()));
  EXPECT_EQ(count_of(page, uri_of(folder / "a/same-2.png")), 0);
  EXPECT_EQ(count_of(page, "<li id=\"figure-same-2\""), 1);
  const test::TemporaryFolder larger;
  const std::string many = page_of(test::compared_folders(larger.path(), 300));
  EXPECT_LT(many.size(), page.size() + 300 * 300);
}

TEST(DiffPage, FoldsTheImagesOfTheLastItemsOfManyAndCountsThem) {
  const test::TemporaryFolder folder;
  DiffResult result = test::compared_folders(folder.path());
  const auto moved = std::ranges::find(result.items, "moved", &DiffItem::id);
  ASSERT_NE(moved, result.items.end());
  const DiffItem one = *moved;
  const auto page_of_many = [&](std::size_t count) {
    result.items = std::vector<DiffItem>(count, one);
    for (std::size_t i = 0; i < count; ++i) result.items[i].id = "moved-" + std::to_string(i);
    return page_of(result);
  };
  EXPECT_EQ(count_of(page_of_many(9), "<summary>3 images"), 0) << "a few items are open";
  const std::string page = page_of_many(40);
  const int folds = count_of(page, "<summary>3 images");
  EXPECT_GT(folds, 20);
  EXPECT_LT(folds, 38);
  EXPECT_GT(page.find("<summary>3 images"), page.find("id=\"figure-moved-3\""));
  EXPECT_GT(page.rfind("<summary>3 images"), page.find("id=\"figure-moved-39\""));
  EXPECT_EQ(count_of(page, "class=\"fold further\""), 0) << "each has its name and its cause";
}

TEST(DiffPage, FoldsTheLastItemsThatManyScreensWouldNotHold) {
  const test::TemporaryFolder folder;
  DiffResult result = test::compared_folders(folder.path());
  const DiffItem one = result.items.front();
  result.items = std::vector<DiffItem>(300, one);
  for (std::size_t i = 0; i < 300; ++i) result.items[i].id = "item-" + std::to_string(i);
  const std::string page = page_of(result);
  const std::size_t fold = page.find("class=\"fold further\"");
  ASSERT_NE(fold, std::string::npos);
  EXPECT_TRUE(std::regex_search(page.substr(fold, 100), std::regex("<summary>\\d+ more items<")));
  EXPECT_LT(page.find("<article id=\"figure-item-40\""), fold);
  EXPECT_GT(page.find("<article id=\"figure-item-299\""), fold);
  EXPECT_EQ(count_of(page, "<article "), 300);
}

TEST(DiffPage, MakesAHeatMapOfPngsAndSvgsThatDifferUnlessTheirSizesDo) {
  const test::TemporaryFolder folder;
  const std::string page = page_of(test::compared_folders(folder.path()));
  const bool draws_svg = std::filesystem::exists("/usr/bin/rsvg-convert");
  EXPECT_EQ(count_of(page, "class=\"pane heat\""), draws_svg ? 2 : 1);
  EXPECT_NE(page.find("alt=\"Heat map of moved\""), std::string::npos);
  EXPECT_EQ(page.find("alt=\"Heat map of drawn\"") != std::string::npos, draws_svg);
  EXPECT_EQ(count_of(page, "No heat map: the sizes differ."), 1);
}

TEST(DiffPage, IsTheSameWhetherTheComparisonKeptTheHeatMapsOrNot) {
  const test::TemporaryFolder folder;
  for (const int i : {1, 2, 3})
    for (const bool is_current : {false, true})
      write_file(folder / (is_current ? "b" : "a") / fmt::format("{}.png", i),
                 test::square_png(160, 120, is_current ? 60 + 20 * i : 10, 30));
  const auto one_pair = std::filesystem::file_size(folder / "a/1.png") +
                        std::filesystem::file_size(folder / "b/1.png");
  const std::string none = page_of(folder_diff(folder / "a", folder / "b"));
  EXPECT_EQ(count_of(none, "class=\"pane heat\""), 3);
  for (const auto& [bytes, kept] :
       {std::pair{std::size_t{1}, 0}, {std::size_t{one_pair}, 1}, {kPageBytes, 3}}) {
    DiffSettings settings;
    settings.heat_map_bytes = bytes;
    const DiffResult result = folder_diff(folder / "a", folder / "b", settings);
    const auto has_heat = [](const DiffItem& item) { return item.images.at(0).heat.has_value(); };
    // Pairs that are compared at the same time may both take the last room.
    EXPECT_GE(std::ranges::count_if(result.items, has_heat), kept);
    EXPECT_EQ(page_of(result), none) << bytes;
  }
}

TEST(DiffPage, TellsFiguresThatHaveAValueFromForeignImages) {
  const test::TemporaryFolder folder;
  DiffResult result = test::compared_folders(folder.path());
  EXPECT_EQ(all_matches(page_of(result), "class=\"stage[^\"]* (drawn)\"").size(), 0U);
  std::ranges::find(result.items, "added", &DiffItem::id)->current_figure = folder / "b/added.json";
  std::ranges::find(result.items, "gone", &DiffItem::id)->baseline_figure = folder / "a/gone.json";
  EXPECT_EQ(all_matches(page_of(result), "class=\"stage[^\"]* (drawn)\"").size(), 2U);
}

TEST(DiffPage, RefusesAnImageThatWasComparedAndIsNotWhatItsNameSays) {
  const test::TemporaryFolder folder;
  for (const auto& [side, x] : {std::pair{"a", 20}, {"b", 90}}) {
    write_file(folder / side / "named.jpg", test::square_png(160, 120, x, 30));
    write_file(folder / side / "plain.png", test::square_png(160, 120, x, 30));
  }
  const DiffResult result = folder_diff(folder / "a", folder / "b");
  for (const DiffItem& item : result.items) EXPECT_TRUE(item.images.at(0).diff.is_decoded);
  const std::string page = page_of(result);
  EXPECT_NE(page.find("is not an image that can be read as jpg"), std::string::npos);
}

TEST(DiffPage, NamesBothSidesInItsTitleAndAboveEachImage) {
  const test::TemporaryFolder folder;
  DiffResult result = test::compared_folders(folder.path());
  result.baseline = "origin/main:plots";
  result.current = "plots";
  const std::string page = page_of(result);
  EXPECT_NE(page.find(": origin/main:plots &rarr; plots</title>"), std::string::npos);
  EXPECT_NE(page.find("<strong>Baseline <bdi>origin/main:plots</bdi></strong>"), std::string::npos);
  EXPECT_NE(page.find("<strong>Current <bdi>plots</bdi></strong>"), std::string::npos);
}

TEST(DiffPage, MakesAHeatMapWithinToleranceToo) {
  const test::TemporaryFolder folder;
  DiffResult result = test::compared_folders(folder.path());
  for (DiffItem& item : result.items)
    for (ImageFile& file : item.images)
      if (file.diff.state == ImageState::kDifferent) file.diff.state = ImageState::kWithinTolerance;
  EXPECT_NE(page_of(result).find("alt=\"Heat map of moved\""), std::string::npos);
}

TEST(DiffPage, StatesThatSizesDifferAndWhyAnImageIsNotShown) {
  const test::TemporaryFolder folder;
  const std::string page = page_of(test::compared_folders(folder.path()));
  EXPECT_NE(page.find("160 \u00D7 120 \u2192 160 \u00D7 140 pixels"), std::string::npos);
  EXPECT_NE(page.find("Not shown: png cannot be read."), std::string::npos);
}

TEST(DiffPage, ListsItemsThatWereNotCompared) {
  const test::TemporaryFolder folder;
  DiffResult result = test::compared_folders(folder.path());
  result.remarks = {"Not compared: <b>x</b>.jpg"};
  EXPECT_NE(page_of(result).find("Not compared: &lt;b&gt;x&lt;/b&gt;.jpg"), std::string::npos);
}

TEST(DiffPage, LeavesOutImagesBeyondItsBudgetAndCountsThem) {
  const test::TemporaryFolder folder;
  const DiffResult result = test::compared_folders(folder.path());
  const std::string page =
      page_of(result, {.largest_bytes = 1 << 20, .page_bytes = 1, .heat_maps = 0});
  EXPECT_EQ(count_of(page, "<img "), 0);
  EXPECT_NE(page.find("Images of 6 items are not shown"), std::string::npos);
  EXPECT_NE(page.find("id=\"figure-moved\""), std::string::npos);
}

TEST(DiffPage, ShowsNoPngThatClaimsToBeHuge) {
  const test::TemporaryFolder folder;
  std::string bytes = test::square_png(16, 16, 0, 0);
  bytes.replace(16, 8, std::string("\0\1\x86\xa0\0\1\x86\xa0", 8));  // 100,000 x 100,000
  folder.file("huge.png", bytes);
  DiffItem item;
  item.id = "huge";
  item.judgement = {Verdict::kNew, true, "is not in the baseline"};
  ImageFile file;
  file.format = "png";
  file.current = folder / "huge.png";
  item.images = {file};
  DiffResult result;
  result.items = {item};
  const std::string page = page_of(result);
  EXPECT_EQ(count_of(page, "<img "), 0);
  EXPECT_NE(page.find("100000 x 100000 pixels are not shown"), std::string::npos);
}

TEST(DiffPage, FetchesNothingAndNamesItsStyleSheetAndScriptInItsPolicy) {
  const test::TemporaryFolder folder;
  const std::string page = page_of(test::compared_folders(folder.path()));
  for (const std::string& target :
       all_matches(without_images(page), "(?:href|srcset|action)=\"([^\"]*)\""))
    EXPECT_TRUE(std::regex_match(target, std::regex("#[a-zA-Z0-9./_%-]+|data:,"))) << target;
  EXPECT_EQ(count_of(page, " src=\""), count_of(page, " src=\"data:image/"));
  const auto between = [&](const std::string& begin, const std::string& end) {
    const std::size_t from = page.find(begin) + begin.size();
    return page.substr(from, page.find(end, from) - from);
  };
  const std::string policy = between("Security-Policy\" content=\"", "\">");
  EXPECT_NE(policy.find("default-src &#39;none&#39;"), std::string::npos);
  EXPECT_NE(policy.find(policy_hash(between("<style>", "</style>"))), std::string::npos);
  EXPECT_NE(policy.find(policy_hash(between("<script>", "</script>"))), std::string::npos);
  EXPECT_EQ(policy.find("unsafe"), std::string::npos);
  for (const char* word : {"innerHTML", "outerHTML", "insertAdjacent", "document.write", "eval(",
                           "fetch(", "XMLHttpRequest", "@import", "url("})
    EXPECT_EQ(page.find(word), std::string::npos) << word;
}

TEST(DiffPage, GivesEachIdOnceAndHasNoInlineStyleOrHandler) {
  const test::TemporaryFolder folder;
  for (const DiffResult& result :
       {test::compared_folders(folder.path()), test::hostile_diff(folder.path()).result}) {
    std::string page = without_images(page_of(result));
    page.erase(page.find("<script>"), page.find("</script>") - page.find("<script>"));
    std::set<std::string> seen;
    for (const std::string& id : all_matches(page, " id=\"([^\"]*)\""))
      EXPECT_TRUE(seen.insert(id).second) << id;
    EXPECT_TRUE(
        all_matches(page, "<[a-z]+[^>\"]*(?:\"[^\"]*\"[^>\"]*)* (style|on[a-z]+)=").empty());
  }
}

TEST(DiffPage, StatesThatAllIsIdentical) {
  DiffItem item;
  item.id = "fig-7";
  DiffResult result;
  result.passes = true;
  result.baseline = "before", result.current = "after";
  result.items = {item};
  const std::string page = page_of(result);
  EXPECT_NE(page.find("All that was compared is identical."), std::string::npos);
  EXPECT_NE(page.find("<title>Passes: identical: before &rarr; after</title>"), std::string::npos);
}

TEST(DiffPage, IsTheSameBytesEachTime) {
  const test::TemporaryFolder folder;
  const DiffResult result = test::compared_folders(folder.path());
  EXPECT_EQ(page_of(result), page_of(result));
}

}  // namespace
}  // namespace mapproof
