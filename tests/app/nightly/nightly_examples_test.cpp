#include <sstream>

#include <gtest/gtest.h>

#include "core/base/files/files.hpp"
#include "tests/support/program.hpp"

namespace mapproof::test {
namespace {

namespace fs = std::filesystem;

const fs::path kSource = MAPPROOF_SOURCE_DIR;
const fs::path kExamples = kSource / "examples/nightly";

std::string replaced(std::string text, const std::string& what, const std::string& by) {
  const std::size_t at = text.find(what);
  EXPECT_NE(at, std::string::npos) << what << " is not in: " << text;
  return at == std::string::npos ? text : text.replace(at, what.size(), by);
}

/// An example's command on this build and a study of a second.
std::string shortened(const std::string& command) {
  return replaced(command, "yairi2007",
                  "'" + (kSource / "tests/data/experiments/small.json").string() + "'");
}

/// The first line that holds a text, from that text on.
std::string from(const std::string& text, const std::string& part) {
  const std::size_t at = text.find(part);
  EXPECT_NE(at, std::string::npos) << part;
  return at == std::string::npos ? "" : text.substr(at, text.find('\n', at) - at);
}

/// Runs a shell's command as a timer does: with nothing of this process' environment.
Outcome run_bare(const fs::path& home, const std::vector<std::string>& shell,
                 const std::string& command) {
  const std::string tools = fs::path(program()).parent_path().string();
  std::vector<std::string> words = {
      "env", "-i", "-C", home, "HOME=" + home.string(), "PATH=" + tools + ":/usr/bin:/bin"};
  words.insert(words.end(), shell.begin(), shell.end());
  words.push_back(command);
  return run_program(words);
}

TEST(NightlyExamples, AreThoseThatTheDocumentationShows) {
  const std::string page = read_file(kSource / "docs/nightly.md");
  int examples = 0;
  for (const auto& entry : fs::directory_iterator(kExamples)) {
    ++examples;
    EXPECT_NE(page.find("\n" + read_file(entry.path()) + "```"), std::string::npos) << entry.path();
    EXPECT_NE(page.find("nightly/" + entry.path().filename().string()), std::string::npos);
  }
  EXPECT_EQ(examples, 5);
}

TEST(NightlyExamples, TheUnitsAreThoseOfSystemd) {
  const TemporaryFolder folder;
  for (const char* name : {"mapproof-nightly.service", "mapproof-nightly.timer"}) {
    std::string text = read_file(kExamples / name);
    if (text.find("ExecStart=") != std::string::npos)
      text = replaced(text, "/usr/local/bin/mapproof", program());
    write_file(folder / name, text);
  }
  const Outcome outcome =
      run_program({"systemd-analyze", "verify", "--man=no", "--recursive-errors=no",
                   folder / "mapproof-nightly.service", folder / "mapproof-nightly.timer"});
  if (outcome.exit_code == 127) GTEST_SKIP() << "no systemd-analyze here";
  EXPECT_EQ(outcome.exit_code, 0) << outcome.error;
  EXPECT_EQ(outcome.error.find("mapproof-nightly"), std::string::npos) << outcome.error;
}

TEST(NightlyExamples, TheLineOfCronRunsInTheBareShellOfCron) {
  const TemporaryFolder folder;
  std::istringstream line(read_file(kExamples / "crontab"));
  std::string fields, field, command;
  for (int i = 0; i < 5; ++i) fields += (line >> field, field + " ");
  std::getline(line, command);
  EXPECT_EQ(fields, "30 2 * * * ");
  EXPECT_EQ(command.find('%'), std::string::npos) << "cron takes % for the end of the line";
  command = shortened(replaced(command, "/usr/local/bin/mapproof", "'" + program() + "'"));
  const Outcome outcome = run_bare(folder.path(), {"/bin/sh", "-c"}, command);
  EXPECT_EQ(outcome.exit_code, 0) << outcome.error;
  EXPECT_NE(outcome.out.find("nightly run 1: Not compared"), std::string::npos);
  EXPECT_TRUE(fs::exists(folder / "mapproof-history/index.html"));
}

TEST(NightlyExamples, TheCommandsOfCiRunNightlyRunAfterNightlyRun) {
  const TemporaryFolder folder;
  for (const char* name : {"github.yml", "gitlab-ci.yml"}) {
    const std::string command =
        shortened(from(read_file(kExamples / name), "mapproof nightly yairi2007"));
    const Outcome outcome = run_bare(folder.path(), {"bash", "-e", "-o", "pipefail", "-c"},
                                     replaced(command, "--profile quick", "--profile tiny"));
    EXPECT_EQ(outcome.exit_code, 0) << name << outcome.error;
  }
  EXPECT_EQ(mapproof({"history", folder / "history"}).exit_code, 0);
}

TEST(NightlyExamples, OfCiAreYamlWithAJobThatKeepsTheHistoryOfAFailedNightlyRun) {
  const std::string script =
      "import sys\n"
      "try: import yaml\n"
      "except ImportError: sys.exit(77)\n"
      "hub, lab = (yaml.safe_load(open(path)) for path in sys.argv[1:])\n"
      "steps = hub['jobs']['nightly']['steps']\n"
      "saved = [s for s in steps if s.get('uses', '').startswith('actions/cache/save@')]\n"
      "assert saved[0]['if'] == 'always()' and saved[0]['with']['path'] == 'history'\n"
      "assert lab['nightly']['cache']['when'] == 'always'\n"
      "runs = [s['run'] for s in steps if 'run' in s]\n"
      "assert 'MAPPROOF_PACKAGE' in runs[0] and 'apt-get install' in runs[0], runs\n"
      "assert runs[1].startswith('mapproof nightly')\n"
      "before = ' '.join(lab['nightly']['before_script'])\n"
      "assert 'MAPPROOF_PACKAGE' in before and 'install -y -qq /tmp/mapproof.deb' in before\n"
      "assert lab['nightly']['allow_failure'] == {'exit_codes': 4}\n";
  const Outcome outcome =
      run_program({"python3", "-c", script, kExamples / "github.yml", kExamples / "gitlab-ci.yml"});
  if (outcome.exit_code == 77 || outcome.exit_code == 127) GTEST_SKIP() << "no PyYAML here";
  EXPECT_EQ(outcome.exit_code, 0) << outcome.error;
}

}  // namespace
}  // namespace mapproof::test
