#include "core/records/metrics/metrics_json.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "core/base/errors.hpp"
#include "core/base/files/files.hpp"

namespace mapproof {
namespace {

std::string sample(const std::string& file) {
  return read_file(std::string(MAPPROOF_SOURCE_DIR) + "/tests/data/metrics/" + file);
}

/// The error of reading.
std::string problem(const std::string& text, std::optional<Better> better = Better::kLower) {
  try {
    parse_metrics(text, "m.json", better);
  } catch (const IoError& error) {
    return error.what();
  }
  return "";
}

std::string own(const std::string& metrics) {
  return R"({"schema": {"name": "mapproof.metrics", "version": 1}, "name": "speed", "metrics": [)" +
         metrics + "]}";
}

TEST(Metrics, OfGithubActionBenchmarkAreThoseOfTheLastEntryOfEachSuite) {
  const Metrics metrics = parse_metrics(sample("benchmark_data.js"), "data.js", std::nullopt);
  EXPECT_EQ(metrics.commit, std::string(40, '2'));
  EXPECT_EQ(metrics.repository, "https://github.com/me/solver");
  ASSERT_EQ(metrics.metrics.size(), 3U);
  EXPECT_EQ(metrics.metrics[0].name, "solve 1000");
  EXPECT_EQ(metrics.metrics[0].suite, "Solver speed");
  EXPECT_EQ(metrics.metrics[0].value, 13.0);
  EXPECT_EQ(metrics.metrics[1].unit, "MiB");
  EXPECT_EQ(metrics.metrics[2].better, Better::kHigher) << "customBiggerIsBetter";
}

TEST(Metrics, OfTheListForItsCustomToolsNeedADirection) {
  const std::string list = R"([{"name": "a", "unit": "ms", "value": 3, "extra": "x"},
                              {"name": "a", "unit": "MB", "value": 4}])";
  EXPECT_EQ(parse_metrics(list, "m.json", Better::kHigher).metrics[1].better, Better::kHigher);
  EXPECT_NE(problem(list, std::nullopt).find("m.json: /0: does not say which way it improves"),
            std::string::npos);
}

TEST(Metrics, OfGoogleBenchmarkAreMediansOverRepetitions) {
  const Metrics metrics = parse_metrics(sample("google_benchmark.json"), "g.json", std::nullopt);
  ASSERT_EQ(metrics.metrics.size(), 2U) << "aggregates are left out";
  EXPECT_EQ(metrics.metrics[0].name, "BM_Sort<int>/1024");
  EXPECT_EQ(metrics.metrics[0].value, 101.0);
  EXPECT_EQ(metrics.metrics[0].unit, "us");
  EXPECT_TRUE(std::isnan(metrics.metrics[1].value)) << "an error is a lost result";
}

TEST(Metrics, OfPytestBenchmarkAreMediansInSecondsWithTheirCommit) {
  const Metrics metrics = parse_metrics(sample("pytest_benchmark.json"), "p.json", std::nullopt);
  ASSERT_EQ(metrics.metrics.size(), 1U);
  EXPECT_EQ(metrics.metrics[0].name, "tests/test_speed.py::test_solve[1000]");
  EXPECT_EQ(metrics.metrics[0].value, 0.0125);
  EXPECT_EQ(metrics.metrics[0].unit, "s");
  EXPECT_EQ(metrics.commit, std::string(40, '3'));
}

TEST(Metrics, OfTheirOwnSchemaSayAllThemselves) {
  const Metrics metrics = parse_metrics(
      own(R"({"name": "a", "unit": "ms", "value": null, "better": "lower"},
             {"name": "a", "suite": "s", "value": 2, "better": "higher"})"),
      "m.json", std::nullopt);
  EXPECT_EQ(metrics.name, "speed");
  EXPECT_TRUE(std::isnan(metrics.metrics[0].value));
  EXPECT_EQ(metrics.metrics[1].unit, "");
}

TEST(Metrics, ThatCannotBeUsedAreRefusedInALineThatNamesTheirPlace) {
  const std::string metric = R"({"name": "a", "unit": "ms", "value": 1})";
  EXPECT_NE(problem("[" + metric + "," + metric + "]").find("/1: the metric \"a\" is there twice"),
            std::string::npos);
  EXPECT_NE(problem(R"([{"name": "a", "unit": "", "value": NaN}])").find("m.json: line 1"),
            std::string::npos);
  EXPECT_NE(problem(R"([{"name": "a", "unit": "", "value": 1e300}])").find("/0/value"),
            std::string::npos);
  EXPECT_NE(problem(R"([{"name": "a", "unit": "", "value": "12"}])").find("/0/value"),
            std::string::npos);
  EXPECT_NE(problem(R"([{"name": "", "unit": "", "value": 1}])").find("/0/name: is empty"),
            std::string::npos);
  EXPECT_NE(problem(R"([{"name": "a\u202eb", "unit": "", "value": 1}])").find("/0/name"),
            std::string::npos);
  EXPECT_NE(problem("[]").find("m.json"), std::string::npos);
  EXPECT_NE(problem(R"({"a": 1})").find("none of the formats"), std::string::npos);
  EXPECT_NE(problem(R"({"entries": {"s": [{"tool": "mine", "benches": []}]}})").find("/tool"),
            std::string::npos);
  EXPECT_NE(problem(own(R"({"name": "a", "valu": 1, "value": 1, "better": "lower"})")).find("valu"),
            std::string::npos);
  EXPECT_EQ(problem("window.BENCHMARK_DATA = 1").empty(), false);
}

TEST(Metrics, OfDifferentUnitsAreDifferentQuantities) {
  const auto id = [](const std::string& unit, Better better = Better::kLower) {
    return quantity_of({.name = "a", .unit = unit, .better = better}).id;
  };
  EXPECT_EQ(id("ms"), "value_ms");
  EXPECT_EQ(id("ns/iter"), "value_ns_iter");
  EXPECT_EQ(id(""), "value");
  EXPECT_EQ(id("%", Better::kHigher), "value_percent_higher");
  EXPECT_NE(id("Ms"), id("ms"));
  EXPECT_NE(id("<b>"), id("b"));
  EXPECT_EQ(id("µs").rfind("value_", 0), 0U);
}

}  // namespace
}  // namespace mapproof
