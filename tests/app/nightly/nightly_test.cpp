#include <sys/wait.h>

#include <chrono>
#include <csignal>
#include <sstream>
#include <thread>

#include <gtest/gtest.h>
#include <sqlite3.h>
#include <nlohmann/json.hpp>

#include "core/base/files/files.hpp"
#include "tests/support/program.hpp"
#include "tests/support/schemas/schema_problem.hpp"

namespace mapproof::test {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

const std::string kSmall = std::string(MAPPROOF_SOURCE_DIR) + "/tests/data/experiments/small.json";

Outcome nightly_run(const fs::path& store, const std::vector<std::string>& more = {},
                    const std::string& experiment = kSmall, const Limits& limits = {}) {
  std::vector<std::string> arguments = {"nightly", experiment, "--profile", "tiny",  "--store",
                                        store,     "--jobs",   "1",         "--json"};
  arguments.insert(arguments.end(), more.begin(), more.end());
  return mapproof(arguments, limits);
}

json history(const fs::path& store) {
  const Outcome outcome = mapproof({"history", store, "--json"});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.error;
  return json::parse(outcome.out);
}

std::size_t lines_with(const std::string& text, const std::string& part) {
  std::istringstream lines(text);
  std::size_t count = 0;
  for (std::string line; std::getline(lines, line);) count += line.find(part) != std::string::npos;
  return count;
}

/// Runs statements on the store's file from outside the program.
void change(const fs::path& store, const std::string& statements) {
  sqlite3* database = nullptr;
  ASSERT_EQ(sqlite3_open((store / "history.sqlite").c_str(), &database), SQLITE_OK);
  EXPECT_EQ(sqlite3_exec(database, statements.c_str(), nullptr, nullptr, nullptr), SQLITE_OK);
  sqlite3_close(database);
}

/// Makes the errors of the nightly runs in the history smaller, as if the program had been better
/// then.
void make_better(const fs::path& store, double factor) {
  change(store, "UPDATE scores SET value = value * " + std::to_string(factor) +
                    " WHERE series IN (SELECT id FROM series WHERE quantity = 'mpe_m')");
}

TEST(Nightly, RecordsANightlyRunAndItsReportAndFindsNothingWorseInTheNext) {
  const TemporaryFolder folder;
  const fs::path store = folder / "history";
  const Outcome first = nightly_run(store);
  ASSERT_EQ(first.exit_code, 0) << first.error;
  const Outcome second = nightly_run(store);
  ASSERT_EQ(second.exit_code, 0) << second.error << second.out;
  EXPECT_EQ(history(store).at("nightly_runs").size(), 2U);
  for (const char* file :
       {"index.html", "trends/small/report.html", "nightly_runs/0001/small/report.html",
        "nightly_runs/0002/small/study.json"})
    EXPECT_TRUE(fs::exists(store / file)) << file;
  EXPECT_GT(fs::hard_link_count(store / "nightly_runs/0002/small/figures/fig-2.svg"), 2U)
      << "figures of both nightly runs are one file";
  EXPECT_EQ(mapproof({"history", store, "--verify"}).exit_code, 0);
  const auto report_of = [&](const char* number) {
    return read_file(store / "nightly_runs" / number / "small/report.html");
  };
  EXPECT_NE(report_of("0001").find("Nightly run 1: not compared"), std::string::npos);
  EXPECT_NE(report_of("0002").find("Nightly run 2: nothing got worse since nightly run 1"),
            std::string::npos);
}

TEST(Nightly, RemovesWhatAKilledOneLeftWhereverItWrote) {
  const TemporaryFolder folder;
  const fs::path store = folder / "history", pages = folder / "pages";
  ASSERT_EQ(nightly_run(store, {"--out", pages}).exit_code, 0);
  const std::string of_nobody = ".part-2147483647-0123456789abcdef";  // No process has this number.
  std::vector<fs::path> parts;
  for (const fs::path& written :
       {store / "nightly_runs/0001/nightly_run.json", store / "nightly_runs/0001/small/study.json",
        pages / "index.html", pages / "trends/small/report.html",
        pages / "compare/0001-0002/small.html"}) {
    parts.push_back(written.string() + of_nobody);
    fs::create_directories(written.parent_path());
    write_file(parts.back(), "half");
  }
  const fs::path of_a_user = pages / ("mine/notes.txt" + of_nobody);
  fs::create_directories(of_a_user.parent_path());
  write_file(of_a_user, "mine");
  ASSERT_EQ(nightly_run(store, {"--out", pages}).exit_code, 0);
  for (const fs::path& part : parts) EXPECT_FALSE(fs::exists(part)) << part;
  EXPECT_TRUE(fs::exists(of_a_user)) << "no folder that the program writes";
}

TEST(Nightly, LeavesAFileThatSaysWhatItIs) {
  const TemporaryFolder folder;
  const Outcome outcome = nightly_run(folder / "h");
  ASSERT_EQ(outcome.exit_code, 0) << outcome.error;
  const json file = json::parse(read_file(folder / "h/nightly_runs/0001/nightly_run.json"));
  EXPECT_EQ(schema_problem("nightly_run", file), "");
  EXPECT_EQ(file["schema"].dump(), R"({"name":"mapproof.nightly_run","version":1})");
  EXPECT_FALSE(file["provenance"]["version"].get<std::string>().empty());
  json printed = json::parse(outcome.out);
  EXPECT_EQ(printed["schema"]["name"], "mapproof.result.nightly");
  for (const auto& [key, value] : file.items())
    EXPECT_TRUE(key == "schema" || printed[key] == value) << key;
  const json exported = json::parse(mapproof({"history", folder / "h", "--export", "json"}).out);
  EXPECT_EQ(schema_problem("history", exported), "");
}

TEST(Nightly, OfARangeOnlyExperimentIsRecordedToo) {
  const TemporaryFolder folder;
  const Outcome outcome =
      mapproof({"nightly", "boots2013", "--profile", "quick", "--store", folder / "h", "--json"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.error;
  const json nightly_runs = history(folder / "h").at("nightly_runs");
  ASSERT_EQ(nightly_runs.size(), 1U);
  const Outcome csv = mapproof({"history", folder / "h", "--export", "csv"});
  EXPECT_NE(csv.out.find("path_mean_m"), std::string::npos);
}

TEST(Nightly, RefusesANightlyRunToCompareWithThatIsNotThereBeforeAnyWork) {
  const TemporaryFolder folder;
  const Outcome outcome = nightly_run(folder / "h", {"--reference", "7"});
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_NE(outcome.error.find("7"), std::string::npos) << outcome.error;
  EXPECT_FALSE(fs::exists(folder / "h/nightly_runs/0001/small"));
}

TEST(Nightly, RefusesAStoreWhoseLastNumberIsTaken) {
  const TemporaryFolder folder;
  fs::create_directories(folder / "h/nightly_runs/2147483647");
  write_file(folder / "h/nightly_runs/2147483647/nightly_run.json", "{}");
  write_file(folder / "h/history.sqlite.damaged-1", "its history, set aside");
  const Outcome outcome = nightly_run(folder / "h");
  EXPECT_EQ(outcome.exit_code, 2) << outcome.error;
  EXPECT_EQ(lines_with(outcome.error, "no number is left after nightly run 2147483647"), 1U)
      << outcome.error;
  EXPECT_FALSE(fs::exists(folder / "h/nightly_runs/0001"));
}

/// small.json with another seed, under the same name.
std::string of_another_seed(const TemporaryFolder& folder) {
  std::string other = read_file(kSmall);
  const std::size_t seed = other.find("\"seed\": ");
  EXPECT_NE(seed, std::string::npos);
  other.insert(seed + 8, "1");
  return folder.file("small.json", other);
}

TEST(Nightly, RefusesANightlyRunToCompareWithThatMadeSomethingElseBeforeAnyWork) {
  const TemporaryFolder folder;
  const fs::path store = folder / "history";
  ASSERT_EQ(nightly_run(store).exit_code, 0);
  const Outcome outcome = nightly_run(store, {"--reference", "1"}, of_another_seed(folder));
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_EQ(lines_with(outcome.error, "--reference: nightly run 1"), 1U) << outcome.error;
  EXPECT_FALSE(fs::exists(store / "nightly_runs/0002"));
  EXPECT_EQ(nightly_run(store, {"--reference", "1"}).exit_code, 0)
      << "the same experiment can be compared";
}

TEST(Nightly, ThatHasNoNightlyRunToCompareWithIsNotCalledGood) {
  const TemporaryFolder folder;
  const fs::path store = folder / "history";
  ASSERT_EQ(nightly_run(store).exit_code, 0);
  const Outcome outcome = nightly_run(store, {}, of_another_seed(folder));
  EXPECT_EQ(outcome.exit_code, 0) << outcome.error;
  const json reported = json::parse(outcome.out);
  EXPECT_TRUE(reported.at("reference").is_null());
  EXPECT_EQ(reported.at("verdict"), "not compared");
  EXPECT_NE(reported.at("remarks").dump().find("no nightly run to compare with"),
            std::string::npos);
  EXPECT_EQ(lines_with(mapproof({"history", store}).out, "not compared"), 2U);
  const std::string index = read_file(store / "index.html");
  EXPECT_EQ(index.find("Nothing got worse"), std::string::npos);
  EXPECT_NE(index.find(">not compared<"), std::string::npos);
  for (const char* page : {"trends/small/report.html", "nightly_runs/0002/small/report.html"})
    EXPECT_NE(read_file(store / page).find("Nightly run 2: not compared"), std::string::npos)
        << page;
}

TEST(Nightly, AfterPruningTheIndexNamesTheNightlyRunsThatAreLeft) {
  const TemporaryFolder folder;
  const fs::path store = folder / "history";
  for (int i = 0; i < 3; ++i) ASSERT_EQ(nightly_run(store).exit_code, 0);
  EXPECT_NE(read_file(store / "index.html").find("nightly_runs/0001/small/report.html"),
            std::string::npos);
  ASSERT_EQ(mapproof({"history", store, "--prune", "last=1"}).exit_code, 0);
  const std::string index = read_file(store / "index.html");
  for (int number = 1; number <= 3; ++number) {
    const std::string report = "nightly_runs/000" + std::to_string(number) + "/small/report.html";
    EXPECT_EQ(index.find(report) != std::string::npos, fs::exists(store / report)) << report;
  }
}

TEST(Nightly, OnAFullDiskSaysSoAndLosesNoNightlyRun) {
  const TemporaryFolder folder;
  const fs::path store = folder / "history";
  ASSERT_EQ(nightly_run(store).exit_code, 0);
  const std::string before = mapproof({"history", store, "--export", "csv"}).out;
  for (const std::size_t bytes : {2'000U, 20'000U, 60'000U}) {
    const Outcome outcome = nightly_run(store, {}, kSmall, Limits{.file_bytes = bytes});
    EXPECT_TRUE(outcome.exit_code == 2 || outcome.exit_code == 3)
        << bytes << ": " << outcome.exit_code << outcome.error;
    EXPECT_FALSE(outcome.error.empty());
    EXPECT_TRUE(mapproof({"history", store, "--export", "csv"}).out == before) << bytes;
  }
  EXPECT_EQ(nightly_run(store).exit_code, 0) << "goes on once there is room";
}

TEST(Nightly, WithNoRoomForTheCommitNamesTheStoreInOneLineAndLosesNoNightlyRun) {
  const TemporaryFolder folder;
  const fs::path store = folder / "history";
  ASSERT_EQ(nightly_run(store).exit_code, 0);
  // A history larger than any other file of a nightly run: what the limit stops is its commit
  // alone.
  change(store, "CREATE TABLE padding (x); INSERT INTO padding VALUES (zeroblob(8000000))");
  const std::string before = mapproof({"history", store, "--export", "csv"}).out;
  const std::size_t bytes = fs::file_size(store / "history.sqlite");
  for (const std::size_t more : {0U, 4'096U}) {
    const Outcome outcome = nightly_run(store, {}, kSmall, Limits{.file_bytes = bytes + more});
    EXPECT_EQ(outcome.exit_code, 2) << more << outcome.error;
    EXPECT_EQ(lines_with(outcome.error, "history.sqlite: cannot be written"), 1U) << outcome.error;
    EXPECT_TRUE(mapproof({"history", store, "--export", "csv"}).out == before) << more;
    EXPECT_EQ(mapproof({"history", store, "--verify"}).exit_code, 0) << more;
  }
  EXPECT_EQ(nightly_run(store).exit_code, 0) << "goes on once there is room";
  EXPECT_EQ(history(store).at("nightly_runs").size(), 2U);
}

/// A nightly run whose history lies on a disk of its own with `free_kib` left, a mount of a
/// namespace of its own; afterwards one with room. The history is put back into the store.
Outcome nightly_on_a_small_disk(const fs::path& store, const fs::path& disk, int free_kib) {
  const std::string used =
      std::to_string((fs::file_size(store / "history.sqlite") + 4095) / 4096 * 4 + free_kib);
  const std::string script =
      "mount -t tmpfs -o size=" + used +
      "k tmpfs \"$1\" || exit 77\n"
      "cp \"$0/history.sqlite\" \"$1\" || exit 76\n"
      "mount --bind \"$1/history.sqlite\" \"$0/history.sqlite\" || exit 76\n"
      "disk=$1; shift; \"$@\"; code=$?\n"
      "umount \"$0/history.sqlite\" || exit 76\n"
      "cp \"$disk/history.sqlite\" \"$0/back\" && mv \"$0/back\" \"$0/history.sqlite\" || exit 76\n"
      "exit $code\n";
  return run_program({"unshare", "-Urm", "sh", "-c", script, store, disk, program(), "nightly",
                      kSmall, "--profile", "tiny", "--store", store, "--jobs", "1"});
}

bool may_mount() {
  return run_program({"unshare", "-Urm", "mount", "-t", "tmpfs", "tmpfs", "/mnt"}).exit_code == 0;
}

TEST(Nightly, OnADiskThatIsFullAtTheCommitNamesTheStoreInOneLineAndLosesNoNightlyRun) {
  if (!may_mount()) GTEST_SKIP() << "no mounts of one's own here";
  const TemporaryFolder folder;
  const fs::path store = folder / "history";
  fs::create_directory(folder / "disk");
  ASSERT_EQ(nightly_run(store).exit_code, 0);
  const std::string before = mapproof({"history", store, "--export", "csv"}).out;
  for (const int free_kib : {0, 8}) {
    const Outcome outcome = nightly_on_a_small_disk(store, folder / "disk", free_kib);
    EXPECT_EQ(outcome.exit_code, 2) << free_kib << outcome.error;
    EXPECT_EQ(lines_with(outcome.error, "history.sqlite: cannot be written: the disk is full"), 1U)
        << free_kib << outcome.error;
    EXPECT_TRUE(mapproof({"history", store, "--export", "csv"}).out == before) << free_kib;
    EXPECT_EQ(mapproof({"history", store, "--verify"}).exit_code, 0) << free_kib;
  }
  EXPECT_EQ(nightly_run(store).exit_code, 0) << "goes on once there is room";
  EXPECT_EQ(history(store).at("nightly_runs").size(), 2U);
}

TEST(Nightly, RefusesADamagedHistoryUntilAPersonSetsItAside) {
  const TemporaryFolder folder;
  const fs::path store = folder / "history", file = store / "history.sqlite";
  ASSERT_EQ(nightly_run(store).exit_code, 0);
  std::string bytes = read_file(file);
  bytes.resize(bytes.size() - 10'000);
  for (const std::string& damaged : {std::string(), std::string(40'000, 'x'), bytes}) {
    write_file(file, damaged);
    const auto before = contents(store);
    for (const Outcome& outcome :
         {mapproof({"history", store}), nightly_run(store), nightly_run(store)}) {
      EXPECT_EQ(outcome.exit_code, 2) << outcome.out;
      EXPECT_EQ(lines_with(outcome.error, "mapproof: "), 1U) << outcome.error;
      EXPECT_EQ(lines_with(outcome.error, "history.sqlite: is damaged: "), 1U) << outcome.error;
    }
    EXPECT_EQ(contents(store), before) << damaged.size();
  }
  fs::rename(file, store / "history.sqlite.damaged-1");
  const Outcome outcome = nightly_run(store);
  EXPECT_EQ(outcome.exit_code, 0) << outcome.error;
  EXPECT_EQ(history(store).at("nightly_runs").at(0).at("nightly_run"), 2)
      << "nightly run 1 keeps its folder";
  for (const char* page : {"index.html", "nightly_runs/0002/small/report.html"}) {
    const std::string reported = read_file(store / page);
    EXPECT_NE(reported.find("history.sqlite.damaged-1"), std::string::npos) << page;
    EXPECT_NE(reported.find("nightly_runs/0001/small/report.html"), std::string::npos) << page;
  }
}

/// A record of its schema says that it is larger than memory, which SQLite calls out of memory.
TEST(Nightly, NamesAHistoryThatSqliteHasNoMemoryFor) {
  const TemporaryFolder folder;
  const fs::path store = folder / "history", file = store / "history.sqlite";
  ASSERT_EQ(nightly_run(store).exit_code, 0);
  fs::copy_file(fs::path(MAPPROOF_TEST_DATA) / "../fuzz/corpus/history/record-beyond-memory", file,
                fs::copy_options::overwrite_existing);
  const auto before = contents(store);
  for (const Outcome& outcome : {mapproof({"history", store}), nightly_run(store)}) {
    EXPECT_EQ(outcome.exit_code, 3) << outcome.out;
    EXPECT_EQ(outcome.error, "mapproof: out of memory: " + file.string() +
                                 "; SQLite says so of some damaged files, too\n");
  }
  EXPECT_EQ(contents(store), before);
}

TEST(Nightly, KilledAtAnyTimeLosesNoFinishedNightlyRun) {
  const TemporaryFolder folder;
  const fs::path store = folder / "history";
  ASSERT_EQ(nightly_run(store).exit_code, 0);
  for (const int milliseconds : {20, 90, 200, 450, 900}) {
    const pid_t child =
        start_mapproof({"nightly", kSmall, "--profile", "tiny", "--store", store, "--jobs", "1"});
    std::this_thread::sleep_for(std::chrono::milliseconds(milliseconds));
    ::kill(child, SIGKILL);
    int status = 0;
    ::waitpid(child, &status, 0);
    EXPECT_GE(history(store).at("nightly_runs").size(), 1U) << milliseconds;
  }
  const std::size_t before = history(store).at("nightly_runs").size();
  ASSERT_EQ(nightly_run(store).exit_code, 0);
  EXPECT_EQ(history(store).at("nightly_runs").size(), before + 1);
  EXPECT_EQ(mapproof({"history", store, "--verify"}).exit_code, 0);
}

TEST(Nightly, TwoAtOnceAreBothRecorded) {
  const TemporaryFolder folder;
  const fs::path store = folder / "history";
  const pid_t other =
      start_mapproof({"nightly", kSmall, "--profile", "tiny", "--store", store, "--jobs", "1"});
  const Outcome outcome = nightly_run(store);
  int status = 0;
  ::waitpid(other, &status, 0);
  EXPECT_EQ(outcome.exit_code, 0) << outcome.error;
  EXPECT_TRUE(WIFEXITED(status) && WEXITSTATUS(status) == 0);
  EXPECT_EQ(history(store).at("nightly_runs").size(), 2U);
}

TEST(Nightly, AWorseNightlyRunIsOneAndNamesWhatGotWorse) {
  const TemporaryFolder folder;
  const fs::path store = folder / "history";
  std::string text = read_file(kSmall);
  text.replace(text.find("\"layouts\": 2"), 12, "\"layouts\": 8");
  write_file(folder / "more.json", text);
  const auto this_run = [&] {
    return mapproof({"nightly", folder / "more.json", "--store", store, "--json"});
  };
  ASSERT_EQ(this_run().exit_code, 0);
  make_better(store, 0.9);
  const Outcome outcome = this_run();
  EXPECT_EQ(outcome.exit_code, 1) << outcome.out << outcome.error;
  const json result = json::parse(outcome.out);
  ASSERT_FALSE(result.at("findings").empty());
  EXPECT_EQ(result.at("findings").at(0).at("quantity"), "mpe_m");
  const std::string report = read_file(store / "nightly_runs/0002/small/report.html");
  EXPECT_NE(report.find("class=\"standing worse\""), std::string::npos);
}

}  // namespace
}  // namespace mapproof::test
