#include <fcntl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "core/base/files/files.hpp"
#include "tests/app/faults/fault_cases.hpp"
#include "tests/app/two_studies.hpp"
#include "tests/support/environment.hpp"
#include "tests/support/program.hpp"

namespace mapproof::test {
namespace {

/// Runs the program in a small address space; exit code 137: it did not end within a minute.
Outcome within(std::size_t kib, std::vector<std::string> arguments) {
  arguments.insert(arguments.begin(), {"timeout", "-s", "KILL", "60", program()});
  return run_program(arguments, {.address_bytes = kib << 10});
}

TEST(LittleMemory, IsEnoughForWhatIsSmall) {
  constexpr std::size_t kLimit = 524'288;  // KiB, as a batch system may set it.
  EXPECT_EQ(within(180'000, {"--version"}).exit_code, 0);
  EXPECT_EQ(within(kLimit, {"--version"}).out, mapproof({"--version"}).out);

  const TemporaryFolder folder;
  const std::string observations = std::string(MAPPROOF_TEST_DATA) + "/observations/wide_plain.csv";
  const auto map = [&](const std::string& out) {
    return std::vector<std::string>{"map", observations, "--sensor", "visibility", "--out", out};
  };
  const Outcome plain = mapproof(map(folder / "plain"));
  const Outcome little = within(kLimit, map(folder / "little"));
  EXPECT_EQ(little.exit_code, plain.exit_code) << little.error;
  EXPECT_EQ(read_file(folder / "little/map.json"), read_file(folder / "plain/map.json"));

  const TwoStudies two;
  two.change_score();
  const std::vector<std::string> diff = {"diff", two.before, two.after, "--json"};
  EXPECT_EQ(within(kLimit, diff).exit_code, 1);
  EXPECT_EQ(within(kLimit, diff).out, mapproof(diff).out);
}

/// The most bytes of memory that the program holds at once.
double most_memory(const std::vector<std::string>& arguments) {
  std::vector<std::string> command = {program()};
  command.insert(command.end(), arguments.begin(), arguments.end());
  std::vector<char*> words;
  for (std::string& word : command) words.push_back(word.data());
  words.push_back(nullptr);
  const pid_t child = ::fork();
  if (child == 0) {
    for (const int stream : {STDOUT_FILENO, STDERR_FILENO})
      ::dup2(::open("/dev/null", O_WRONLY), stream);
    ::execv(words[0], words.data());
    ::_exit(127);
  }
  int status = 0;
  rusage used{};
  EXPECT_EQ(::wait4(child, &status, 0, &used), child);
  EXPECT_TRUE(WIFEXITED(status)) << "signal " << WTERMSIG(status);
  return 1024.0 * static_cast<double>(used.ru_maxrss);
}

/// Text of `count` parts, written to a file, so that this process does not hold it.
template <typename Part>
std::string file_of(const TemporaryFolder& folder, const char* name, const std::string& start,
                    int count, const Part& part, const std::string& end) {
  const std::string path = folder / name;
  std::ofstream file(path);
  file << start;
  for (int i = 0; i < count; ++i) file << part(i);
  file << end;
  return path;
}

TEST(LittleMemory, OfTenTimesAFileIsEnoughToReadIt) {
  skip_if_sanitized();
  const TemporaryFolder folder;
  const double itself = most_memory({"--version"});
  const std::string json = R"({"schema": {"name": "mapproof.observations", "version": 1}, "x": [)";
  const auto values = [](int) {
    std::string row = "0.5";
    for (int i = 1; i < 1000; ++i) row += ",-1.25";
    return row + "\n";
  };
  // Of the shortest names and rows that there are.
  constexpr int kNames = 400'000;
  const auto names_and_values = [](int i) {
    if (i < kNames) return fmt::format("{}\"{:x}\"", i == 0 ? "" : ",", i);
    return std::string(i == kNames ? R"(],"values":[[1])" : ",[1]");
  };
  for (const std::string& file :
       {file_of(
            folder, "names.csv", "step,landmark,range,bearing\n", 900'000,
            [](int i) { return fmt::format("{},n{},{:.2f},0.5\n", i / 9, i, 1.0 + i % 7); }, ""),
        file_of(
            folder, "landmarks.csv", "name,x,y\n", 900'000,
            [](int i) { return fmt::format("n{},{},{}\n", i, i % 1000, i / 1000); }, ""),
        file_of(
            folder, "arrays.json", json, 5'000'000, [](int i) { return i == 0 ? "[]" : ",[]"; },
            "]}"),
        file_of(
            folder, "objects.json", json, 2'000'000,
            [](int i) { return i == 0 ? R"({"a":[]})" : R"(,{"a":[]})"; }, "]}"),
        file_of(folder, "names.json",
                R"({"schema":{"name":"mapproof.observations","version":1},"sensor":"range",)"
                R"("landmarks":[)",
                2 * kNames, names_and_values, "]}"),
        file_of(folder, "wide.csv", "", 3'000, values, "")}) {
    const auto bytes = static_cast<double>(fs::file_size(file));
    EXPECT_LT((most_memory({"validate", file}) - itself) / bytes, 10.0) << file;
    fs::remove(file);
  }
}

TEST(LittleMemory, OfTenTimesATableOfResultsIsEnoughForWhatReadsIt) {
  skip_if_sanitized();
  const TemporaryFolder folder, other;
  const double itself = most_memory({"--version"});
  // Short rows, and each run has two of them.
  for (const TemporaryFolder* one : {&folder, &other}) {
    write_file(one->path() / "study.json",
               R"({"schema": {"name": "mapproof.results_study", "version": 1}, "title": "Large"})");
    file_of(
        *one, "results.csv", "setup,method,quantity,run,value\n", 400'000,
        [&](int i) {
          return fmt::format("s,{},mpe_m,{:07},0.{:06}\n", i % 2 == 0 ? "ekf" : "mcl", i / 2,
                             (i * 7919LL + (one == &other)) % 1'000'000);
        },
        "");
  }
  const std::string study = folder.path().string(), table = folder / "results.csv";
  const auto bytes = static_cast<double>(fs::file_size(table));
  for (const std::vector<std::string>& command : {std::vector<std::string>{"results", study},
                                                  {"results", study, "--json"},
                                                  {"validate", study},
                                                  {"validate", table},
                                                  {"diff", study, other.path().string()}})
    EXPECT_LT((most_memory(command) - itself) / bytes, 10.0) << fmt::format("{}", command.front());
}

TEST(LittleMemory, StartsNoOtherBlasOfTheMachine) {
  const Environment other{{"LD_LIBRARY_PATH", MAPPROOF_OTHER_BLAS}};
  EXPECT_EQ(
      run_program({"sh", "-c", "exec cat \"$0/libblas.so.3\" > /dev/null", MAPPROOF_OTHER_BLAS})
          .exit_code,
      0);
  const Outcome outcome = mapproof({"--version"});
  EXPECT_EQ(outcome.exit_code, 0);
  EXPECT_EQ(outcome.error, "");
}

}  // namespace
}  // namespace mapproof::test
