#include <signal.h>
#include <sys/wait.h>

#include <chrono>
#include <cmath>
#include <filesystem>
#include <map>
#include <thread>

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

/// Of each method by setup, run and steps.
using Errors = std::map<std::string, std::map<std::string, double>>;

/// Answers with the landmarks' rows as positions, which any affine map spoils; seconds for each.
constexpr const char* kClient = R"(import json, sys, time
for line in iter(sys.stdin.buffer.readline, b""):
    request = json.loads(line)
    sys.stdin.buffer.read(request["bytes"])
    n = request["rows"]
    rows = [[float(i % 4), float(i // 4 + 0.1 * (i % 3))] for i in range(n)]
    answer = {"id": request["id"], "coordinates": rows}
    if sys.argv[1] == "crash":
        sys.exit("out of licences")
    if sys.argv[1] == "nan":
        answer["coordinates"][0][0] = float("nan")
    if sys.argv[1] == "shape":
        rows.pop()
    if sys.argv[1] == "none":
        answer = {"id": request["id"], "error": "no map of these"}
    if sys.argv[1] == "partly":
        rows[-1] = None
    if sys.argv[1] in ("slow", "late"):
        time.sleep(0.05 if sys.argv[1] == "slow" else 60)
    print(json.dumps(answer), flush=True)
)";

bool has_python() { return run_program({"python3", "--version"}).exit_code != 127; }

/// A small experiment, and methods of others beside it.
class ExternalMethods : public ::testing::Test {
 protected:
  std::string at(const std::string& name) const { return folder_ / name; }

  static json method(const std::string& name, const std::vector<std::string>& command) {
    return {{"name", name},
            {"label", "Other " + name},
            {"input", "distances"},
            {"command", command},
            {"timeout_s", 60}};
  }

  /// A method of the client above.
  json client(const std::string& what) {
    write_file(at("methods/client.py"), kClient);
    return method(what, {"python3", "client.py", what});
  }

  /// The small experiment, whose affine maps are least squares.
  std::string experiment() {
    json file = json::parse(read_file(std::string(MAPPROOF_TEST_DATA) + "/experiments/small.json"));
    file["affine_fit"] = "least_squares";
    write_file(at("small.json"), file.dump());
    return at("small.json");
  }

  std::string methods_file(const std::vector<json>& methods) {
    const json file{{"schema", {{"name", "mapproof.methods"}, {"version", 1}}},
                    {"methods", methods}};
    write_file(at("methods/methods.json"), file.dump());
    return at("methods/methods.json");
  }

  Outcome run(const std::vector<json>& methods, const std::string& out = "out",
              const std::vector<std::string>& more = {}) {
    std::vector<std::string> words = {"run",   experiment(), "--methods", methods_file(methods),
                                      "--out", at(out)};
    words.insert(words.end(), more.begin(), more.end());
    return mapproof(words);
  }

  void copy_example(const std::string& name) {
    write_file(at("methods/" + name),
               read_file(std::string(MAPPROOF_SOURCE_DIR) + "/examples/methods/" + name));
  }

  Errors errors_of(const std::string& out, const std::string& quantity = "mpe_m") {
    Errors errors;
    const std::string file = at(out) + "/results.csv";
    for (const Result& row : parse_results_csv(read_file(file), file, {}))
      if (row.quantity == quantity && row.at.levels.size() == 1)
        errors[row.method][fmt::format("{}/{}/{}", row.at.setup.get(), row.run.get(),
                                       level_text(row.at.levels->at(0)))] = row.value;
    return errors;
  }

  /// Classical scaling of the distances is LPCA.
  void expect_lpca(const std::string& out, const std::string& method) {
    int compared = 0;
    for (const char* quantity :
         {"mpe_m", "moe_percent", "mpe_all_fitted_m", "moe_unmirrored_percent"}) {
      const Errors errors = errors_of(out, quantity);
      ASSERT_TRUE(errors.contains(method) && errors.contains("lpca"));
      for (const auto& [at, error] : errors.at("lpca")) {
        EXPECT_NEAR(errors.at(method).at(at), error, 1e-9) << method << " " << quantity << at;
        ++compared;
      }
    }
    EXPECT_GT(compared, 8);
  }

  TemporaryFolder folder_;
};

TEST_F(ExternalMethods, TheReferenceClientInPythonIsLpca) {
  if (!has_python()) GTEST_SKIP() << "python3 is not installed";
  copy_example("scaling.py");
  json other = method("other", {"python3", "scaling.py"});
  other["files"] = {"scaling.py"};
  const Outcome outcome = run({other}, "out", {"--jobs", "2"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.error;
  expect_lpca("out", "other");
  ASSERT_EQ(mapproof({"report", at("out")}).exit_code, 0);
  const std::string page = read_file(at("out") + "/report.html");
  for (const char* shown :
       {"Other other", "Digest of the files of other", "mpe-range-external", "python3 scaling.py"})
    EXPECT_NE(page.find(shown), std::string::npos) << shown;
  const Outcome valid = mapproof({"validate", at("out")});
  EXPECT_EQ(valid.exit_code, 0) << valid.out << valid.error;
  ASSERT_EQ(run({other}, "again").exit_code, 0);
  ASSERT_EQ(mapproof({"report", at("again")}).exit_code, 0);
  const Outcome diff = mapproof({"diff", at("out"), at("again"), "--page", at("diff.html")});
  EXPECT_EQ(diff.exit_code, 0) << diff.out;
}

TEST_F(ExternalMethods, TheReferenceClientInRIsLpca) {
  if (run_program({"Rscript", "--version"}).exit_code == 127)
    GTEST_SKIP() << "Rscript is not installed (Debian: r-base-core)";
  copy_example("scaling.R");
  ASSERT_EQ(run({method("other", {"Rscript", "scaling.R"})}).exit_code, 0);
  expect_lpca("out", "other");
}

TEST_F(ExternalMethods, TheReferenceClientInOctaveIsLpca) {
  if (run_program({"octave-cli", "--version"}).exit_code == 127)
    GTEST_SKIP() << "octave-cli is not installed (Debian: octave)";
  copy_example("scaling.m");
  ASSERT_EQ(run({method("other", {"octave-cli", "--quiet", "scaling.m"})}).exit_code, 0);
  expect_lpca("out", "other");
}

TEST_F(ExternalMethods, TheReferenceClientInCppIsLpca) {
  copy_example("scaling.cpp");
  const Outcome compiled = run_program({"c++", "-std=c++17", "-I", "/usr/include/eigen3", "-o",
                                        at("methods/scaling"), at("methods/scaling.cpp")});
  if (compiled.exit_code != 0) GTEST_SKIP() << "no compiler with Eigen: " << compiled.error;
  ASSERT_EQ(run({method("other", {"./scaling"})}).exit_code, 0);
  expect_lpca("out", "other");
}

TEST_F(ExternalMethods, TSneHasTheErrorsThatAScriptFindsByHand) {
  if (run_program({"/usr/bin/python3", "-c", "import sklearn"}).exit_code != 0)
    GTEST_SKIP() << "scikit-learn is not installed (Debian: python3-sklearn)";
  copy_example("tsne.py");
  json tsne = method("tsne", {"/usr/bin/python3", "tsne.py"});
  tsne["files"] = {"tsne.py"};
  tsne["parameter"] = {{"symbol", "perplexity"}, {"values", {2, 4}}};
  const Outcome outcome = run({tsne});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.error;
  ASSERT_EQ(mapproof({"export", at("out"), "--out", at("files")}).exit_code, 0);
  const Outcome by_hand = run_program(
      {"/usr/bin/env", "OMP_NUM_THREADS=1", "/usr/bin/python3",
       std::string(MAPPROOF_SOURCE_DIR) + "/tests/app/tsne_by_hand.py", at("files"), "4"});
  ASSERT_EQ(by_hand.exit_code, 0) << by_hand.error;
  const json found = json::parse(by_hand.out);
  for (const char* quantity : {"mpe_m", "moe_percent"}) {
    const Errors errors = errors_of("out", quantity);
    ASSERT_TRUE(errors.contains("tsne-perplexity2"));
    const auto& ours = errors.at("tsne-perplexity4");
    ASSERT_EQ(ours.size(), found.size());
    for (const auto& [at, error] : ours) {
      const double expected = found.at(at).at(quantity).get<double>();
      EXPECT_NEAR(error, expected, 1e-9 * (1.0 + expected)) << quantity << " " << at;
    }
  }
}

TEST_F(ExternalMethods, ThatFailLoseTheirMapsAndSayWhy) {
  if (!has_python()) GTEST_SKIP() << "python3 is not installed";
  json late = client("late");
  late["timeout_s"] = 0.2;
  const std::vector<json> methods = {client("crash"),
                                     client("nan"),
                                     client("shape"),
                                     client("none"),
                                     client("partly"),
                                     late,
                                     method("absent", {"no-such-program-anywhere"})};
  const Outcome outcome = run(methods, "out", {"--layouts", "1", "--poses", "1", "--json"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.error;
  const json object = json::parse(outcome.out);
  // Seven methods at three checkpoints.
  EXPECT_GE(object.at("records_with_status"), 7 * 3);
  EXPECT_EQ(object.at("records_without_map"), 6 * 3);
  const std::string run_file = read_file(at("out") + "/runs/layout-1-pose-1.json");
  for (const char* reason : {"method_ended", "method_numbers", "method_reply", "method_refused",
                             "method_left_out", "method_timeout", "method_not_started"})
    EXPECT_NE(run_file.find(reason), std::string::npos) << reason;
  ASSERT_EQ(mapproof({"report", at("out")}).exit_code, 0);
  const std::string page = read_file(at("out") + "/report.html");
  for (const char* why :
       {"out of licences", "a coordinate is NaN or infinite", "must be an array of 12 rows",
        "no map of these", "gives no position to 1 landmark", "no answer within 0.2 s",
        "cannot be started"})
    EXPECT_NE(page.find(why), std::string::npos) << why;
  const Errors errors = errors_of("out");
  for (const auto& [at, error] : errors.at("crash")) EXPECT_TRUE(std::isnan(error)) << at;
  for (const auto& [at, error] : errors.at("partly")) EXPECT_TRUE(std::isfinite(error)) << at;
  EXPECT_EQ(mapproof({"validate", at("out")}).exit_code, 0);
}

TEST_F(ExternalMethods, AStudyThatWasKilledEndsInTheSameBytes) {
  if (!has_python()) GTEST_SKIP() << "python3 is not installed";
  const json slow = client("slow");
  ASSERT_EQ(run({slow}, "whole").exit_code, 0);
  const pid_t process = start_mapproof({"run", experiment(), "--methods", methods_file({slow}),
                                        "--out", at("killed"), "--jobs", "2"});
  const fs::path first = at("killed/runs/layout-1-pose-1.json");
  for (int i = 0; i < 600 && !fs::exists(first); ++i)
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  ::kill(process, SIGKILL);
  ::waitpid(process, nullptr, 0);
  EXPECT_FALSE(fs::exists(at("killed/results.csv")));
  ASSERT_EQ(run({slow}, "killed").exit_code, 0);
  const auto records = [&](const std::string& out) {
    Contents all = contents(at(out));
    std::erase_if(all, [](const auto& file) { return file.first == "timings.jsonl"; });
    return all;
  };
  expect_same(records("whole"), records("killed"));
}

TEST_F(ExternalMethods, OfOtherFilesAreRunAgainAndNamedByTheDiff) {
  if (!has_python()) GTEST_SKIP() << "python3 is not installed";
  json other = client("partly");
  other["files"] = {"client.py"};
  ASSERT_EQ(run({other}, "before").exit_code, 0);
  fs::copy(at("before"), at("after"), fs::copy_options::recursive);
  write_file(at("methods/client.py"), std::string(kClient) + "# Another version.\n");
  std::vector<std::string> words = {"run",   experiment(), "--methods", methods_file({other}),
                                    "--out", at("after")};
  const Outcome outcome = mapproof(words);
  ASSERT_EQ(outcome.exit_code, 0) << outcome.error;
  EXPECT_NE(outcome.error.find("other files of the method partly"), std::string::npos)
      << outcome.error;
  const Outcome diff = mapproof({"diff", at("before"), at("after"), "--page", at("diff.html")});
  EXPECT_EQ(diff.exit_code, 0) << diff.out << diff.error;
  EXPECT_NE(read_file(at("diff.html")).find("files of the method partly"), std::string::npos);
  // A changed description is another experiment.
  other["timeout_s"] = 30;
  words[3] = methods_file({other});
  EXPECT_EQ(mapproof(words).exit_code, 2);
  fs::remove(at("methods/client.py"));
  const Outcome gone = mapproof(words);
  EXPECT_EQ(gone.exit_code, 2);
  EXPECT_NE(gone.error.find("client.py"), std::string::npos) << gone.error;
}

TEST_F(ExternalMethods, AreNeverStartedByRecords) {
  const json marks = method("marks", {"sh", "-c", "touch '" + at("started") + "'"});
  ASSERT_EQ(run({marks}, "out", {"--layouts", "1", "--poses", "1"}).exit_code, 0);
  ASSERT_TRUE(fs::exists(at("started")));
  fs::remove(at("started"));
  fs::copy(at("out"), at("copy"), fs::copy_options::recursive);
  fs::remove(at("copy/runs/layout-1-pose-1.json"));
  for (const std::vector<std::string>& words : std::vector<std::vector<std::string>>{
           {"report", at("out")},
           {"report", at("copy")},
           {"diff", at("out"), at("copy"), "--page", at("diff.html")},
           {"check", at("out"), "--baseline", at("copy"), "--page", at("check.html")},
           {"validate", at("out")},
           {"export", at("out"), "--out", at("files")},
           {"import", at("out"), at("files"), "--out", at("imported")},
           {"render", at("out"), "--out", at("drawn")},
           {"run", at("out/study.json"), "--out", at("second")},
           {"run", at("out"), "--out", at("second")},
           {"reproduce", at("out/study.json"), "--out", at("second")},
           {"nightly", at("out/study.json"), "--store", at("store")},
           {"nightly", at("out"), "--store", at("store")}})
    mapproof(words);
  EXPECT_FALSE(fs::exists(at("started")));
  EXPECT_FALSE(fs::exists(at("second/runs")));
}

TEST_F(ExternalMethods, StandInTheExperimentToo) {
  if (!has_python()) GTEST_SKIP() << "python3 is not installed";
  json file = json::parse(read_file(experiment()));
  file["external_methods"] = json::array({client("partly")});
  write_file(at("methods/mine.json"), file.dump());
  const Outcome outcome = mapproof({"reproduce", at("methods/mine.json"), "--out", at("out")});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.error;
  EXPECT_TRUE(errors_of("out").contains("partly"));
  // Both files name it.
  const Outcome twice = mapproof({"run", at("methods/mine.json"), "--methods",
                                  methods_file({client("partly")}), "--out", at("twice")});
  EXPECT_EQ(twice.exit_code, 2);
  EXPECT_NE(twice.error.find("is there twice"), std::string::npos) << twice.error;
  const Outcome unused = mapproof(
      {"run", "moved", "--methods", methods_file({client("partly")}), "--out", at("unused")});
  EXPECT_EQ(unused.exit_code, 2);
  EXPECT_NE(unused.error.find("--methods"), std::string::npos) << unused.error;
}

TEST_F(ExternalMethods, AreComparedInNightlyRuns) {
  if (!has_python()) GTEST_SKIP() << "python3 is not installed";
  const std::string methods = methods_file({client("partly")});
  for (int i = 0; i < 2; ++i) {
    const Outcome outcome =
        mapproof({"nightly", experiment(), "--methods", methods, "--store", at("store")});
    EXPECT_EQ(outcome.exit_code, 0) << outcome.out << outcome.error;
  }
  const std::string trends = read_file(at("store/trends/small/report.html"));
  EXPECT_NE(trends.find("Other partly"), std::string::npos);
  EXPECT_NE(trends.find("ISOMAP"), std::string::npos);
  EXPECT_EQ(trends.find(">isomap-K"), std::string::npos);
}

TEST_F(ExternalMethods, ExportedDistancesGiveTheSameMapsWhenImported) {
  ASSERT_EQ(mapproof({"run", experiment(), "--out", at("study")}).exit_code, 0);
  const Outcome exported =
      mapproof({"export", at("study"), "--what", "distances,features,history,truth",
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
  const Errors errors = errors_of("out");
  for (const auto& [at, error] : errors.at("perfect")) EXPECT_NEAR(error, 0.0, 1e-9) << at;
  write_file(at("files/layout-1-pose-1/ground-truth.csv"), "");
  EXPECT_EQ(mapproof({"export", at("study"), "--out", at("files")}).exit_code, 2);
  EXPECT_EQ(mapproof({"import", at("study"), at("study"), "--out", at("none")}).exit_code, 2);
  EXPECT_FALSE(fs::exists(at("none")));
}

}  // namespace
}  // namespace mapproof::test
