#include "tests/app/memory_faults.hpp"

#include <algorithm>
#include <map>
#include <sstream>

#include <gtest/gtest.h>

#include "core/base/files/files.hpp"
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

std::vector<std::string> with(std::vector<std::string> words,
                              const std::vector<std::string>& more) {
  words.insert(words.end(), more.begin(), more.end());
  return words;
}

/// One case in its own folder.
struct Trial {
  TemporaryFolder folder;
  const MemoryCase& tried;
  std::string cores;

  Trial(const MemoryCase& one, std::string on) : tried(one), cores(std::move(on)) {
    tried.prepare(folder.path());
  }
  Outcome run() const {
    const std::vector<std::string> command = {"taskset", "-c", cores, program()};
    return run_program(with(command, tried.command(folder.path())));
  }
  /// The files, without the name of the folder in their bytes.
  Files files() const {
    Files files = files_below(folder.path());
    for (auto& [name, bytes] : files)
      for (std::size_t at = 0; (at = bytes.find(folder.path(), at)) != std::string::npos;)
        bytes.replace(at, folder.path().string().size(), "FOLDER");
    return files;
  }
};

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

void fail_at(const MemoryCase& tried, const std::string& cores, long call, const Files& whole) {
  SCOPED_TRACE(tried.name + " on cores " + cores + ", allocation " + std::to_string(call));
  const Trial trial(tried, cores);
  const Files before = trial.files();
  {
    const Faults faults(at_call("alloc", call));
    const Outcome outcome = trial.run();
    if (outcome.exit_code == tried.exit_code) {
      EXPECT_EQ(lines_of_program(outcome.error), 0) << outcome.error;
      EXPECT_TRUE(trial.files() == whole) << "ended as ever, with other files";
      return;
    }
    EXPECT_EQ(outcome.exit_code, 3) << outcome.error;
    EXPECT_EQ(lines_of_program(outcome.error), 1) << outcome.error;
    EXPECT_NE(outcome.error.find("out of memory"), std::string::npos) << outcome.error;
    Files found = trial.files();
    // Where the program that draws scenes has no memory, the rest is made, and the report lacks the
    // scenes.
    if (outcome.error.find("mapproof: scenes cannot be drawn") != std::string::npos)
      std::erase_if(found, [](const auto& file) { return file.first.ends_with("report.html"); });
    expect_whole(found, before, whole);
  }
  EXPECT_EQ(trial.run().exit_code, tried.exit_code);
  EXPECT_TRUE(trial.files() == whole) << "the next run's files differ";
}

}  // namespace

const std::vector<MemoryCase>& memory_cases() {
  static const std::vector<MemoryCase> cases = {
      {"diff", make_two_studies,
       [](const std::string& folder) {
         return std::vector<std::string>{
             "diff",   folder + "/before",   folder + "/after", "--page", folder + "/diff.html",
             "--junit", folder + "/diff.xml"};
       },
       1},
      {"approve", make_two_studies,
       [](const std::string& folder) {
         return std::vector<std::string>{"approve", folder + "/before", folder + "/after", "--all"};
       }},
      {"report", make_study,
       [](const std::string& folder) {
         return std::vector<std::string>{"report", folder + "/study"};
       }},
      {"map", make_observations,
       [](const std::string& folder) {
         return std::vector<std::string>{"map",      folder + "/observations.csv",
                                         "--sensor", "visibility",
                                         "--out",    folder + "/out"};
       }},
  };
  return cases;
}

void expect_memory_faults_reported(const MemoryCase& tried, long at_most) {
  for (const std::string cores : {"0", "0,1"}) {
    const Trial clean(tried, cores);
    long calls = 0;
    {
      const Faults none("");
      const Outcome outcome = clean.run();
      ASSERT_EQ(outcome.exit_code, tried.exit_code) << outcome.error;
      calls = none.calls("alloc");
    }
    EXPECT_GT(calls, 10) << tried.name;
    const Files whole = clean.files();
    const long tries = std::min(calls, at_most);
    for (long i = 0; i < tries; ++i) fail_at(tried, cores, 1 + i * calls / tries, whole);
  }
}

}  // namespace mapproof::test
