#include "core/base/text/retired_names.hpp"
#include "core/records/maps/map_csv.hpp"

#include <regex>

#include <gtest/gtest.h>

#include "core/base/errors.hpp"
#include "core/json/json_cursor.hpp"
#include "core/json/json_document.hpp"
#include "tests/support/program.hpp"

namespace mapproof {
namespace {

std::vector<RetiredName> retired(NameKind kind) {
  std::vector<RetiredName> names;
  for (const RetiredName& name : retired_names())
    if (name.kind == kind) names.push_back(name);
  EXPECT_FALSE(names.empty());
  return names;
}

TEST(RetiredNames, OfOptionsAreRefusedInOneLineWithTheNewName) {
  for (const RetiredName& option : retired(NameKind::kOption))
    for (const std::string& word : {std::string(option.name), std::string(option.name) + "=x"}) {
      const std::size_t blank = word.find(' ');  // Of one command alone.
      const test::Outcome outcome =
          blank == std::string::npos
              ? test::mapproof({"map", "seen.csv", word})
              : test::mapproof({word.substr(0, blank), "a", "b", word.substr(blank + 1)});
      EXPECT_EQ(outcome.exit_code, 2);
      EXPECT_EQ(outcome.error,
                "mapproof: " + std::string(option.name.substr(option.name.find('-'))) +
                    ": this option is now called " + std::string(option.now) + "\n");
    }
}

TEST(RetiredNames, OfOptionsAreReplacedByOnesThatACommandTakes) {
  const std::string help = test::mapproof({"map", "--help"}).out +
                           test::mapproof({"slam", "--help"}).out +
                           test::mapproof({"diff", "--help"}).out;
  for (const RetiredName& option : retired(NameKind::kOption)) {
    const auto is_listed = [&](std::string_view name) {
      return std::regex_search(help, std::regex("(^|[ ,\n])" + std::string(name) + "([ ,\n]|$)"));
    };
    EXPECT_TRUE(is_listed(option.now)) << option.now;
    if (option.name.starts_with("--")) {
      EXPECT_FALSE(is_listed(option.name)) << option.name;
    }
  }
}

TEST(RetiredNames, OfValuesAndExperimentsAreRefusedWithTheNewName) {
  for (const RetiredName& value : retired(NameKind::kValue)) {
    const test::TemporaryFolder folder;
    const std::string name(value.name);
    const test::Outcome outcome = value.now == "last-passing"
                                      ? test::mapproof({"nightly", "boots2013", "--store",
                                                        folder / "store", "--reference", name})
                                      : test::mapproof({"map", "seen.csv", "--missing", name});
    EXPECT_EQ(outcome.exit_code, 2);
    EXPECT_NE(outcome.error.find("is now called " + std::string(value.now)), std::string::npos)
        << outcome.error;
  }
  for (const RetiredName& experiment : retired(NameKind::kExperiment)) {
    const test::Outcome outcome = test::mapproof({"reproduce", std::string(experiment.name)});
    EXPECT_EQ(outcome.exit_code, 2);
    EXPECT_NE(outcome.error.find("is now called " + std::string(experiment.now)), std::string::npos)
        << outcome.error;
  }
}

TEST(RetiredNames, OfKeysAreRefusedWithTheNewNameWhereThatIsAKey) {
  for (const RetiredName& key : retired(NameKind::kKey)) {
    const JsonDocument document =
        parse_json("{\"" + std::string(key.name) + "\": 1}", "settings.json");
    try {
      document.cursor().allow_only({key.now, "other"});
      ADD_FAILURE() << key.name;
    } catch (const IoError& error) {
      EXPECT_NE(std::string(error.what())
                    .find("\"" + std::string(key.name) + "\": this key is now called \"" +
                          std::string(key.now) + "\""),
                std::string::npos)
          << error.what();
    }
    try {
      document.cursor().allow_only({"other"});
      ADD_FAILURE() << key.name;
    } catch (const IoError& error) {
      EXPECT_EQ(std::string(error.what()).find("is now called"), std::string::npos);
    }
  }
}

TEST(RetiredNames, OfFormatsAreRefusedWithTheNewName) {
  const test::TemporaryFolder folder;
  for (const RetiredName& format : retired(NameKind::kFormat)) {
    const std::string file =
        folder.file("old.json", "{\"schema\": {\"name\": \"" + std::string(format.name) +
                                    "\", \"version\": 1}, \"landmarks\": [\"a\", \"b\", \"c\"]}");
    for (const char* sensor : {"bearing", "range-bearing"}) {
      const test::Outcome outcome =
          test::mapproof({"map", file, "--sensor", sensor, "--out", folder / "map"});
      EXPECT_EQ(outcome.exit_code, 2);
      EXPECT_NE(outcome.error.find("this format is now called \"" + std::string(format.now) + "\""),
                std::string::npos)
          << outcome.error;
    }
  }
}

TEST(RetiredNames, OfColumnsAreRefusedWithTheNewName) {
  ASSERT_FALSE(retired(NameKind::kColumn).empty());
  for (const RetiredName& column : retired(NameKind::kColumn)) {
    const std::string text = "name,x_m,y_m," + std::string(column.name) + "\r\na,0,0,0\r\n";
    std::string said;
    try {
      parse_map_csv(text, "map.csv");
    } catch (const IoError& error) {
      said = error.what();
    }
    EXPECT_NE(said.find("the column \"" + std::string(column.name) + "\" is now called \"" +
                        std::string(column.now) + "\""),
              std::string::npos)
        << said;
  }
}

TEST(RetiredNames, GroundTruthHasItsShortName) {
  for (const char* command : {"map", "slam"})
    EXPECT_NE(test::mapproof({command, "--help"}).out.find("--ground-truth, --truth FILE"),
              std::string::npos);
}

}  // namespace
}  // namespace mapproof
