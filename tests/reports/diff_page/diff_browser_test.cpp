#include <gtest/gtest.h>

#include "reports/html/diff/diff_html.hpp"
#include "tests/reports/browser.hpp"
#include "tests/reports/diff_page/page_samples.hpp"
#include "tests/support/temporary_folder.hpp"

namespace mapproof {
namespace {

using Findings = std::map<std::string, std::string>;

class DiffBrowser : public ::testing::Test {
 protected:
  void SetUp() override {
    if (!test::chromium()) GTEST_SKIP() << "no Chromium on this machine: apt-get install chromium";
  }

  static std::string page_of(const DiffResult& result) {
    return diff_html(result, shown_images(result, {}), load_templates());
  }

  static Findings look_at(const std::string& page, const std::vector<std::string>& texts = {},
                          const std::string& fragment = "") {
    Findings found = test::browse(page, texts, {}, "diff_page/diff_checks.js", fragment);
    EXPECT_EQ(found["done"], "true") << found["error"];
    return found;
  }

  /// One page for the tests that use its controls: a browser's start is what takes time.
  static Findings& used() {
    static Findings found = [] {
      const test::TemporaryFolder folder;
      return look_at(page_of(test::compared_folders(folder.path())));
    }();
    return found;
  }
};

TEST_F(DiffBrowser, ShowsSideBySideSliderBlinkOverlayAndHeatMap) {
  Findings found = used();
  EXPECT_EQ(found["mode-1"], "baseline,current");
  EXPECT_EQ(found["apart-1"], "true");
  EXPECT_EQ(found["apart-2"], "false");
  EXPECT_EQ(found["slider"], "inset(0px 0px 0px 50%)");
  EXPECT_EQ(found["slider-moved"], "inset(0px 0px 0px 25%)");
  EXPECT_EQ(found["blink-first"], "baseline");
  EXPECT_EQ(found["blink-flipped"], "baseline,current");
  EXPECT_EQ(found["opacity"], "0.5");
  EXPECT_EQ(found["opacity-moved"], "0.8");
  EXPECT_EQ(found["blend"], "difference");
  EXPECT_EQ(found["mode-5"], "heat");
  EXPECT_EQ(found["heat-without"], "true");  // Sizes differ: its two images stay.
  EXPECT_EQ(found["mode-m"], "side");
  EXPECT_EQ(found["mode-button"], "overlay");
  EXPECT_EQ(found["link-with-mode"], "true");
}

TEST_F(DiffBrowser, BlinksOnlyOnRequest) {
  Findings found = used();
  EXPECT_EQ(found["blink-starts-by-itself"], "false");
  EXPECT_EQ(found["blink-still"], "baseline");
  EXPECT_EQ(found["blinking"], "true");
  EXPECT_EQ(found["blink-changed"], "baseline");
  EXPECT_EQ(found["blink-stopped"], "false");
}

TEST_F(DiffBrowser, ZoomsAllImagesOfAFigureInStep) {
  Findings found = used();
  EXPECT_EQ(found["zoomed"], "1.500");
  EXPECT_EQ(found["in-step"], "1");
  EXPECT_EQ(found["others-zoomed"], "1.000");
  for (const char* what :
       {"arrow-moves", "wheel-zooms", "drag-moves", "pinch", "cluster-zooms", "cluster-in-view"})
    EXPECT_EQ(found[what], "true") << what;
  EXPECT_EQ(found["fitted"], "1.000 0,0");
  EXPECT_EQ(found["zoom-button"], "150 %");
  EXPECT_EQ(found["cluster-frames"], "3");
}

TEST_F(DiffBrowser, StepsFromFigureToFigureAndFollowsLinksAndHistory) {
  Findings found = used();
  for (const char* what : {"next", "next-focus", "next-again", "back-to-first", "buttons-step",
                           "typing-does-not-step"})
    EXPECT_EQ(found[what], "true") << what;
  EXPECT_EQ(found["deep-link"], "figure-drawn slider");
  EXPECT_EQ(found["history"], "true side");
}

TEST_F(DiffBrowser, OpensAtTheFigureAndModeOfItsAddress) {
  const test::TemporaryFolder folder;
  const std::string page = page_of(test::compared_folders(folder.path()));
  EXPECT_EQ(look_at(page, {}, "#figure-gone")["start"], "figure-gone side");
  EXPECT_EQ(look_at(page, {}, "#figure-moved:overlay")["start"], "figure-moved overlay");
}

TEST_F(DiffBrowser, FiltersByVerdictAndSearchesById) {
  Findings found = used();
  EXPECT_EQ(found["filter-one"], "added");
  EXPECT_EQ(found["filter-said"], "1 of 9 shown");
  EXPECT_EQ(found["filter-two"], "gone,added");
  EXPECT_EQ(found["search"], "same-2");
  EXPECT_EQ(found["index-follows"], "0");
  EXPECT_EQ(found["link-clears-filter"], "figure-gone true");
}

TEST_F(DiffBrowser, OrdersItemsAndShowsThumbnails) {
  Findings found = used();
  EXPECT_EQ(found["by-name"], "true");
  EXPECT_EQ(found["by-share"], "true");
  EXPECT_EQ(found["by-verdict"], "true");
  EXPECT_EQ(found["thumbnails"], "5");  // moved, drawn, resized, gone, added.
}

TEST_F(DiffBrowser, CollectsApprovalsIntoAFileAndACommand) {
  Findings found = used();
  EXPECT_EQ(found["download-off"], "true");
  EXPECT_EQ(found["ticked-all"], found["tickable"]);
  EXPECT_EQ(found["tickable"], "5");  // What cannot be read is not approved.
  EXPECT_EQ(found["ticked"], "2");
  EXPECT_EQ(found["command"], "mapproof approve a b moved added");
  EXPECT_EQ(found["download-name"], "mapproof-approvals.json");
  EXPECT_EQ(found["approvals"], "[\"moved\",\"added\"]mapproof.approvals");
}

TEST_F(DiffBrowser, IsReadableNamedAndWithinItsWidth) {
  Findings found = used();
  EXPECT_GE(std::atof(found["light-contrast"].c_str()), 4.5);
  EXPECT_GE(std::atof(found["dark-contrast"].c_str()), 4.5);
  for (const char* width : {"390", "768", "1400"})
    EXPECT_LE(std::atoi(found[std::string("overflow-") + width].c_str()), 0) << width;
  EXPECT_EQ(found["nameless"], "0");
  EXPECT_EQ(found["without-alt"], "0");
  EXPECT_EQ(found["help"], "true");
  EXPECT_EQ(found["help-closed"], "true");
}

TEST_F(DiffBrowser, ShowsImagesAndTablesWithoutItsScript) {
  const test::TemporaryFolder folder;
  std::string page = page_of(test::compared_folders(folder.path()));
  page.erase(page.find("<script"), page.find("</script>") - page.find("<script"));
  Findings found = look_at(page);
  EXPECT_EQ(found["bare-images"], "10");
  EXPECT_EQ(found["bare-tables"], "1");
  EXPECT_EQ(found["bare-controls"], "0");
}

TEST_F(DiffBrowser, ShowsHostileTextsAsTextAndRunsNeitherThemNorImages) {
  const test::TemporaryFolder folder;
  const test::HostileDiff hostile = test::hostile_diff(folder.path());
  Findings found = look_at(page_of(hostile.result), hostile.texts);
  EXPECT_EQ(found["texts"], std::to_string(hostile.texts.size()));
  EXPECT_EQ(found["missing-texts"], "0") << found["first-missing"];
  EXPECT_EQ(found["scripts"], "1");
  EXPECT_EQ(found["handlers"], "0");
  EXPECT_EQ(found["foreign-images"], "0");
  EXPECT_EQ(found["embedded"], "0");
  EXPECT_EQ(found["pwned"], "false");
  EXPECT_EQ(found["repeated-ids"], "0");
  EXPECT_EQ(found["fetched"], "0");
  for (const char* width : {"390", "768", "1400"})
    EXPECT_LE(std::atoi(found[std::string("overflow-") + width].c_str()), 0) << width;
}

}  // namespace
}  // namespace mapproof
