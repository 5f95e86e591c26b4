#include <gtest/gtest.h>

#include "core/base/errors.hpp"
#include "core/base/files/files.hpp"
#include "reports/diff/approvals/approvals.hpp"
#include "reports/diff/folder_diff.hpp"
#include "reports/html/diff/diff_html.hpp"
#include "tests/reports/diff/small_study.hpp"
#include "tests/reports/diff/value_cases.hpp"
#include "tests/support/temporary_folder.hpp"

namespace mapproof::test {
namespace {

namespace fs = std::filesystem;

/// A study and one of another seed.
struct OtherExperiment {
  TemporaryFolder folder;
  fs::path before = folder / "before", after = folder / "after";

  OtherExperiment() {
    for (const fs::path& side : {before, after}) write_base_study(side);
    write_changed(SmallStudy(8), after);
  }
};

TEST(ApprovalRefusals, AFigureOfAnotherExperimentGoesWithTheRecordsAlone) {
  const OtherExperiment two;
  const auto refusals = approval_refusals(two.before, two.after,
                                          {.ids = {"map-isomap", "records", "of-neither-side"}});
  ASSERT_TRUE(refusals.contains("map-isomap"));
  EXPECT_TRUE(refusals.at("map-isomap").goes_with_records);
  EXPECT_NE(refusals.at("map-isomap").why.find("of another experiment"), std::string::npos);
  EXPECT_FALSE(refusals.contains("records"));
  ASSERT_TRUE(refusals.contains("of-neither-side"));
  EXPECT_FALSE(refusals.at("of-neither-side").goes_with_records);
  // The plan does what the message states.
  EXPECT_THROW(approval_plan(two.before, two.after, {.ids = {"map-isomap"}, .key = ""}),
               InvalidInput);
  EXPECT_FALSE(approval_plan(two.before, two.after, {.ids = {"map-isomap", "records"}, .key = ""})
                   .steps.empty());
}

TEST(ApprovalRefusals, UnreadableFilesAreRefusedAndTheOthersApproved) {
  const TemporaryFolder folder;
  for (const char* side : {"before", "after"}) write_base_study(folder / side);
  fs::resize_file(folder / "after/figures/map-isomap.png", 100);
  write_file(folder / "after/figures/map-lpca.svg", "<svg xmlns=\"http://www.w3.org/2000/svg\"/>");
  const auto refusals =
      approval_refusals(folder / "before", folder / "after", {.ids = {"map-isomap", "map-lpca"}});
  ASSERT_TRUE(refusals.contains("map-isomap"));
  EXPECT_FALSE(refusals.at("map-isomap").goes_with_records);
  EXPECT_FALSE(refusals.contains("map-lpca"));
}

TEST(ApprovalRefusals, AFileThatWasDecodedIsNotReadAgain) {
  const TemporaryFolder folder;
  for (const char* side : {"before", "after"}) write_base_study(folder / side);
  const fs::path image = folder / "after/figures/map-isomap.png";
  fs::resize_file(image, 100);
  const auto refusals = approval_refusals(folder / "before", folder / "after",
                                          {.ids = {"map-isomap"}, .decoded = {image}});
  EXPECT_FALSE(refusals.contains("map-isomap"));
}

TEST(ApprovalRefusals, ThePageShowsThemAtTheCheckboxes) {
  const OtherExperiment two;
  const DiffResult result = folder_diff(two.before, two.after);
  const std::string page = diff_html(result, shown_images(result, {}), load_templates());
  const std::size_t item = page.find("data-code=\"map-isomap\"");
  ASSERT_NE(item, std::string::npos);
  const std::string head = page.substr(item, page.find("</header>", item) - item);
  EXPECT_NE(head.find("data-needs=\"records\""), std::string::npos) << head;
  EXPECT_NE(head.find("its records are of another experiment"), std::string::npos) << head;
  const std::size_t records = page.find("data-code=\"records\"");
  const std::string whole = page.substr(records, page.find("</header>", records) - records);
  EXPECT_NE(whole.find("type=\"checkbox\""), std::string::npos) << whole;
  EXPECT_EQ(whole.find("data-needs"), std::string::npos) << whole;
}

}  // namespace
}  // namespace mapproof::test
