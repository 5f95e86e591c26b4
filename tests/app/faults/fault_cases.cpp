#include "tests/app/faults/fault_cases.hpp"

#include <sys/wait.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <csignal>
#include <map>
#include <sstream>
#include <thread>

#include <gtest/gtest.h>

#include "core/base/files/files.hpp"
#include "core/base/random.hpp"
#include "core/records/studies/folder_lock.hpp"
#include "core/studies/study_kind.hpp"
#include "tests/app/range_logs.hpp"
#include "tests/app/two_studies.hpp"
#include "tests/support/faults.hpp"
#include "tests/support/program.hpp"

namespace mapproof::test {
namespace {

using Files = std::map<std::string, std::string>;

Files files_below(const fs::path& folder) {
  const Contents all = contents(folder);
  return {all.begin(), all.end()};
}

/// Two studies with different scores, and images of which one is changed.
void make_two_studies(const fs::path& folder) {
  for (const char* side : {"before", "after"}) {
    fs::copy(kStudy, folder / side, fs::copy_options::recursive);
    for (const char* image : {"curve-usual", "map-usual"})
      for (const char* extension : {".png", ".figure.json"})
        write_file(folder / side / "figures" / (std::string(image) + extension),
                   read_file(fs::path(kImages) / (std::string(image) + extension)));
    write_file(folder / side / "figures/drawing.svg",
               "<svg xmlns=\"http://www.w3.org/2000/svg\"><path d=\"" +
                   std::string(std::string(side) == "after" ? "M0 0" : "M1 0") +
                   std::string(100'000, ' ') + "\"/></svg>");
  }
  fs::copy_file(fs::path(kImages) / "curve-log.png", folder / "after/figures/map-usual.png",
                fs::copy_options::overwrite_existing);
  replace_in(folder / "after/runs/layout-1-pose-1.json", "\"mpe_m\": 0.", "\"mpe_m\": 0.9");
  write_results_table(folder / "after");
}

void make_study(const fs::path& folder) {
  fs::copy(kStudy, folder / "study", fs::copy_options::recursive);
}

/// Detections of 30 landmarks over so many steps that no buffer is small.
void make_observations(const fs::path& folder) {
  std::ostringstream text;
  constexpr int kSteps = 1500, kLandmarks = 30;
  for (int i = 0; i < kLandmarks; ++i) text << (i > 0 ? "," : "") << "L" << i;
  for (int step = 0; step < kSteps; ++step)
    for (int i = 0; i < kLandmarks; ++i)
      text << (i > 0 ? "," : "\n") << ((step * 7 + i * i * 13 + step * i) % 17 < 8 ? 1 : 0);
  write_file(folder / "observations.csv", text.str() + "\n");
}

const std::string kSmall = std::string(MAPPROOF_TEST_DATA) + "/experiments/small.json";

std::vector<std::string> with(std::vector<std::string> words,
                              const std::vector<std::string>& more) {
  words.insert(words.end(), more.begin(), more.end());
  return words;
}

/// The number of nightly runs in the store; -1 if its history is not whole.
long nightly_runs_in(const fs::path& store) {
  if (mapproof({"history", store, "--verify"}).exit_code != 0) return -1;
  const Outcome outcome = mapproof({"history", store, "--export", "csv"});
  return outcome.exit_code == 0 ? std::ranges::count(outcome.out, '\n') : -1;
}

/// The case's input, made once.
const fs::path& prepared(const FaultCase& tried) {
  static std::map<std::string, TemporaryFolder> folders;
  const bool is_new = !folders.contains(tried.name);
  const TemporaryFolder& folder = folders[tried.name];
  if (is_new) tried.prepare(folder.path());
  return folder.path();
}

/// One case in its own folder.
struct Attempt {
  TemporaryFolder folder;
  const FaultCase& tried;
  std::string cores;

  Attempt(const FaultCase& one, std::string on) : tried(one), cores(std::move(on)) {
    fs::copy(prepared(tried), folder.path(), fs::copy_options::recursive);
  }
  std::vector<std::string> command() const {
    return with({"taskset", "-c", cores, program()}, tried.command(folder.path()));
  }
  Outcome run() const { return run_program(command()); }
  /// The files, without the name of the folder in their bytes; of those that vary the names alone,
  /// without their numbers.
  Files files() const {
    Files files;
    for (auto& [name, bytes] : files_below(folder.path())) {
      if (tried.varies(name)) {
        std::string unnumbered = name;
        std::ranges::replace_if(
            unnumbered, [](char c) { return c >= '0' && c <= '9'; }, '#');
        files[unnumbered] = bytes.empty() ? "empty" : "varies";
        continue;
      }
      std::string& named = files[name] = bytes;
      for (std::size_t at = 0; (at = named.find(folder.path(), at)) != std::string::npos;)
        named.replace(at, folder.path().string().size(), "FOLDER");
    }
    return files;
  }
};

/// What the case leaves without a fault, and how many calls of each kind it makes.
struct WholeRun {
  Files files;
  std::map<std::string, long> calls;
};

/// Made once.
const WholeRun& whole_run(const FaultCase& tried, const std::string& cores) {
  static std::map<std::string, WholeRun> runs;
  const auto [run, is_new] = runs.try_emplace(tried.name + cores);
  if (is_new) {
    const Attempt clean(tried, cores);
    const Faults none("");
    const Outcome outcome = clean.run();
    EXPECT_EQ(outcome.exit_code, tried.exit_code) << tried.name << ": " << outcome.error;
    for (const std::string& kind : kFaultKinds) run->second.calls[kind] = none.calls(kind);
    run->second.files = clean.files();
  }
  return run->second;
}

long lines_of_program(const std::string& text) {
  std::istringstream lines(text);
  long count = 0;
  for (std::string line; std::getline(lines, line);)
    count += line.starts_with("mapproof: ") ? 1 : 0;
  return count;
}

/// Each file after a failed run is that of before the run or that of a whole run.
void expect_whole(const Files& found, const Files& before, const Files& whole) {
  for (const auto& [name, bytes] : found) {
    const auto old_one = before.find(name), new_one = whole.find(name);
    EXPECT_TRUE((old_one != before.end() && old_one->second == bytes) ||
                (new_one != whole.end() && new_one->second == bytes))
        << name << " of " << bytes.size() << " bytes is neither what it was nor whole";
  }
}

/// Names of files that differ; empty if none.
std::string difference(const Files& a, const Files& b) {
  std::string names;
  for (const auto& [name, bytes] : a)
    if (const auto other = b.find(name); other == b.end() || other->second != bytes)
      names += name + " ";
  for (const auto& [name, bytes] : b)
    if (!a.contains(name)) names += name + " ";
  return names;
}

void expect_next_run_whole(const Attempt& attempt, const Files& whole) {
  const Outcome again = attempt.run();
  EXPECT_EQ(again.exit_code, attempt.tried.exit_code) << again.error;
  EXPECT_EQ(difference(attempt.files(), whole), "") << "the next run's files differ";
  attempt.tried.check(attempt.folder.path());
}

/// One line, and the exit code that goes with it.
void expect_reported(const std::string& kind, const Outcome& outcome) {
  EXPECT_EQ(lines_of_program(outcome.error), 1) << outcome.error;
  EXPECT_TRUE(outcome.exit_code == 2 || outcome.exit_code == 3)
      << outcome.exit_code << ": " << outcome.error;
  if (kind == "alloc" || kind == "mmap") {
    EXPECT_EQ(outcome.exit_code, 3) << outcome.error;
    EXPECT_NE(outcome.error.find("out of memory"), std::string::npos) << outcome.error;
  }
  if (kind == "thread") {
    EXPECT_EQ(outcome.exit_code, 3) << outcome.error;
    EXPECT_NE(outcome.error.find("no further thread can be started"), std::string::npos)
        << outcome.error;
  }
}

/// Removes what the next run removes: parts of files, folders that were to be put in place, and
/// SQLite's journal, by which it takes back what was not finished.
/// @return Whether there were any.
bool erase_leftovers(Files& files) {
  return std::erase_if(files, [](const auto& file) {
           return file.first.find(".part-") != std::string::npos ||
                  file.first.ends_with("-journal") ||
                  file.first.find(".mapproof-") != std::string::npos;
         }) > 0;
}

/// Whether the page of a comparison names what could not be read again for it: an image that is not
/// shown, or a record that cannot be approved.
bool states_what_is_unread(const Files& files) {
  const auto page = files.find("diff.html");
  return page != files.end() &&
         std::ranges::any_of(std::array{"Not shown: ", "not approved: "}, [&](const char* begin) {
           const std::size_t words = page->second.find(begin);
           return words < page->second.find(": cannot be ", words);
         });
}

void fail_at(const FaultCase& tried, const std::string& cores, const std::string& kind, long call,
             const Files& whole) {
  SCOPED_TRACE(tried.name + " on cores " + cores + ", " + kind + " " + std::to_string(call));
  const Attempt attempt(tried, cores);
  const Files before = attempt.files();
  {
    const Faults faults(at_call(kind, call));
    const Outcome outcome = attempt.run();
    Files found = attempt.files();
    if (outcome.exit_code == 1 && outcome.out.find("1 unreadable") != std::string::npos) {
      // A figure that cannot be read does not pass, and is named with the reason.
      EXPECT_TRUE(tried.name == "check" || tried.name == "diff") << outcome.out;
      EXPECT_NE(outcome.out.find("cannot be "), std::string::npos) << outcome.out;
      EXPECT_NE(outcome.out.find("does not pass: "), std::string::npos) << outcome.out;
      // They say so, too.
      for (const char* page : {"check.xml", "diff.xml", "diff.html"}) found.erase(page);
    } else if (outcome.exit_code == tried.exit_code) {
      EXPECT_EQ(lines_of_program(outcome.error), 0) << outcome.error;
      // Where the old folder cannot be removed, the new one is there all the same.
      const bool are_left = tried.name == "approve" && erase_leftovers(found);
      if (states_what_is_unread(found)) {
        found.erase("diff.html");
      } else {
        EXPECT_EQ(difference(found, whole), "") << "ended as ever, with other files";
        if (!are_left) return;
      }
    } else if (outcome.error.find(": not approved: ") != std::string::npos ||
               outcome.error.find(": not written: ") != std::string::npos) {
      EXPECT_EQ(outcome.exit_code, 1) << outcome.error;
    } else {
      expect_reported(kind, outcome);
    }
    // Where the program that draws scenes cannot, the rest is made, and the report lacks the
    // scenes.
    if (outcome.error.find("mapproof: scenes cannot be drawn") != std::string::npos)
      std::erase_if(found, [](const auto& file) { return file.first.ends_with("report.html"); });
    expect_whole(found, before, whole);
  }
  tried.check(attempt.folder.path());
  expect_next_run_whole(attempt, whole);
}

void expect_survived(const Attempt& attempt, const Files& before, const Files& whole) {
  Files found = attempt.files();
  erase_leftovers(found);
  expect_whole(found, before, whole);
  expect_next_run_whole(attempt, whole);
}

// The cases.

bool is_of_seconds(std::string_view file) {
  return file.ends_with("timings.jsonl") || file.ends_with("report.html") ||
         file.find("/tables/") != std::string_view::npos ||
         file.find("/figures/cost-") != std::string_view::npos;
}

FaultCase run_case() {
  return {.name = "run",
          .prepare = [](const fs::path&) {},
          .command =
              [](const std::string& folder) {
                return std::vector<std::string>{"run", kSmall, "--out", folder + "/out"};
              },
          .varies = is_of_seconds};
}

FaultCase merge_case() {
  return {.name = "merge",
          .prepare =
              [](const fs::path& folder) {
                for (const char* shard : {"1/2", "2/2"})
                  mapproof({"run", kSmall, "--profile", "tiny", "--shard", shard, "--out",
                            folder / "shards" / std::string(1, *shard)});
              },
          .command =
              [](const std::string& folder) {
                return std::vector<std::string>{"merge", folder + "/shards/1", folder + "/shards/2",
                                                "--out", folder + "/out"};
              },
          .varies = is_of_seconds,
          .samples = 8};
}

FaultCase reproduce_case() {
  return {.name = "reproduce",
          .prepare = [](const fs::path&) {},
          .command =
              [](const std::string& folder) {
                return std::vector<std::string>{"reproduce", "sweep", "--profile",
                                                "quick",     "--out", folder + "/out"};
              },
          .varies = is_of_seconds,
          .samples = 8};
}

FaultCase check_case() {
  return {.name = "check",
          .prepare =
              [](const fs::path& folder) {
                mapproof({"run", kSmall, "--profile", "tiny", "--out", folder / "baseline"});
                mapproof({"report", folder / "baseline"});
              },
          .command =
              [](const std::string& folder) {
                return std::vector<std::string>{"check",      kSmall,
                                                "--profile",  "tiny",
                                                "--baseline", folder + "/baseline",
                                                "--out",      folder + "/out",
                                                "--junit",    folder + "/check.xml"};
              },
          .varies = is_of_seconds,
          .samples = 8};
}

/// Of a table of results: the nightly run itself then takes the most time.
FaultCase nightly_case() {
  const auto nightly = [](const std::string& folder) {
    return std::vector<std::string>{"nightly", folder + "/mine", "--store", folder + "/store"};
  };
  return {.name = "nightly",
          .prepare =
              [=](const fs::path& folder) {
                write_file(folder / "mine/study.json",
                           R"({"schema": {"name": "mapproof.results_study", "version": 1},)"
                           R"( "title": "Mine"})");
                write_file(folder / "mine/results.csv",
                           "setup,method,quantity,run,value\n"
                           "room,ekf,mpe_m,a,0.5\nroom,ekf,mpe_m,b,0.25\n");
                EXPECT_EQ(mapproof(nightly(folder)).exit_code, 0);
              },
          .command = nightly,
          .varies = [](std::string_view file) { return file.starts_with("store"); },
          .check = [](const fs::path& folder) { EXPECT_GE(nightly_runs_in(folder / "store"), 1); }};
}

FaultCase slam_case() {
  return {.name = "slam",
          .prepare = [](const fs::path& folder) { write_log(drive_log(), folder / "log"); },
          .command =
              [](const std::string& folder) {
                return std::vector<std::string>{"slam", folder + "/log", "--out", folder + "/out"};
              },
          .varies = is_of_seconds,
          .samples = 8};
}

std::vector<FaultCase> make_cases() {
  const auto folder_case = [](const char* name, const std::string& command) {
    return FaultCase{.name = name,
                     .prepare = make_study,
                     .command =
                         [=](const std::string& folder) {
                           return std::vector<std::string>{command, folder + "/study"};
                         },
                     .samples = 8};
  };
  return {
      run_case(),
      merge_case(),
      reproduce_case(),
      folder_case("report", "report"),
      folder_case("render", "render"),
      {.name = "diff",
       .prepare = make_two_studies,
       .command =
           [](const std::string& folder) {
             return std::vector<std::string>{
                 "diff",    folder + "/before",  folder + "/after", "--page", folder + "/diff.html",
                 "--junit", folder + "/diff.xml"};
           },
       .exit_code = 1},
      {.name = "approve",
       .prepare = make_two_studies,
       .command =
           [](const std::string& folder) {
             return std::vector<std::string>{"approve", folder + "/before", folder + "/after",
                                             "--all"};
           }},
      check_case(),
      nightly_case(),
      {.name = "map",
       .prepare = make_observations,
       .command =
           [](const std::string& folder) {
             return std::vector<std::string>{"map",           folder + "/observations.csv",
                                             "--sensor",      "visibility",
                                             "--drop-unseen", "--out",
                                             folder + "/out"};
           }},
      slam_case()};
}

/// Each number from 1 to `calls`, or `at_most` of them at equal distances.
template <typename Try>
void for_each_call(long calls, long at_most, const Try& attempt) {
  const long tries = std::min(calls, at_most);
  for (long i = 0; i < tries; ++i) attempt(1 + i * calls / tries);
}

}  // namespace

const std::vector<FaultCase>& fault_cases() {
  static const std::vector<FaultCase> cases = make_cases();
  return cases;
}

std::vector<FaultCase> kill_cases() {
  std::vector<FaultCase> cases;
  for (const FaultCase& one : fault_cases())
    if (one.name == "run" || one.name == "merge" || one.name == "report" || one.name == "approve" ||
        one.name == "nightly")
      cases.push_back(one);
  return cases;
}

void expect_faults_reported(const FaultCase& tried, const std::string& kind, long at_most,
                            const std::string& cores) {
  const WholeRun& whole = whole_run(tried, cores);
  for_each_call(whole.calls.at(kind), at_most,
                [&](long call) { fail_at(tried, cores, kind, call, whole.files); });
}

void expect_kills_survived(const FaultCase& tried, const std::string& kind, long at_most) {
  const WholeRun& whole = whole_run(tried, "0,1");
  EXPECT_GT(whole.calls.at(kind), 0) << tried.name << " makes no " << kind;
  for_each_call(whole.calls.at(kind), at_most, [&](long call) {
    SCOPED_TRACE(tried.name + ", killed at " + kind + " " + std::to_string(call));
    const Attempt attempt(tried, "0,1");
    const Files before = attempt.files();
    {
      const Faults kill(at_call(kind, call, "kill"));
      const Outcome outcome = attempt.run();
      // The nightly run makes each study in a process of its own; that one may be killed.
      if (outcome.exit_code != -1) {
        EXPECT_EQ(tried.name, "nightly");
        EXPECT_EQ(outcome.exit_code, 3) << outcome.error;
        EXPECT_EQ(lines_of_program(outcome.error), 1) << outcome.error;
      }
    }
    expect_survived(attempt, before, whole.files);
  });
}

void expect_random_kills_survived(const FaultCase& tried, int times, unsigned seed) {
  using Clock = std::chrono::steady_clock;
  const WholeRun& whole = whole_run(tried, "0,1");
  const auto start = Clock::now();
  Attempt(tried, "0,1").run();
  const std::chrono::duration<double> length = Clock::now() - start;
  Random random(seed);
  for (int i = 0; i < times; ++i) {
    const Attempt attempt(tried, "0,1");
    const Files before = attempt.files();
    const std::chrono::duration<double> moment = random.uniform() * length;
    SCOPED_TRACE(tried.name + ", killed after " + std::to_string(moment.count()) + " s");
    const pid_t process = start_mapproof(tried.command(attempt.folder.path()));
    std::this_thread::sleep_for(moment);
    ::kill(process, SIGKILL);
    ::waitpid(process, nullptr, 0);
    expect_survived(attempt, before, whole.files);
  }
}

}  // namespace mapproof::test
