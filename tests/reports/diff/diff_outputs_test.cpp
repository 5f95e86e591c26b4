#include "reports/diff/diff_outputs.hpp"

#include <algorithm>
#include <filesystem>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "core/base/errors.hpp"
#include "core/base/files/files.hpp"
#include "reports/diff/diff_settings.hpp"
#include "reports/diff/folder_diff.hpp"
#include "reports/diff/item_images.hpp"
#include "tests/reports/diff/small_study.hpp"
#include "tests/reports/diff/value_cases.hpp"
#include "tests/support/schemas/comparison_schemas.hpp"
#include "tests/support/schemas/schema_problem.hpp"
#include "tests/support/temporary_folder.hpp"
#include "tests/support/xml.hpp"

namespace mapproof::test {
namespace {

using nlohmann::json;
namespace fs = std::filesystem;

/// One item of each verdict, with names that have broken something somewhere.
DiffResult hostile_result() {
  DiffResult result;
  result.baseline = "a <\"&'>";
  result.current = "b\x01\xff";
  for (const Verdict verdict : kVerdicts) {
    DiffItem& item = result.items.emplace_back();
    item.id = std::string("]]><|`*_ ") + std::string(name(verdict)) + "\x02\xfe\n</testcase>";
    item.judgement = {verdict, true, "<script>alert(1)</script> & | \"x\" \x1b[31m \xc3\x28 @all"};
    item.passes = verdict <= Verdict::kWithinTolerance;
  }
  return result;
}

TEST(DiffOutputs, JunitIsWellFormedWhateverNamesAndCausesHold) {
  const std::string junit = diff_junit(hostile_result());
  const std::vector<XmlElement> elements = parse_xml(junit);  // Throws if it is malformed.
  EXPECT_EQ(elements.at(0).name, "testsuites");
  EXPECT_EQ(std::ranges::count(elements, "testcase", &XmlElement::name), 10);
  EXPECT_EQ(std::ranges::count(elements, "failure", &XmlElement::name), 7);
  EXPECT_EQ(std::ranges::count(elements, "error", &XmlElement::name), 1);
  EXPECT_NE(junit.find("tests=\"10\" failures=\"7\" errors=\"1\""), std::string::npos);
  EXPECT_EQ(junit.find("<script>"), std::string::npos);
}

TEST(DiffOutputs, MarkdownHoldsNoMarkupOfNamesAndCauses) {
  const std::string markdown = diff_markdown(hostile_result());
  EXPECT_EQ(markdown.find("<script>"), std::string::npos);
  EXPECT_EQ(markdown.find("@all"), std::string::npos);
  EXPECT_NE(markdown.find("| **fails** |"), std::string::npos);
  EXPECT_EQ(markdown.find('\x1b'), std::string::npos);
}

TEST(DiffOutputs, TextHasOneLineForACauseOfManyItemsAndOnePerQuantity) {
  const TemporaryFolder folder;
  write_base_study(folder / "a");
  write_base_study(folder / "b");
  write_changed(SmallStudy(8), folder / "b");
  const DiffResult result = folder_diff(folder / "a", folder / "b", {});
  const std::string text = diff_text(result);
  EXPECT_EQ(result.shared.size(), 1U);
  EXPECT_NE(text.find("3 items: seed 7 \u2192 8"), std::string::npos) << text;
  EXPECT_EQ(text.find("map-isomap changed because"), std::string::npos) << text;
  EXPECT_NE(text.find("MPE: 4 records differ"), std::string::npos) << text;
  EXPECT_NE(text.find("; current / baseline "), std::string::npos) << text;
}

TEST(DiffOutputs, TextNamesStaleFiguresAndVersionsThatDiffer) {
  const TemporaryFolder folder;
  write_base_study(folder / "a");
  write_base_study(folder / "b");
  SmallStudy study;
  study.study.provenance.version = "9.9.9";
  study.map("layout-2-pose-1/visibility/lpca/200").estimate.array() += 0.5;
  study.rescore();
  write_changed(study, folder / "b");
  fs::copy(folder / "a/figures", folder / "b/figures",
           fs::copy_options::overwrite_existing | fs::copy_options::recursive);
  const std::string text = diff_text(folder_diff(folder / "a", folder / "b", {}));
  EXPECT_NE(text.find("Stale:  map-lpca"), std::string::npos) << text;
  EXPECT_NE(text.find("Versions that differ:  mapproof"), std::string::npos) << text;
  EXPECT_NE(text.find("9.9.9"), std::string::npos) << text;
}

TEST(DiffOutputs, ImagesThatCannotBeReadAreNeitherCopiedNorLinked) {
  const TemporaryFolder folder;
  const std::string active = "<svg><script>alert(1)</script></svg>";
  write_file(folder / "a/both.svg", "<svg><rect x='1'/></svg>");
  write_file(folder / "b/both.svg", active);
  write_file(folder / "b/new.svg", active);
  write_file(folder / "b/plain.svg", "<svg><rect x='1'/></svg>");
  const DiffResult result = folder_diff(folder / "a", folder / "b");
  const ImageLinks links{.images = write_item_images(result, {}, folder / "images"), .prefix = ""};
  const std::string markdown = diff_markdown(result, links);
  for (const char* id : {"both", "new"}) {
    EXPECT_FALSE(fs::exists(folder / "images" / (id + std::string(".svg")))) << id;
    EXPECT_EQ(markdown.find(id + std::string(".svg/")), std::string::npos) << markdown;
    const std::size_t section = markdown.find("#### " + std::string(id) + ", svg\n\nNot shown");
    ASSERT_NE(section, std::string::npos) << markdown;
    EXPECT_NE(markdown.find("unreadable", section), std::string::npos) << markdown;
  }
  EXPECT_TRUE(fs::exists(folder / "images/plain.svg/current.svg"));
  EXPECT_NE(markdown.find("](plain.svg/current.svg)"), std::string::npos) << markdown;
}

TEST(DiffOutputs, MarkdownEndsAtFiftyRowsAndCountsTheOthers) {
  DiffResult result;
  for (int i = 0; i < 120; ++i) {
    DiffItem& item = result.items.emplace_back();
    item.id = std::to_string(i);
    item.judgement = {Verdict::kWorse, true, "worse"};
  }
  EXPECT_NE(diff_markdown(result).find("and 70 more"), std::string::npos);
}

TEST(DiffOutputs, SchemasAreThoseOfTheCode) {
  for (const auto& [name, text] : comparison_schemas())
    EXPECT_EQ(read_file(std::filesystem::path(MAPPROOF_SOURCE_DIR) / "docs/schemas" / name), text)
        << "cmake --build build --target write_schemas";
}

TEST(DiffOutputs, JsonFollowsItsSchema) {
  const TemporaryFolder folder;
  write_base_study(folder / "a");
  std::vector<ValueCase> cases = record_cases();
  const std::vector<ValueCase> more = figure_cases();
  cases.insert(cases.end(), more.begin(), more.end());
  for (std::size_t i = 0; i < cases.size(); i += 20) {
    SCOPED_TRACE(cases[i].name);
    std::filesystem::remove_all(folder / "b");
    std::filesystem::copy(folder / "a", folder / "b", std::filesystem::copy_options::recursive);
    cases[i].change(folder / "b");
    const json value = json::parse(diff_json(folder_diff(folder / "a", folder / "b")).dump());
    EXPECT_EQ(schema_problem("diff", value), "");
  }
}

TEST(DiffSettings, TakeEveryKeyThatTheSchemaHas) {
  const std::string text = R"({
    "schema": {"name": "mapproof.diff_settings", "version": 1},
    "records": {"significance": 0.01, "least_effect": 0.5,
                "tolerances": {"mpe_m": {"absolute": 0.001}, "other": {"relative": 0.1}}},
    "figures": {"position": {"absolute": 0.5}},
    "images": {"noise": 3, "mean_noise": 1, "displacement_px": 1, "changed_share": 0.001,
                 "svg_distance": 0.1, "svg_colour": 2},
    "ignore": [{"id": "a", "x": 1, "y": 2, "width": 3, "height": 4},
               {"id": "*", "x": 9, "y": 9, "width": 1, "height": 1}],
    "allow": ["better", "style"]
  })";
  EXPECT_EQ(schema_problem("diff_settings", json::parse(text)), "");
  const DiffSettings settings = parse_diff_settings(text, "s.json");
  EXPECT_EQ(settings.records.significance, 0.01);
  EXPECT_EQ(settings.records.tolerances.at("mpe_m").absolute, 0.001);
  EXPECT_EQ(settings.records.tolerances.at("mpe_m").relative, 1e-6);  // As without settings.
  EXPECT_EQ(settings.images_of("a").ignored.size(), 2U);
  EXPECT_EQ(settings.images_of("b").ignored.size(), 1U);
  EXPECT_EQ(settings.images.noise, 3.0);
  EXPECT_EQ(settings.allowed.size(), 2U);
}

TEST(DiffSettings, AreRefusedWithFileAndPointer) {
  const auto refusal = [](const std::string& rest) {
    try {
      parse_diff_settings(
          R"({"schema": {"name": "mapproof.diff_settings", "version": 1})" + rest + "}", "s.json");
    } catch (const IoError& error) {
      return std::string(error.what());
    }
    return std::string("taken");
  };
  EXPECT_EQ(refusal(""), "taken");
  EXPECT_NE(refusal(R"(, "tolerance": 1)").find("s.json: "), std::string::npos);
  EXPECT_NE(refusal(R"(, "records": {"tolerances": {"mpe": {}}})").find("/records/tolerances"),
            std::string::npos);
  EXPECT_NE(refusal(R"(, "records": {"significance": 2})").find("/records/significance"),
            std::string::npos);
  EXPECT_NE(refusal(R"(, "images": {"noise": -1})").find("/images/noise"), std::string::npos);
  EXPECT_NE(refusal(R"(, "ignore": [{"id": "a", "x": 1, "y": 2, "width": 0, "height": 4}])")
                .find("/ignore/0/width"),
            std::string::npos);
  EXPECT_NE(refusal(R"(, "allow": ["best"])").find("/allow/0"), std::string::npos);
}

TEST(Verdicts, PassOnlyIfNothingIsVisibleOrItIsAllowed) {
  const std::vector<Verdict> none, better = {Verdict::kBetter, Verdict::kStyle};
  for (const Verdict verdict : kVerdicts) {
    const bool light = verdict == Verdict::kIdentical || verdict == Verdict::kWithinTolerance;
    EXPECT_EQ(passes({verdict, true, ""}, none), light) << name(verdict);
    EXPECT_EQ(passes({verdict, true, ""}, better),
              light || verdict == Verdict::kBetter || verdict == Verdict::kStyle);
    EXPECT_EQ(verdict_named(name(verdict)), verdict);
  }
  EXPECT_TRUE(passes({Verdict::kRenderer, false, ""}, none));
  EXPECT_FALSE(verdict_named("best"));
}

}  // namespace
}  // namespace mapproof::test
