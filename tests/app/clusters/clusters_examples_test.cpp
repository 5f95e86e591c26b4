#include <regex>
#include <sstream>

#include <gtest/gtest.h>

#include "core/base/files/files.hpp"
#include "tests/support/program.hpp"

namespace mapproof::test {
namespace {

namespace fs = std::filesystem;

const fs::path kRoot = MAPPROOF_SOURCE_DIR;
const fs::path kExamples = kRoot / "examples/clusters";

/// Runs a line as a shell does that finds the program.
Outcome run_line(const fs::path& folder, const std::string& line) {
  const std::string path =
      "PATH=" + fs::path(program()).parent_path().string() + ":/usr/local/bin:/usr/bin:/bin";
  return run_program({"env", "-C", folder.string(), path, "HOME=" + folder.string(), "bash", "-e",
                      "-o", "pipefail", "-c", line});
}

/// The experiment that the page runs.
void copy_study(const fs::path& folder) {
  fs::create_directories(folder / "examples/study");
  fs::copy(kRoot / "examples/study", folder / "examples/study");
}

/// The commands of a job's file, of an experiment that takes a second.
std::vector<std::string> commands_of(const fs::path& file) {
  std::vector<std::string> commands;
  std::istringstream text(read_file(file));
  for (std::string line; std::getline(text, line);)
    if (const std::size_t at = line.find("- run: mapproof"); at != std::string::npos)
      commands.push_back(line.substr(at + 7));
    else if (const std::size_t item = line.find("- mapproof"); item != std::string::npos)
      commands.push_back(line.substr(item + 2));
  for (std::string& command : commands)
    command = std::regex_replace(command, std::regex("yairi2007"),
                                 (kRoot / "tests/data/experiments/small.json").string());
  return commands;
}

TEST(ClustersExamples, AreThoseThatTheDocumentationShows) {
  const std::string page = read_file(kRoot / "docs/clusters.md");
  int examples = 0;
  for (const auto& entry : fs::directory_iterator(kExamples)) {
    ++examples;
    EXPECT_NE(page.find("\n" + read_file(entry.path()) + "```"), std::string::npos) << entry.path();
  }
  EXPECT_EQ(examples, 2);
}

TEST(ClustersExamples, TheCommandsOfAMatrixMakeTheStudy) {
  for (const char* name : {"github.yml", "gitlab-ci.yml"}) {
    SCOPED_TRACE(name);
    const TemporaryFolder folder;
    const std::vector<std::string> commands = commands_of(kExamples / name);
    ASSERT_EQ(commands.size(), 3U);
    for (int job = 1; job <= 4; ++job) {
      const std::string number = std::to_string(job);
      const std::string command = std::regex_replace(
          commands[0], std::regex(R"(\$\{\{ matrix\.shard \}\}|\$CI_NODE_INDEX)"), number);
      const Outcome outcome = run_line(folder.path(), "CI_NODE_TOTAL=4; " + command);
      ASSERT_EQ(outcome.exit_code, 0) << command << '\n' << outcome.error;
    }
    const Outcome merged = run_line(folder.path(), commands[1]);
    ASSERT_EQ(merged.exit_code, 0) << commands[1] << '\n' << merged.error;
    EXPECT_TRUE(fs::exists(folder / "study/results.csv"));
    EXPECT_EQ(commands[2], "mapproof report study");
  }
}

TEST(ClustersExamples, AreYamlOfWhichTheMergeRunsAfterAFailedShardToo) {
  const std::string script =
      "import sys\n"
      "try: import yaml\n"
      "except ImportError: sys.exit(77)\n"
      "hub, lab = (yaml.safe_load(open(path)) for path in sys.argv[1:])\n"
      "assert hub['jobs']['merge']['needs'] == 'shard'\n"
      "assert hub['jobs']['merge']['if'] == 'always()'\n"
      "assert hub['jobs']['shard']['strategy']['matrix'] == {'shard': [1, 2, 3, 4]}\n"
      "assert lab['shard']['parallel'] == 4 and lab['merge']['when'] == 'always'\n";
  const Outcome outcome =
      run_program({"python3", "-c", script, kExamples / "github.yml", kExamples / "gitlab-ci.yml"});
  if (outcome.exit_code == 77 || outcome.exit_code == 127) GTEST_SKIP() << "no PyYAML here";
  EXPECT_EQ(outcome.exit_code, 0) << outcome.error;
}

TEST(ClustersExamples, TheLinesOfXargsAndGnuParallelRunAsTheyStand) {
  const TemporaryFolder folder;
  copy_study(folder.path());
  fs::create_directory(folder / "out");
  const bool has_parallel =
      run_line(folder.path(), "parallel --version | grep -q GNU").exit_code == 0;
  std::istringstream page(read_file(kRoot / "docs/clusters.md"));
  int run = 0;
  for (std::string line; std::getline(page, line);) {
    if (!line.starts_with("seq ")) continue;
    const bool is_parallel = line.find("| parallel ") != std::string::npos;
    std::string merge;
    std::getline(page, merge);
    ++run;
    if (is_parallel && !has_parallel) continue;
    for (const std::string& command : {line, merge}) {
      const Outcome outcome = run_line(folder.path(), command);
      EXPECT_EQ(outcome.exit_code, 0) << command << '\n' << outcome.error;
    }
  }
  EXPECT_EQ(run, 2);
  if (!has_parallel) GTEST_SKIP() << "no GNU parallel here: its line is not run";
}

/// A Slurm without nodes: sbatch runs a job before it returns, and squeue knows of none.
void write_slurm(const fs::path& bin) {
  const auto write = [&](const char* name, const char* text) {
    write_file(bin / name, text);
    fs::permissions(bin / name, fs::perms::owner_all);
  };
  write("sbatch", R"(#!/bin/bash
array=0 output=/dev/null
for word; do
  case $word in
    --array=*) array=${word#*=} ;;
    --output=*) output=${word#*=} ;;
    --dependency=afterok:*) [ ! -e "$JOBS/${word##*:}.failed" ] || exit 0 ;;
  esac
done
job=$(($(ls "$JOBS" | wc -l) + 1))
cat >"$JOBS/$job"
echo "$*" >>"$JOBS/all"
[[ $array != *-* ]] || array=$(seq -s , "${array%-*}" "${array#*-}")
for task in ${array//,/ }; do
  SLURM_ARRAY_TASK_ID=$task bash "$JOBS/$job" >>"${output//%a/$task}" 2>&1 ||
    touch "$JOBS/$job.failed"
done
echo "$job"
)");
  write("squeue",
        "#!/bin/sh\necho 'slurm_load_jobs error: Invalid job id specified' >&2\nexit 1\n");
}

TEST(ClustersExamples, TheScriptForSlurmRunsShardsMergeAndReportAndWhatIsMissingAgain) {
  const TemporaryFolder folder;
  for (const char* inner : {"bin", "jobs"}) fs::create_directory(folder / inner);
  write_slurm(folder / "bin");
  const std::string page = read_file(kRoot / "docs/clusters.md");
  const std::size_t at = page.find("\nscripts/slurm ") + 1;
  std::string command = page.substr(at, page.find('\n', at) - at);
  ASSERT_TRUE(command.ends_with(" --tasks 4 --out out/slurm")) << command;
  copy_study(folder.path());
  command = "PATH=$HOME/bin:$PATH JOBS=$HOME/jobs MAPPROOF='" + program() + "' '" + kRoot.string() +
            "'/" + command;
  const Outcome first = run_line(folder.path(), command);
  ASSERT_EQ(first.exit_code, 0) << first.error;
  EXPECT_TRUE(fs::exists(folder / "out/slurm/study/report.html"));
  EXPECT_NE(read_file(folder / "jobs/all").find("--array=1-4"), std::string::npos);

  fs::remove(folder / "out/slurm/shards/3-of-4/runs/layout-2-pose-1.json");
  const Outcome again = run_line(folder.path(), command);
  EXPECT_EQ(again.exit_code, 0) << again.error;
  EXPECT_NE(again.error.find("submitted: shards 3 as job"), std::string::npos) << again.error;

  // A shard that cannot be run.
  fs::remove_all(folder / "out/slurm/shards/2-of-4/runs");
  folder.file("out/slurm/shards/2-of-4/runs", "");
  const Outcome failed = run_line(folder.path(), command);
  EXPECT_EQ(failed.exit_code, 1);
  EXPECT_NE(failed.error.find("tasks of shard 2/4 are missing or damaged"), std::string::npos)
      << failed.error;
  EXPECT_EQ(run_line(folder.path(), command + " --taks 3").exit_code, 2);
}

}  // namespace
}  // namespace mapproof::test
