// The program in environments that its author did not have.
#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "core/base/files/files.hpp"
#include "tests/support/environment.hpp"
#include "tests/support/program.hpp"

namespace mapproof::test {
namespace {

namespace fs = std::filesystem;

const std::string kObservations =
    std::string(MAPPROOF_TEST_DATA) + "/observations/wide_semicolon.csv";

std::vector<std::string> map_into(const fs::path& out) {
  return {"map", kObservations, "--sensor", "bearing", "--out", out};
}

/// The program behind words of a shell: "$0" is the program, "$1" the folder to write to.
Outcome in_shell(const std::string& words, const fs::path& out) {
  const std::string map = "\"$0\" map " + kObservations + " --sensor bearing --out \"$1\"";
  std::string script = words;
  script.replace(script.find("MAP"), 3, map);
  return run_program({"timeout", "60", "bash", "-c", script, program(), out.string()});
}

/// The files of a map, without the name of the test's folder in their bytes.
Contents map_in(const TemporaryFolder& folder) {
  Contents files = contents(folder / "out");
  for (auto& [name, bytes] : files)
    for (std::size_t at = 0; (at = bytes.find(folder.path(), at)) != std::string::npos;)
      bytes.replace(at, folder.path().string().size(), "FOLDER");
  return files;
}

/// What a map is in a usual environment.
const Contents& usual_map() {
  static const TemporaryFolder folder;
  static const Contents files = [] {
    EXPECT_EQ(mapproof(map_into(folder / "out")).exit_code, 0);
    return map_in(folder);
  }();
  return files;
}

/// Those that begin with the program's name: errors, not warnings.
long lines_of_program(const Outcome& outcome) {
  long count = 0;
  for (std::size_t at = 0; at != std::string::npos; at = outcome.error.find('\n', at + 1))
    count += outcome.error.compare(at == 0 ? 0 : at + 1, 10, "mapproof: ") == 0 ? 1 : 0;
  return count;
}

TEST(Environment, OfAnyLanguageTimeZoneAndHomeChangesNoByte) {
  const std::vector<std::pair<const char*, const char*>> strange = {{"LC_ALL", "de_DE.UTF-8"},
                                                                    {"LC_ALL", "tr_TR.UTF-8"},
                                                                    {"LC_ALL", "nowhere"},
                                                                    {"LC_ALL", "C"},
                                                                    {"LANG", ""},
                                                                    {"TZ", "Pacific/Chatham"},
                                                                    {"TZ", ":/dev/null"},
                                                                    {"HOME", nullptr},
                                                                    {"HOME", "/nonexistent"},
                                                                    {"TMPDIR", "/nonexistent"},
                                                                    {"XDG_CACHE_HOME", "/dev/null"},
                                                                    {"PATH", ""},
                                                                    {"COLUMNS", "0"},
                                                                    {"TERM", nullptr},
                                                                    {"OMP_NUM_THREADS", "-1"},
                                                                    {"SOURCE_DATE_EPOCH", "x"}};
  for (const auto& [name, value] : strange) {
    SCOPED_TRACE(std::string(name) + "=" + (value == nullptr ? "" : value));
    const TemporaryFolder folder;
    const std::string program_path = program();
    Outcome outcome;
    {
      const Environment environment({{name, value}});
      std::vector<std::string> command = {program_path};
      for (const std::string& word : map_into(folder / "out")) command.push_back(word);
      outcome = run_program(command);
    }
    EXPECT_EQ(outcome.exit_code, 0) << outcome.error;
    expect_same(usual_map(), map_in(folder));
  }
}

TEST(Environment, WithClosedStreamsWritesNothingIntoItsOwnFiles) {
  // A file that is opened takes the number of a stream that is closed.
  for (const char* closed : {"<&-", ">&-", "2>&-", "<&- >&-", "<&- >&- 2>&-", ">&- 2>&-"}) {
    SCOPED_TRACE(closed);
    const TemporaryFolder folder;
    const Outcome outcome = in_shell(std::string("MAP ") + closed, folder / "out");
    EXPECT_TRUE(outcome.exit_code == 0 || outcome.exit_code == 2 || outcome.exit_code == 3)
        << outcome.exit_code << outcome.error;
    if (outcome.exit_code == 0) expect_same(usual_map(), map_in(folder));
  }
}

TEST(Environment, WithClosedOutputLosesNoResultWithoutAWord) {
  for (const char* words : {"--version", "methods --json"}) {
    SCOPED_TRACE(words);
    const Outcome outcome =
        run_program({"bash", "-c", std::string("\"$0\" ") + words + " >&-", program()});
    EXPECT_EQ(outcome.exit_code, 2);
    EXPECT_EQ(outcome.error, "mapproof: standard output: cannot be written\n");
  }
}

TEST(Environment, WhereNobodyReadsTheOutputEndsWithoutACrash) {
  for (const char* words : {"MAP | true; exit ${PIPESTATUS[0]}", "MAP --json > /dev/full",
                            "\"$0\" --help > /dev/full; MAP"}) {
    SCOPED_TRACE(words);
    const TemporaryFolder folder;
    const Outcome outcome = in_shell(words, folder / "out");
    constexpr int kEndedByPipe = 128 + SIGPIPE;
    EXPECT_TRUE((outcome.exit_code >= 0 && outcome.exit_code < 4) ||
                outcome.exit_code == kEndedByPipe)
        << outcome.exit_code << outcome.error;
    // What was understood, a warning, the failure.
    EXPECT_LE(std::ranges::count(outcome.error, '\n'), 3) << outcome.error;
  }
}

TEST(Environment, WithLimitsGivesTheSameMapOrOneLine) {
  skip_if_sanitized();
  // Of files, processes and threads, the stack, seconds of the processor, and core files.
  for (const char* limit : {"ulimit -n 8", "ulimit -n 16", "ulimit -u 1", "ulimit -s 512",
                            "ulimit -c 0", "ulimit -l 0", "ulimit -f 0", "ulimit -v 250000"}) {
    SCOPED_TRACE(limit);
    const TemporaryFolder folder;
    const Outcome outcome = in_shell(std::string(limit) + "; MAP", folder / "out");
    EXPECT_TRUE(outcome.exit_code == 0 || outcome.exit_code == 2 || outcome.exit_code == 3)
        << outcome.exit_code << outcome.error;
    if (outcome.exit_code == 0) {
      expect_same(usual_map(), map_in(folder));
    } else {
      EXPECT_NE(outcome.error.find("mapproof: "), std::string::npos) << outcome.error;
    }
  }
}

TEST(Environment, WithAStackThatIsTooSmallEndsInOneLine) {
  skip_if_sanitized();
  for (const char* limit : {"ulimit -s 64", "ulimit -s 256"}) {
    SCOPED_TRACE(limit);
    const TemporaryFolder folder;
    const Outcome outcome = in_shell(std::string(limit) + "; MAP", folder / "out");
    EXPECT_EQ(outcome.exit_code, 2);
    EXPECT_EQ(lines_of_program(outcome), 1) << outcome.error;
    EXPECT_NE(outcome.error.find("KiB (ulimit -s) is too small: 512 are needed\n"),
              std::string::npos)
        << outcome.error;
  }
  // A limit that the program may raise itself is none.
  const TemporaryFolder folder;
  const Outcome outcome = in_shell("ulimit -S -s 64; MAP", folder / "out");
  EXPECT_EQ(outcome.exit_code, 0) << outcome.error;
  expect_same(usual_map(), map_in(folder));
}

TEST(Environment, UmaskDeterminesTheModesAndNoByte) {
  for (const auto& [mask, mode] : {std::pair("077", 0600U), {"022", 0644U}, {"000", 0666U}}) {
    SCOPED_TRACE(mask);
    const TemporaryFolder folder;
    const Outcome outcome = in_shell(std::string("umask ") + mask + "; MAP", folder / "out");
    EXPECT_EQ(outcome.exit_code, 0) << outcome.error;
    expect_same(usual_map(), map_in(folder));
    for (const auto& entry : fs::recursive_directory_iterator(folder / "out")) {
      struct stat facts {};
      ASSERT_EQ(::stat(entry.path().c_str(), &facts), 0);
      if (entry.is_regular_file()) {
        EXPECT_EQ(facts.st_mode & 0777U, mode & 0644U) << entry.path();
      }
    }
  }
}

TEST(Environment, AFolderThatIsReadOnlyIsNamedInOneLine) {
  const TemporaryFolder folder;
  for (const std::string out : {"/proc/out", "/sys/out", "/dev/null/out"}) {
    const Outcome outcome = mapproof(map_into(out));
    EXPECT_EQ(outcome.exit_code, 2) << outcome.error;
    EXPECT_NE(outcome.error.find(out.substr(0, 5)), std::string::npos) << outcome.error;
    EXPECT_EQ(lines_of_program(outcome), 1) << outcome.error;
  }
}

TEST(Environment, AFolderThatIsGoneIsNoCrash) {
  const TemporaryFolder folder;
  fs::create_directory(folder / "gone");
  const std::string script = "cd \"$1/gone\" && rmdir \"$1/gone\" && \"$0\" map " + kObservations +
                             " --sensor bearing --out out";
  const Outcome outcome = run_program({"bash", "-c", script, program(), folder.path().string()});
  EXPECT_EQ(outcome.exit_code, 2) << outcome.error;
  EXPECT_EQ(lines_of_program(outcome), 1) << outcome.error;
}

TEST(Arguments, OfAnyKindAreRefusedInOneShortLine) {
  const std::string longest(100'000, 'a');
  const std::vector<std::vector<std::string>> hostile = {
      {""},
      {"map", ""},
      {"map", longest},
      {longest},
      {"map", kObservations, "--sensor", longest},
      {"map", kObservations, "--out", longest, "--sensor", "bearing"},
      {"map", kObservations, "--sensor", "bearing", "--out",
       std::string("a\nb\x1b[2J/\xff") + longest},
      {"report", "\xff\xfe"},
      {"validate", "/dev/zero"},
      {"validate", "/dev/urandom"},
      {"validate", "/proc/self/mem"},
      {"diff", "/", "/proc"},
      {"diff", kObservations, "/dev/stdin"},
      {"run", "/dev/null", "--out", "/dev/null"},
      {"render", "/etc", "--width", "1e999"},
      {"nightly", "sweep", "--store", "/dev/null", "--profile", "\x7f"},
      {"history", "/dev/null"},
      {"run", "sweep", "--out", "/dev/null", "--layouts", "99999999999999999999"},
      {"run", "sweep", "--out", "/dev/null", "--seed", "-1"}};
  for (const std::vector<std::string>& arguments : hostile) {
    SCOPED_TRACE(testing::PrintToString(arguments).substr(0, 200));
    std::vector<std::string> command = {"timeout", "60", program()};
    command.insert(command.end(), arguments.begin(), arguments.end());
    const Outcome outcome = run_program(command);
    EXPECT_TRUE(outcome.exit_code == 1 || outcome.exit_code == 2) << outcome.exit_code;
    EXPECT_LE(std::ranges::count(outcome.error + outcome.out, '\n'), 3)
        << (outcome.error + outcome.out).substr(0, 2000);
    EXPECT_LT((outcome.error + outcome.out).size(), 4000U);
    EXPECT_EQ(outcome.error.find('\x1b'), std::string::npos);
  }
}

}  // namespace
}  // namespace mapproof::test
