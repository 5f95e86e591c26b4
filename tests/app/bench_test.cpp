#include <filesystem>
#include <map>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "core/base/files/files.hpp"
#include "core/records/studies/results_table.hpp"
#include "tests/support/program.hpp"

namespace mapproof::test {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

/// A small study of the mapping methods and methods of others.
class Bench : public ::testing::Test {
 protected:
  void SetUp() override {
    const Outcome made = mapproof(
        {"run", std::string(MAPPROOF_TEST_DATA) + "/experiments/small.json", "--out", at("study")});
    ASSERT_EQ(made.exit_code, 0) << made.error;
  }

  std::string at(const std::string& name) const { return folder_ / name; }

  static json method(const std::string& name, const std::vector<std::string>& command) {
    return {{"name", name},
            {"label", name},
            {"input", "distances"},
            {"command", command},
            {"timeout_s", 60}};
  }

  Outcome bench(const std::vector<json>& methods, const std::string& out = "out") {
    const json file{{"schema", {{"name", "mapproof.methods"}, {"version", 1}}},
                    {"methods", methods}};
    write_file(at("methods/methods.json"), file.dump());
    return mapproof(
        {"bench", at("study"), "--methods", at("methods/methods.json"), "--all", "--out", at(out)});
  }

  void copy_example(const std::string& name) {
    write_file(at("methods/" + name),
               read_file(std::string(MAPPROOF_SOURCE_DIR) + "/examples/methods/" + name));
  }

  /// The MPE of each method by setup, run and steps.
  std::map<std::string, std::map<std::string, double>> errors_of(const std::string& out) {
    std::map<std::string, std::map<std::string, double>> errors;
    const std::string file = at(out) + "/results.csv";
    for (const Result& row : parse_results_csv(read_file(file), file, {}))
      if (row.quantity == "mpe_m")
        errors[row.method][fmt::format("{}/{}/{}", row.at.setup, row.run,
                                       level_text(row.at.levels.at(0)))] = row.value;
    return errors;
  }

  /// Classical scaling of the distances is LPCA.
  void expect_lpca(const std::string& out, const std::string& method) {
    const auto errors = errors_of(out);
    ASSERT_TRUE(errors.contains(method));
    ASSERT_TRUE(errors.contains("lpca"));
    int compared = 0;
    for (const auto& [at, error] : errors.at("lpca")) {
      EXPECT_NEAR(errors.at(method).at(at), error, 1e-6 * error) << method << at;
      ++compared;
    }
    EXPECT_GT(compared, 0);
  }

  TemporaryFolder folder_;
};

TEST_F(Bench, TheReferenceClientInPythonIsLpca) {
  if (run_program({"python3", "--version"}).exit_code == 127)
    GTEST_SKIP() << "python3 is not installed";
  copy_example("scaling.py");
  const Outcome outcome = bench({method("other", {"python3", "scaling.py"})});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.error;
  expect_lpca("out", "other");
  EXPECT_TRUE(fs::exists(at("out") + "/report.html"));
  EXPECT_EQ(mapproof({"validate", at("out")}).exit_code, 0);
  ASSERT_EQ(bench({method("other", {"python3", "scaling.py"})}, "again").exit_code, 0);
  const Outcome diff = mapproof({"diff", at("out"), at("again"), "--page", at("diff.html")});
  EXPECT_EQ(diff.exit_code, 0) << diff.out;
  EXPECT_EQ(mapproof({"nightly", at("out"), "--store", at("store")}).exit_code, 0);
}

TEST_F(Bench, TheReferenceClientInRIsLpca) {
  if (run_program({"Rscript", "--version"}).exit_code == 127)
    GTEST_SKIP() << "Rscript is not installed (Debian: r-base-core)";
  copy_example("scaling.R");
  ASSERT_EQ(bench({method("other", {"Rscript", "scaling.R"})}).exit_code, 0);
  expect_lpca("out", "other");
}

TEST_F(Bench, TheReferenceClientInOctaveIsLpca) {
  if (run_program({"octave-cli", "--version"}).exit_code == 127)
    GTEST_SKIP() << "octave-cli is not installed (Debian: octave)";
  copy_example("scaling.m");
  ASSERT_EQ(bench({method("other", {"octave-cli", "--quiet", "scaling.m"})}).exit_code, 0);
  expect_lpca("out", "other");
}

TEST_F(Bench, TheReferenceClientInCppIsLpca) {
  copy_example("scaling.cpp");
  const Outcome compiled = run_program({"c++", "-std=c++17", "-I", "/usr/include/eigen3", "-o",
                                        at("methods/scaling"), at("methods/scaling.cpp")});
  if (compiled.exit_code != 0) GTEST_SKIP() << "no compiler with Eigen: " << compiled.error;
  ASSERT_EQ(bench({method("other", {"./scaling"})}).exit_code, 0);
  expect_lpca("out", "other");
}

TEST_F(Bench, TSneOfScikitLearnStandsBesideOurs) {
  if (run_program({"/usr/bin/python3", "-c", "import sklearn"}).exit_code != 0)
    GTEST_SKIP() << "scikit-learn is not installed (Debian: python3-sklearn)";
  copy_example("tsne.py");
  json tsne = method("tsne", {"/usr/bin/python3", "tsne.py"});
  tsne["files"] = {"tsne.py"};
  tsne["parameter"] = {{"symbol", "perplexity"}, {"values", {2}}};
  const Outcome outcome = bench({tsne});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.error;
  EXPECT_TRUE(errors_of("out").contains("tsne-perplexity2"));
  const std::string page = read_file(at("out") + "/report.html");
  EXPECT_NE(page.find("tsne, perplexity = 2"), std::string::npos);
  EXPECT_NE(page.find("SHA-256"), std::string::npos);
}

TEST_F(Bench, AMethodThatFailsLosesItsMapsAndSaysWhy) {
  const Outcome outcome =
      bench({method("crash", {"sh", "-c", "echo 'out of licences' >&2; exit 1"}),
             method("absent", {"no-such-program-anywhere"})});
  EXPECT_EQ(outcome.exit_code, 1);
  EXPECT_NE(outcome.error.find("out of licences"), std::string::npos) << outcome.error;
  const std::string page = read_file(at("out") + "/report.html");
  EXPECT_NE(page.find("out of licences"), std::string::npos);
  EXPECT_NE(page.find("cannot be started"), std::string::npos);
  const auto errors = errors_of("out");
  for (const auto& [at, error] : errors.at("crash")) EXPECT_TRUE(std::isnan(error)) << at;
}

TEST_F(Bench, ExportedDistancesGiveTheSameMapsWhenImported) {
  const Outcome exported =
      mapproof({"export", at("study"), "--what", "distances,features,history,ground-truth",
                "--format", "csv", "--out", at("files"), "--json"});
  ASSERT_EQ(exported.exit_code, 0) << exported.error;
  EXPECT_EQ(json::parse(exported.out).at("schema").at("name"), "mapproof.result.export");
  // A map of somebody else: the ground truth itself, of which the error is 0.
  int maps = 0;
  for (const auto& entry : fs::recursive_directory_iterator(at("files")))
    if (entry.path().filename() == "distances.csv") {
      const fs::path run = entry.path().parent_path().parent_path().parent_path();
      fs::copy(run / "ground-truth.csv", entry.path().parent_path() / "perfect.csv");
      ++maps;
    }
  ASSERT_GT(maps, 0);
  const Outcome imported =
      mapproof({"import", at("study"), at("files"), "--out", at("out"), "--json"});
  ASSERT_EQ(imported.exit_code, 0) << imported.error;
  EXPECT_EQ(json::parse(imported.out).at("maps"), maps);
  EXPECT_EQ(json::parse(imported.out).at("schema").at("name"), "mapproof.result.import");
  for (const auto& [at, error] : errors_of("out").at("perfect"))
    EXPECT_NEAR(error, 0.0, 1e-9) << at;
  write_file(at("files/layout-1-pose-1/ground-truth.csv"), "");
  EXPECT_EQ(mapproof({"export", at("study"), "--out", at("files")}).exit_code, 2);
  EXPECT_EQ(mapproof({"import", at("study"), at("study"), "--out", at("none")}).exit_code, 2);
  EXPECT_FALSE(fs::exists(at("none")));
}

}  // namespace
}  // namespace mapproof::test
