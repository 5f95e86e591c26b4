#include <fcntl.h>
#include <sys/file.h>

#include <algorithm>
#include <cstdlib>
#include <iterator>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "core/base/files/descriptor.hpp"
#include "core/base/files/files.hpp"
#include "tests/app/ci/plot_scripts.hpp"
#include "tests/support/environment.hpp"
#include "tests/support/program.hpp"

namespace mapproof::test {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

const std::string kImages = std::string(MAPPROOF_SOURCE_DIR) + "/tests/baselines";

/// Images, and commands of a shell that draw them.
struct Plots {
  TemporaryFolder folder;
  std::string baseline = folder / "baseline";
  std::string out = folder / "out";

  Plots() {
    for (const char* id : {"curve-usual", "map-usual"})
      add(baseline, std::string(id) + ".png", std::string(id) + ".png");
  }
  static void add(const fs::path& to, const std::string& name, const std::string& image) {
    fs::create_directories(to);
    fs::copy_file(fs::path(kImages) / image, to / name, fs::copy_options::overwrite_existing);
  }
  /// Draws `name` as an image of the baselines is.
  static std::string draw(const std::string& name, const std::string& image) {
    return "cp '" + kImages + "/" + image + "' " + name + "; ";
  }
  static std::string draw_all() {
    return draw("curve-usual.png", "curve-usual.png") + draw("map-usual.png", "map-usual.png");
  }
  static std::string draw_changed() {
    return draw("curve-usual.png", "curve-usual.png") + draw("map-usual.png", "curve-log.png");
  }
  Outcome check(const std::string& script, std::vector<std::string> options = {}) const {
    std::vector<std::string> words = {"check", "--baseline", baseline, "--out", out};
    words.insert(words.end(), options.begin(), options.end());
    words.insert(words.end(), {"--", "sh", "-c", script});
    return mapproof(words);
  }
};

TEST(CheckACommand, PassesWhatIsAsTheBaselineAndFailsWhatIsNot) {
  const Plots plots;
  const Outcome same = plots.check(Plots::draw_all());
  EXPECT_EQ(same.exit_code, 0) << same.out << same.error;
  EXPECT_NE(same.out.find("passes: 2 identical"), std::string::npos) << same.out;
  const Outcome changed = plots.check(Plots::draw_changed());
  EXPECT_EQ(changed.exit_code, 1) << changed.error;
  EXPECT_NE(changed.out.find("map-usual: png, by its pixels alone"), std::string::npos);
  EXPECT_TRUE(fs::exists(plots.out + "/map-usual.png")) << "the candidate is kept";
  const Outcome missing = plots.check(Plots::draw("curve-usual.png", "curve-usual.png"));
  EXPECT_EQ(missing.exit_code, 1) << "nothing of an earlier candidate is compared";
  EXPECT_NE(missing.out.find("missing"), std::string::npos) << missing.out;
}

TEST(CheckACommand, ThatFailsOrDrawsNothingComparesNothing) {
  const Plots plots;
  const auto expect_two = [](const Outcome& outcome, const char* word) {
    EXPECT_EQ(outcome.exit_code, 2) << outcome.out;
    EXPECT_NE(outcome.error.find(word), std::string::npos) << outcome.error;
    EXPECT_EQ(outcome.out, "");
  };
  expect_two(plots.check(Plots::draw_all() + "exit 3"), "exit code 3");
  expect_two(plots.check("kill -9 $$"), "signal 9");
  expect_two(plots.check("true"), "it wrote no figure");
  expect_two(mapproof({"check", "--baseline", plots.baseline, "--out", plots.out, "--",
                       "no-such-program-of-plots"}),
             "no such program");
  expect_two(mapproof({"check", "--baseline", plots.baseline, "--seed", "1", "--", "true"}),
             "--seed is of an experiment");
  expect_two(mapproof({"check", "--baseline", plots.baseline, "sweep", "more"}), "behind --");
  expect_two(mapproof({"check", "--", "true"}), "--baseline DIR or --baseline-ref");
  expect_two(plots.check("echo '%' >map-usual.png; exit 1"), "exit code 1");
}

TEST(CheckACommand, ItsOutputDoesNotMixWithTheResult) {
  const Plots plots;
  const Outcome outcome = plots.check("echo drawn; read x; " + Plots::draw_all(), {"--json"});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.error;
  EXPECT_EQ(json::parse(outcome.out)["items"].size(), 2U);
  EXPECT_NE(outcome.error.find("drawn"), std::string::npos);
}

TEST(CheckACommand, NeverEmptiesAFolderThatIsNotItsCandidate) {
  const Plots plots;
  write_file(plots.out + "/thesis.txt", "years of work");
  const Outcome outcome = plots.check(Plots::draw_all());
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_NE(outcome.error.find("name another folder"), std::string::npos) << outcome.error;
  EXPECT_EQ(read_file(plots.out + "/thesis.txt"), "years of work");
  EXPECT_EQ(mapproof({"check", "--baseline", plots.baseline, "--out", plots.baseline, "--", "true"})
                .exit_code,
            2);
}

TEST(CheckACommand, ComparesInANamedFolderOnlyWhatTheCommandWrote) {
  const Plots plots;
  const std::string work = plots.folder / "work";
  const std::string plain = "cd '" + work + "' && ";
  for (const char* id : {"curve-usual", "map-usual"})
    Plots::add(work, std::string(id) + ".png", std::string(id) + ".png");
  const Outcome all = plots.check(plain + Plots::draw_all(), {"--writes", work});
  EXPECT_EQ(all.exit_code, 0) << "written again with the same bytes" << all.out << all.error;
  const Outcome one =
      plots.check(plain + Plots::draw("map-usual.png", "map-usual.png"), {"--writes", work});
  EXPECT_EQ(one.exit_code, 1) << "an old file is not what the command wrote";
  EXPECT_NE(one.out.find("curve-usual: is not in the current"), std::string::npos) << one.out;
  EXPECT_EQ(plots.check(Plots::draw_all(), {"--writes", plots.baseline}).exit_code, 2);
  EXPECT_EQ(plots.check(Plots::draw_all(), {"--writes", plots.out}).exit_code, 2);
}

TEST(CheckACommand, WithoutABaselineOneLineNamesWhatToDo) {
  const Plots plots;
  fs::remove_all(plots.baseline);
  for (const bool empty : {false, true}) {
    if (empty) fs::create_directories(plots.baseline);
    const Outcome outcome = plots.check(Plots::draw_all(), {"--junit", plots.folder / "diff.xml"});
    EXPECT_EQ(outcome.exit_code, 1);
    EXPECT_EQ(std::ranges::count(outcome.error, '\n'), 1) << outcome.error;
    EXPECT_EQ(outcome.out, "");
    EXPECT_NE(outcome.error.find("mapproof approve "), std::string::npos) << outcome.error;
  }
  const Outcome approved = mapproof({"approve", plots.baseline, plots.out, "--all"});
  EXPECT_EQ(approved.exit_code, 0) << approved.error;
  EXPECT_EQ(plots.check(Plots::draw_all()).exit_code, 0);
}

TEST(CheckACommand, ApproveNeverTakesWhatCannotBeRead) {
  const Plots plots;
  const std::string truncated = Plots::draw("curve-usual.png", "curve-usual.png") +
                                "head -c 300 '" + kImages + "/map-usual.png' >map-usual.png";
  const Outcome outcome = plots.check(truncated);
  EXPECT_EQ(outcome.exit_code, 1);
  EXPECT_NE(outcome.out.find("unreadable"), std::string::npos) << outcome.out;
  const std::string before = read_file(plots.baseline + "/map-usual.png");
  EXPECT_EQ(mapproof({"approve", plots.baseline, plots.out, "--all"}).exit_code, 1);
  EXPECT_EQ(mapproof({"approve", plots.baseline, plots.out, "map-usual"}).exit_code, 2);
  EXPECT_EQ(read_file(plots.baseline + "/map-usual.png"), before);
  EXPECT_EQ(plots.check(Plots::draw_changed(), {"--allow", "unreadable"}).exit_code, 1);
}

TEST(CheckACommand, SettingsHoldForItemsByPatterns) {
  const Plots plots;
  const std::string settings = plots.folder / "settings.json";
  const auto check = [&](const std::string& items) {
    write_file(settings,
               R"({"schema": {"name": "mapproof.diff_settings", "version": 1}, )" + items + "}");
    return plots.check(Plots::draw_changed(), {"--settings", settings});
  };
  EXPECT_EQ(check(R"("items": [{"id": "map-*", "allow": ["changed"]}])").exit_code, 0);
  EXPECT_EQ(check(R"("items": [{"id": "curve-*", "allow": ["changed"]}])").exit_code, 1);
  EXPECT_EQ(check(R"("items": [{"id": "map-*", "images": {"changed_share": 1}}])").exit_code, 0);
  EXPECT_EQ(check(R"("ignore": [{"id": "*-usual", "x": 0, "y": 0, "width": 9999, )"
                  R"("height": 9999}])")
                .exit_code,
            0);
  const Outcome formats = check(R"("items": [{"id": "map-*", "formats": ["svg"]}])");
  EXPECT_EQ(formats.exit_code, 0);
  EXPECT_NE(formats.out.find("Left out, 1 item by the settings:  map-usual."), std::string::npos)
      << formats.out;
  const Outcome unmatched = check(R"("items": [{"id": "mpa-*", "allow": ["changed"]}], )"
                                  R"("ignore": [{"id": "x?", "x": 0, "y": 0, "width": 1, )"
                                  R"("height": 1}])");
  EXPECT_EQ(unmatched.exit_code, 1);
  EXPECT_NE(unmatched.out.find("Settings that match nothing:"), std::string::npos);
  EXPECT_NE(unmatched.out.find("items \"mpa-*\""), std::string::npos) << unmatched.out;
  EXPECT_NE(unmatched.out.find("ignore \"x?\""), std::string::npos) << unmatched.out;
  const Outcome unknown = check(R"("items": [{"id": "*", "formats": ["pgn"]}])");
  EXPECT_EQ(unknown.exit_code, 2);
  EXPECT_NE(unknown.error.find("/items/0/formats/0"), std::string::npos) << unknown.error;
}

TEST(CheckACommand, IncludeAndExcludeSelectItemsAndFormats) {
  const Plots plots;
  const auto check = [&](const std::vector<std::string>& options) {
    return plots.check(Plots::draw_changed(), options);
  };
  EXPECT_EQ(check({"--exclude", "map-*"}).exit_code, 0);
  EXPECT_EQ(check({"--include", "curve-usual"}).exit_code, 0);
  EXPECT_EQ(check({"--include", "*.png", "--exclude", "map-usual.png"}).exit_code, 0);
  EXPECT_EQ(check({"--include", "map-*"}).exit_code, 1);
  EXPECT_EQ(check({"--exclude", "*"}).exit_code, 2) << "nothing is left";
  const Outcome misspelt = check({"--exclude", "mpa-*"});
  EXPECT_EQ(misspelt.exit_code, 1);
  EXPECT_NE(misspelt.out.find("--exclude \"mpa-*\""), std::string::npos) << misspelt.out;
}

TEST(CheckACommand, ImagesAndLinksShowWhatDiffers) {
  const Plots plots;
  const std::string images = plots.folder / "images", markdown = plots.folder / "diff.md",
                    junit = plots.folder / "diff.xml";
  const std::vector<std::string> options = {
      "--images", images, "--markdown",  markdown,
      "--junit",  junit,  "--image-url", "https://ci.example/7"};
  EXPECT_EQ(plots.check(Plots::draw_changed(), options).exit_code, 1);
  for (const char* name : {"baseline.png", "current.png"})
    EXPECT_TRUE(fs::exists(images + "/map-usual.png/" + name)) << name;
  EXPECT_FALSE(fs::exists(images + "/curve-usual.png"));
  EXPECT_NE(read_file(markdown).find("](https://ci.example/7/map-usual.png/current.png)"),
            std::string::npos)
      << read_file(markdown);
  EXPECT_NE(read_file(junit).find("\n[[ATTACHMENT|" + images + "/map-usual.png/current.png]]\n"),
            std::string::npos)
      << read_file(junit);
  {
    const Environment lab{{"GITLAB_CI", "true"}, {"CI_PROJECT_DIR", plots.folder.path().c_str()}};
    EXPECT_EQ(plots.check(Plots::draw_changed(), options).exit_code, 1);
    EXPECT_NE(read_file(junit).find("\n[[ATTACHMENT|images/map-usual.png/"), std::string::npos);
  }
  EXPECT_EQ(plots.check(Plots::draw_all(), options).exit_code, 0);
  EXPECT_FALSE(fs::exists(images + "/map-usual.png")) << "images of an earlier run are removed";
  write_file(plots.folder / "mine/photo.txt", "not an image of a comparison");
  EXPECT_EQ(plots.check(Plots::draw_all(), {"--images", plots.folder / "mine"}).exit_code, 2);
  EXPECT_EQ(plots.check(Plots::draw_all(), {"--images", plots.out + "/images"}).exit_code, 2);
}

TEST(CheckACommand, OnGitHubItemsThatDoNotPassAreErrorsAtTheirFiles) {
  const Plots plots;
  const Environment hub{{"GITHUB_ACTIONS", "true"},
                        {"GITHUB_WORKSPACE", plots.folder.path().c_str()}};
  const Outcome outcome =
      plots.check(Plots::draw_changed() + Plots::draw("'a,b:c%.png'", "curve-log.png"));
  EXPECT_EQ(outcome.exit_code, 1);
  EXPECT_NE(outcome.error.find("::error file=baseline/map-usual.png,title=mapproof%3A map-usual::"),
            std::string::npos)
      << outcome.error;
  EXPECT_NE(
      outcome.error.find("file=baseline/a%2Cb%3Ac%25.png,title=mapproof%3A a%2Cb%3Ac%25::new"),
      std::string::npos)
      << outcome.error;
  EXPECT_EQ(plots.check(Plots::draw_all()).error.find("::error"), std::string::npos);
  EXPECT_EQ(plots.check(Plots::draw_changed(), {"--annotations", "none"}).error.find("::error"),
            std::string::npos);
  std::string many = Plots::draw_all();
  for (int i = 0; i < 15; ++i)
    many += Plots::draw("n" + std::to_string(i) + ".png", "curve-usual.png");
  const Outcome some = plots.check(many);
  EXPECT_EQ(std::ranges::count(some.error, '\n'), 10) << some.error;
  EXPECT_NE(some.error.find("and 6 more"), std::string::npos) << some.error;
}

/// A git repository with the images of Plots in `plots`, on the branch "main".
struct Repository {
  Plots plots;
  std::string root = plots.folder / "repository";

  Repository() {
    fs::create_directories(root);
    fs::rename(plots.baseline, root + "/plots");
    run({"init", "-q", "-b", "main"});
    commit("Plots");
  }
  Outcome run(std::vector<std::string> words) const {
    std::vector<std::string> command = {
        "git", "-C", root, "-c", "user.name=Somebody", "-c", "user.email=somebody@example.org"};
    command.insert(command.end(), words.begin(), words.end());
    return run_program(command);
  }
  void commit(const std::string& message) const {
    run({"add", "-A"});
    const Outcome outcome = run({"commit", "-q", "-m", message});
    EXPECT_EQ(outcome.exit_code, 0) << outcome.error;
  }
  /// Runs the program in the repository.
  Outcome check(const std::string& ref, const std::string& script,
                const std::vector<std::string>& options = {},
                const std::string& temporary = "/tmp") const {
    std::vector<std::string> words = {
        "env", "-C",    root,     "TMPDIR=" + temporary, program(), "check", "--baseline-ref",
        ref,   "--out", plots.out};
    words.insert(words.end(), options.begin(), options.end());
    words.insert(words.end(), {"--", "sh", "-c", script});
    return run_program(words);
  }
};

TEST(CheckWithGit, ComparesWithTheFolderOfACommit) {
  const Repository repository;
  const Outcome same = repository.check("main:plots", Plots::draw_all());
  EXPECT_EQ(same.exit_code, 0) << same.out << same.error;
  EXPECT_NE(same.out.find("The baseline is main:plots, commit "), std::string::npos) << same.out;
  const std::string into = "cd plots; " + Plots::draw_changed();
  const Outcome changed = repository.check("HEAD:./plots/", into, {"--writes", "plots"});
  EXPECT_EQ(changed.exit_code, 1) << changed.error;
  EXPECT_NE(changed.out.find("map-usual: png, by its pixels alone"), std::string::npos);
  EXPECT_EQ(changed.out.find("/tmp/mapproof-baseline"), std::string::npos) << changed.out;
}

TEST(CheckWithGit, RemovesTheFolderOfARunThatWasKilledButNoneInUse) {
  const Repository repository;
  const std::string temporary = repository.plots.folder / "temporary";
  const fs::path used = fs::path(temporary) / "mapproof-baseline-in-use";
  fs::create_directories(used);
  const Descriptor lock(::open(used.c_str(), O_RDONLY | O_DIRECTORY));
  ASSERT_EQ(::flock(lock.get(), LOCK_EX | LOCK_NB), 0);
  const auto folders = [&] {
    return std::distance(fs::directory_iterator(temporary), fs::directory_iterator());
  };
  repository.check("main:plots", "kill -9 $PPID; sleep 1", {}, temporary);
  EXPECT_EQ(folders(), 2) << "the run was killed while it had its baseline";
  const Outcome next = repository.check("main:plots", Plots::draw_all(), {}, temporary);
  EXPECT_EQ(next.exit_code, 0) << next.error;
  EXPECT_EQ(folders(), 1);
  EXPECT_TRUE(fs::exists(used));
}

TEST(CheckWithGit, TakesTheSettingsOfThatCommit) {
  const Repository repository;
  write_file(repository.root + "/plots/mapproof-diff.json",
             R"({"schema": {"name": "mapproof.diff_settings", "version": 1},)"
             R"( "allow": ["changed"]})");
  EXPECT_EQ(repository.check("main:plots", Plots::draw_changed()).exit_code, 1);
  repository.commit("Settings");
  EXPECT_EQ(repository.check("main:plots", Plots::draw_changed()).exit_code, 0);
}

TEST(CheckWithGit, AFolderThatTheCommitLacksIsABaselineThatIsNotThereYet) {
  const Repository repository;
  const Outcome outcome = repository.check("main:figures", Plots::draw_all());
  EXPECT_EQ(outcome.exit_code, 1);
  EXPECT_NE(outcome.error.find("main:figures: there is no baseline"), std::string::npos);
  EXPECT_NE(outcome.error.find("mapproof approve figures "), std::string::npos) << outcome.error;
  EXPECT_EQ(repository.check("main:plots/map-usual.png", Plots::draw_all()).exit_code, 2);
  const Outcome unknown = repository.check("origin/main:plots", Plots::draw_all());
  EXPECT_EQ(unknown.exit_code, 2);
  EXPECT_NE(unknown.error.find("git has no commit \"origin/main\""), std::string::npos);
}

TEST(CheckWithGit, RefusesHostileRefsAndLeavesLinksOut) {
  const Repository repository;
  for (const char* ref :
       {"plots", ":plots", "--upload-pack=touch hacked:plots", "-h:plots", "main..main:plots",
        "^main:plots", "main:../plots", "main:/etc", "main:.git", "main:.GIT/hooks",
        "HEAD^{/x}:plots", "main\n:plots", "a b:plots", "$(touch hacked):plots",
        ";touch hacked;:plots", "main:plots/../.."}) {
    const Outcome outcome = repository.check(ref, Plots::draw_all());
    EXPECT_EQ(outcome.exit_code, 2) << ref << outcome.out;
    EXPECT_EQ(std::ranges::count(outcome.error, '\n'), 1) << outcome.error;
  }
  EXPECT_FALSE(fs::exists(repository.root + "/hacked"));
  fs::create_symlink("/etc", repository.root + "/plots/etc");
  fs::create_symlink("/etc/passwd", repository.root + "/plots/passwd.png");
  repository.commit("Links");
  const Outcome outcome = repository.check("main:plots", Plots::draw_all());
  EXPECT_EQ(outcome.exit_code, 0) << outcome.out << outcome.error;
  EXPECT_NE(outcome.out.find("Links and submodules in it are not compared:"), std::string::npos);
}

TEST(CheckWithGit, RefusesTreesWhoseNamesLeadOut) {
  const Repository repository;
  for (const char* name : {"..", ".git"}) {
    const std::string script =
        std::string(
            "set -e; file=$(git hash-object -w plots/map-usual.png); "
            "inner=$(printf '100644 blob %s\\t") +
        name +
        "\\n' $file | git mktree); "
        "outer=$(printf '040000 tree %s\\tplots\\n' $inner | git mktree); "
        "git update-ref refs/heads/hostile $(git -c user.name=S -c user.email=s@example.org "
        "commit-tree -m Hostile $outer)";
    const Outcome made = run_program({"env", "-C", repository.root, "bash", "-c", script});
    ASSERT_EQ(made.exit_code, 0) << made.error;
    const Outcome outcome = repository.check("hostile:plots", Plots::draw_all());
    EXPECT_EQ(outcome.exit_code, 2) << name;
    EXPECT_NE(outcome.error.find("cannot be written safely"), std::string::npos) << outcome.error;
  }
}

TEST(CheckScripts, OfMatplotlibPassTwiceAndFailWhenAPointMoves) {
  if (!has_matplotlib()) GTEST_SKIP() << "no matplotlib here";
  const Plots plots;
  const std::string script = plots.folder.file("plot.py", kMatplotlibScript);
  const auto check = [&](const std::string& value) {
    return mapproof(
        {"check", "--baseline", plots.baseline, "--out", plots.out, "--", python(), script, value});
  };
  fs::remove_all(plots.baseline);
  EXPECT_EQ(check("2").exit_code, 1);
  EXPECT_EQ(mapproof({"approve", plots.baseline, plots.out, "--all"}).exit_code, 0);
  const Outcome again = check("2");
  EXPECT_EQ(again.exit_code, 0) << again.out << again.error;
  const Outcome moved = check("2.3");
  EXPECT_EQ(moved.exit_code, 1) << moved.out;
  EXPECT_NE(moved.out.find("path: "), std::string::npos) << moved.out;
}

TEST(CheckScripts, OfGnuplotPassTwiceAndFailWhenACurveMoves) {
  if (run_program({"gnuplot", "--version"}).exit_code != 0) GTEST_SKIP() << "no gnuplot here";
  const Plots plots;
  fs::remove_all(plots.baseline);
  const auto check = [&](const std::string& slope) {
    const std::string script = plots.folder.file(
        "plot.gp", "set terminal svg\nset output 'line.svg'\nplot " + slope + "*x\n");
    return mapproof(
        {"check", "--baseline", plots.baseline, "--out", plots.out, "--", "gnuplot", script});
  };
  EXPECT_EQ(check("2").exit_code, 1);
  EXPECT_EQ(mapproof({"approve", plots.baseline, plots.out, "--all"}).exit_code, 0);
  const Outcome again = check("2");
  EXPECT_EQ(again.exit_code, 0) << again.out << again.error;
  EXPECT_EQ(check("2.4").exit_code, 1);
}

}  // namespace
}  // namespace mapproof::test
