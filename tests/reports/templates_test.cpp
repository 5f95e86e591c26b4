#include "reports/html/templates.hpp"

#include <sys/stat.h>

#include <filesystem>

#include <gtest/gtest.h>

#include "core/base/errors.hpp"
#include "core/base/files/files.hpp"
#include "render/theme/theme.hpp"
#include "reports/html/report_html.hpp"
#include "reports/html/template_check.hpp"

namespace mapproof {
namespace {

namespace fs = std::filesystem;

/// An empty folder of this test's own.
fs::path fresh_folder() {
  const auto* test = ::testing::UnitTest::GetInstance()->current_test_info();
  const fs::path folder = fs::path(::testing::TempDir()) / "templates" / test->name();
  fs::remove_all(folder);
  fs::create_directories(folder);
  return folder;
}

/// What load_templates says of a folder with this one file; empty if it takes it.
std::string complaint(const std::string& name, const std::string& text) {
  const fs::path folder = fresh_folder();
  write_file(folder / name, text);
  try {
    load_templates(folder);
    return "";
  } catch (const IoError& error) {
    return error.what();
  }
}

std::string repeated(const std::string& text, int times) {
  std::string out;
  for (int i = 0; i < times; ++i) out += text;
  return out;
}

TEST(Templates, AreEmbeddedInTheProgram) {
  const Templates templates = load_templates();
  for (const char* name : {"report.mustache", "report.css", "report.js", "table.mustache"})
    EXPECT_TRUE(templates.files.contains(name)) << name;
}

/// The dark colour that the script gives to a light one, "" for none.
std::string dark_colour_of(Colour light) {
  const std::string script = load_templates(std::nullopt).files.at("report_dark.js");
  const std::string key = "\"" + hex(light) + "\": \"";
  const std::size_t at = script.find(key);
  return at == std::string::npos ? "" : script.substr(at + key.size(), 7);
}

TEST(Templates, HaveTheColoursOfTheDarkTheme) {
  const Theme light = report_theme(), dark = dark_theme();
  EXPECT_EQ(dark_colour_of(light.background), hex(dark.background));
  EXPECT_EQ(dark_colour_of(light.text), hex(dark.text));
  EXPECT_EQ(dark_colour_of(light.muted), hex(dark.muted));
  EXPECT_EQ(dark_colour_of(light.of(ThemeColour::kFaint)), hex(dark.of(ThemeColour::kFaint)));
  EXPECT_EQ(dark_colour_of(light.grid), hex(dark.grid));
  EXPECT_NE(load_templates(std::nullopt)
                .files.at("report_dark.js")
                .find("kMuted = \"" + hex(light.muted) + "\", kDarkDashed = \"" +
                      hex(dark.of_dashed(ThemeColour::kMuted)) + "\""),
            std::string::npos);
  EXPECT_EQ(dark_colour_of(light.warning), hex(dark.warning));
  for (std::size_t i = 0; i < light.series.size(); ++i)
    EXPECT_EQ(dark_colour_of(light.series[i]), hex(dark.series[i]));
}

TEST(Templates, OfAFolderReplaceTheEmbeddedOnesFileByFile) {
  const fs::path folder = fresh_folder();
  write_file(folder / "report.mustache", "<title>{{title}}</title>\n{{> paragraph}}");
  const Templates templates = load_templates(folder);
  EXPECT_EQ(templates.files.at("paragraph.mustache"),
            load_templates().files.at("paragraph.mustache"));
  EXPECT_EQ(report_html({"a < b", "", {}, ""}, templates, {}), "<title>a &lt; b</title>\n\n");
}

TEST(Templates, ReportWhereASectionIsLeftOpen) {
  const std::string text = complaint("report.mustache", "one\n{{#sections}}\n{{#blocks}}\n");
  EXPECT_NE(text.find("report.mustache: line 3: the section \"blocks\" is not closed"),
            std::string::npos)
      << text;
}

TEST(Templates, ReportWhereATagIsBroken) {
  EXPECT_NE(complaint("table.mustache", "a\n{{title").find("line 2: the tag is not closed"),
            std::string::npos);
  EXPECT_NE(complaint("table.mustache", "{{/a}}").find("line 1"), std::string::npos);
  EXPECT_NE(complaint("table.mustache", "{{#a}}{{/b}}").find("line 1"), std::string::npos);
  EXPECT_NE(complaint("table.mustache", "{{=<% %>=}}").find("delimiters"), std::string::npos);
  EXPECT_NE(complaint("table.mustache", "{{> nothing}}").find("no template \"nothing\""),
            std::string::npos);
}

TEST(Templates, MayNotIncludeThemselvesNeitherDirectlyNorThroughAnother) {
  EXPECT_NE(complaint("table.mustache", "{{> table}}").find("without end"), std::string::npos);
  EXPECT_NE(complaint("table.mustache", "{{> section}}").find("without end"), std::string::npos);
  EXPECT_EQ(complaint("table.mustache", "{{> paragraph}}{{> paragraph}}"), "");
}

TEST(Templates, CannotMakeTheProgramRunOutOfStackOrTime) {
  EXPECT_NE(complaint("table.mustache", repeated("{{#a}}", 100000)).find("deep"),
            std::string::npos);
  EXPECT_NE(complaint("table.mustache", repeated("{{#a}}", 20000) + repeated("{{/a}}", 20000))
                .find("deep"),
            std::string::npos);
  EXPECT_EQ(complaint("table.mustache", repeated("{{a}}", 100000)), "");
  const fs::path folder = fresh_folder();
  write_file(folder / "report.mustache", repeated("{{> gallery}}", 20000));
  write_file(folder / "gallery.mustache", repeated("{{> figure}}", 20000));
  write_file(folder / "figure.mustache", "");
  EXPECT_THROW(load_templates(folder), IoError);
}

TEST(Templates, CannotEndTheStyleSheetOrTheScriptWithinIt) {
  EXPECT_NE(complaint("report.css", "a\nb</STYLE>").find("report.css: line 2"), std::string::npos);
  EXPECT_NE(complaint("report.js", "</script>").find("line 1"), std::string::npos);
  EXPECT_NE(complaint("report.js", "x = '<!--'").find("line 1"), std::string::npos);
}

TEST(Templates, RefuseAFolderWithoutTemplates) {
  const fs::path folder = fresh_folder();
  EXPECT_THROW(load_templates(folder / "missing"), IoError);
  EXPECT_THROW(load_templates(folder), IoError);  // empty: surely another folder was meant
  fs::create_directories(folder / "report.css");
  EXPECT_THROW(load_templates(folder), IoError);
}

TEST(Templates, DoNotWaitForAPipe) {
  const fs::path folder = fresh_folder();
  ASSERT_EQ(::mkfifo((folder / "report.css").c_str(), 0600), 0);
  EXPECT_THROW(load_templates(folder), IoError);
}

}  // namespace
}  // namespace mapproof
