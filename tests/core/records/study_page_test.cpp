#include "core/records/studies/study_page.hpp"

#include <functional>

#include <gtest/gtest.h>

#include "core/base/errors.hpp"
#include "core/base/files/files.hpp"
#include "core/base/files/gzip.hpp"
#include "core/base/text/base64.hpp"
#include "tests/support/temporary_folder.hpp"

namespace mapproof {
namespace {

namespace fs = std::filesystem;

const PageData kData{{{"study.json", "{\"title\": \"</script> \\u00e9\"}"},
                      {"results.csv", "setup,method\r\n"},
                      {"plaza-1/study.json", "{}"},
                      {"figures/map-isomap-K6.figure.json", "[1, 2]\n"}}};

std::string page_of(const std::string& element) {
  return "<!DOCTYPE html>\n<html><body><script>const a = 1;</script>\n" + element +
         "</body></html>\n";
}

/// The element that carries the data, with its line feed.
std::string element_of(const PageData& data) {
  const std::string empty = page_of(""), whole = with_page_data(empty, data);
  return whole.substr(empty.find("</body>"), whole.size() - empty.size());
}

/// A page with this document in its data.
std::string page_with(const std::string& json) {
  return page_of("<script id=\"mapproof-data\" type=\"application/gzip\">" + base64(gzipped(json)) +
                 "</script>");
}

std::string document(const std::string& files, int version = 1) {
  return R"({"schema": {"name": "mapproof.page", "version": )" + std::to_string(version) +
         R"(}, "files": [)" + files + "]}";
}

std::string problem_of(const std::string& html) {
  try {
    parse_page(html, "A.html");
  } catch (const IoError& error) {
    return error.what();
  }
  return "";
}

TEST(StudyPage, GivesTheFilesThatWerePutIntoIt) {
  const std::string element = element_of(kData);
  EXPECT_EQ(parse_page(page_of(element), "A.html").files, kData.files);
  EXPECT_EQ(element, element_of(kData));
  EXPECT_EQ(element.find('<', 1), element.size() - std::string("</script>\n").size());
  EXPECT_EQ(with_page_data("<p>", {}), "<p>");
  EXPECT_EQ(without_page_data(page_of(element)), page_of(""));
  EXPECT_EQ(without_page_data("<p>"), "<p>");
}

TEST(StudyPage, IsReadAfterAMailProgramBrokeItsLinesAndABrowserSavedIt) {
  std::string element = element_of(kData);
  for (std::size_t at = 100; at < element.size() - 20; at += 77) element.insert(at, "\r\n ");
  const std::string open = "<script id=\"mapproof-data\" type=\"application/gzip\">";
  element.replace(0, open.size(), "<script type=\"application/gzip\" id=\"mapproof-data\">");
  EXPECT_EQ(parse_page(page_of(element), "A.html").files, kData.files);
}

TEST(StudyPage, NamesOnlyFilesOfStudies) {
  for (const char* name : {"study.json", "plaza-1/results.csv", "map.json", "slam.json",
                           "figures/a.figure.json", "figures/map-kpca-sigma2-0.05.scene.json"})
    EXPECT_TRUE(is_page_file(name)) << name;
  for (const char* name :
       {"", "/study.json", "../study.json", "a/b/study.json", ".git/results.csv", "runs/x.json",
        "figures/../study.figure.json", "figures/.figure.json", "figures/a/b.figure.json",
        "figures/..figure.json", "figures/a.png", "study.json/", "STUDY.JSON", "a b/study.json",
        "figures/a.html", "report.html", "plaza/map.json"})
    EXPECT_FALSE(is_page_file(name)) << name;
  EXPECT_THROW(with_page_data("", {{{"../x", ""}}}), InvalidInput);
}

TEST(StudyPage, SaysInOneLineWhatIsWrongWithIt) {
  const std::string whole = page_of(element_of(kData));
  EXPECT_EQ(problem_of("<!DOCTYPE html><p>no data</p>"),
            "A.html: carries no data: it is not the page of a mapproof report, or of an older "
            "version; name the study's folder");
  EXPECT_EQ(problem_of(whole.substr(0, whole.find("</script>", 120))),
            "A.html: is cut off within its data");
  EXPECT_EQ(problem_of(page_of(element_of(kData) + element_of(kData))), "A.html: has data twice");
  EXPECT_EQ(problem_of(page_of("<script id=\"mapproof-data\">a?b</script>")),
            "A.html: its data are damaged: they are not gzip in base64");
  const std::string packed = gzipped(document(R"({"name": "map.json", "text": ""})"));
  EXPECT_EQ(problem_of(page_of("<script id=\"mapproof-data\">" +
                               base64(packed.substr(0, packed.size() / 2)) + "</script>")),
            "A.html: its data are cut off");
  EXPECT_EQ(problem_of(page_with(document(R"({"name": "map.json", "text": ""})", 2))),
            "A.html: /schema/version: version 2 is not known to this program, which reads version "
            "1");
}

TEST(StudyPage, RefusesNamesThatLeadElsewhere) {
  for (const char* name : {"../../etc/passwd", "/tmp/x", "figures/../../x.figure.json", "a\\u0000"})
    EXPECT_NE(
        problem_of(page_with(document(std::string(R"({"name": ")") + name + R"(", "text": ""})")))
            .find("A.html: /files/0/name: "),
        std::string::npos)
        << name;
  const std::string file = R"({"name": "map.json", "text": ""})";
  EXPECT_EQ(problem_of(page_with(document(file + "," + file))),
            "A.html: /files/1/name: is there twice");
  EXPECT_NE(problem_of(page_with(document(""))), "");
}

TEST(StudyPage, RefusesDataThatSwell) {
  const std::string bomb = gzipped(std::string(std::size_t{100} << 20, ' '));
  EXPECT_LT(bomb.size(), std::size_t{200'000});
  EXPECT_NE(problem_of(page_of("<script id=\"mapproof-data\">" + base64(bomb) + "</script>")), "");
}

TEST(StudyPage, UnpacksIntoAFolderThatGoesWithIt) {
  const test::TemporaryFolder folder;
  const fs::path file = folder.file("A.html", page_of(element_of(kData)));
  fs::path unpacked;
  {
    const StudyPage page(file);
    unpacked = page.folder();
    EXPECT_EQ(read_file(unpacked / "plaza-1/study.json"), "{}");
    EXPECT_EQ(page.named("bad " + (unpacked / "study.json").string() + ": line 1"),
              "bad " + file.string() + ": study.json: line 1");
    try {
      page.with_names(
          [&] { throw IoError((unpacked / "study.json").string(), "/title", "empty"); });
      FAIL();
    } catch (const IoError& error) {
      EXPECT_EQ(error.what(), file.string() + ": study.json: /title: empty");
    }
  }
  EXPECT_FALSE(fs::exists(unpacked));
}

TEST(StudyPage, IsKnownByItsFirstBytes) {
  const test::TemporaryFolder folder;
  EXPECT_TRUE(is_page(folder.file("a", "<!doctype HTML><p>")));
  EXPECT_TRUE(is_page(folder.file("b", "\xEF\xBB\xBF\n<!DOCTYPE html>")));
  EXPECT_FALSE(is_page(folder.file("c.html", "<svg/>")));
  EXPECT_FALSE(is_page(folder.file("d.html", "")));
  EXPECT_FALSE(is_page(folder.path()));
}

}  // namespace
}  // namespace mapproof
