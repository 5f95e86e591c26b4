#include "app/disclosure.hpp"

#include <unistd.h>

#include <array>
#include <cctype>
#include <filesystem>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "core/base/files/files.hpp"
#include "tests/app/two_studies.hpp"
#include "tests/support/environment.hpp"
#include "tests/support/program.hpp"

namespace mapproof::test {
namespace {

const std::string kSource = MAPPROOF_SOURCE_DIR;
const std::string kUser = "odd-user-4711";

std::string host() {
  std::array<char, 256> name{};
  return ::gethostname(name.data(), name.size() - 1) == 0 ? name.data() : "";
}

/// A person of an odd name, at home in a folder of an odd name.
struct Person {
  TemporaryFolder folder;
  fs::path home = folder / "Ödd & home of 4711";
  Environment environment{
      {{"HOME", home.c_str()}, {"USER", kUser.c_str()}, {"LOGNAME", kUser.c_str()}}};

  Person() { fs::create_directories(home / "in"); }

  std::string in(const std::string& name, const std::string& from) const {
    fs::copy(kSource + "/" + from, home / "in" / name, fs::copy_options::recursive);
    return home / "in" / name;
  }
};

/// Expects no file below the folder to hold a word that only the person or the machine has.
void expect_anonymous(const fs::path& folder) {
  std::vector<std::string> words = {kUser, "dd & home", "dd &amp; home", "dd%20%26%20home"};
  // A short name may be a part of any word.
  if (const std::string name = host(); name.size() > 4 && name != "localhost")
    words.push_back(name);
  std::size_t files = 0;
  for (const auto& [file, bytes] : contents(folder)) {
    ++files;
    for (const std::string& word : words)
      EXPECT_EQ(bytes.find(word), std::string::npos) << file << " holds " << word;
  }
  EXPECT_GT(files, 0U) << folder;
}

void expect_done(const std::vector<std::string>& command, int code = 0) {
  const Outcome outcome = mapproof(command);
  EXPECT_EQ(outcome.exit_code, code) << command.front() << ": " << outcome.error;
}

TEST(Provenance, OfMapsNamesNoUserHostOrHome) {
  const Person person;
  const std::string map = person.in("map", "examples/hall"),
                    log = person.in("slam", "examples/drive");
  const std::string out = person.home / "out";
  expect_done({"map", map + "/bearings.csv", "--sensor", "bearing", "--method", "lpca", "--anchors",
               map + "/anchors.csv", "--out", out + "/map"});
  expect_done({"slam", log, "--out", out + "/slam"});
  expect_anonymous(out);
  EXPECT_NE(read_file(out + "/map/report.html").find("~/in/map/bearings.csv"), std::string::npos);
}

TEST(Provenance, OfStudiesAndComparisonsNamesNoUserHostOrHome) {
  const Person person;
  const std::string order = person.in("small.json", "tests/data/experiments/small.json");
  const std::string out = person.home / "out";
  fs::create_directory(out);
  for (const char* study : {"/a", "/b"}) {
    expect_done({"run", order, "--profile", "tiny", "--jobs", "1", "--out", out + study});
    expect_done({"report", out + study});
  }
  replace_in(out + "/b/runs/layout-1-pose-1.json", "\"mpe_m\": 0.", "\"mpe_m\": 0.9");
  expect_done({"diff", out + "/a", out + "/b", "--page", out + "/diff.html", "--junit",
               out + "/diff.xml", "--markdown", out + "/diff.md"},
              1);
  write_file(out + "/diff.json", mapproof({"diff", out + "/a", out + "/b", "--json"}).out);
  expect_anonymous(out);
  EXPECT_NE(read_file(out + "/a/timings.jsonl").find("\"host\": \"host-"), std::string::npos);
}

TEST(Provenance, OfNightlyRunsNamesNoUserHostOrHomeUnlessItIsAskedFor) {
  const Person person;
  const std::string order = person.in("small.json", "tests/data/experiments/small.json");
  const std::string store = person.home / "store", full = person.home / "full";
  for (int i = 0; i < 2; ++i)
    expect_done({"nightly", order, "--profile", "tiny", "--jobs", "1", "--store", store});
  expect_anonymous(store);
  const Outcome list = mapproof({"history", store, "--json"});
  EXPECT_TRUE(
      nlohmann::json::parse(list.out)["nightly_runs"][0]["host"].get<std::string>().starts_with(
          "host-"));
  expect_done({"nightly", order, "--profile", "tiny", "--jobs", "1", "--store", full,
               "--provenance", "full"});
  EXPECT_NE(read_file(full + "/index.html").find(host()), std::string::npos);
  EXPECT_NE(read_file(full + "/history.sqlite").find(person.home.string()), std::string::npos);
}

TEST(Disclosure, WritesATildeForTheHomeFolderAndNothingElse) {
  const Environment environment{{{"HOME", "/home/ann o'x"}, {"USER", "ann"}, {"LOGNAME", "ann"}}};
  const Disclosure reduced(false), full(true);
  EXPECT_EQ(reduced.text("see /home/ann o'x/a, /home/ann o'x."), "see ~/a, ~.");
  EXPECT_EQ(reduced.text("/home/ann o'xy/a /mnt/home/ann o'x/a /home/ann o'x.d"),
            "/home/ann o'xy/a /mnt/home/ann o'x/a /home/ann o'x.d");
  EXPECT_EQ(reduced.text("href=\"/home/ann o&#39;x/a\" /home/ann%20o%27x/a"), "href=\"~/a\" ~/a");
  EXPECT_EQ(full.text("/home/ann o'x/a"), "/home/ann o'x/a");
}

TEST(Disclosure, FindsTheHomeFolderBehindDetours) {
  const Environment environment{{{"HOME", "/x/real/ann"}, {"USER", "bob"}, {"LOGNAME", "bob"}}};
  const Disclosure reduced(false);
  EXPECT_EQ(reduced.text("/x/media/../real/ann/b.csv"), "~/b.csv");
  EXPECT_EQ(reduced.text("see /x//real/./ann, \"/a/b/../../x/real/c/../ann/d\""), "see ~, \"~/d\"");
  EXPECT_EQ(reduced.words({"--out=/x/my media/../real/ann/b"}),
            (std::vector<std::string>{"--out=~/b"}));
  for (const char* other : {"/x/media/../real/anna/b", "../../x/real/an/../b", "http://x/real/ann",
                            "/x/real/../ann/b", "a/../b", "//", "/../"})
    EXPECT_EQ(reduced.text(other), other);
  // An image in a page is text with many slashes: this took minutes.
  std::string image;
  while (image.size() < 2'000'000) image += "iVBORw0KGgo+//8/annA";
  EXPECT_EQ(reduced.text(image + "\" /x//real/ann"), image + "\" ~");
}

TEST(Provenance, OfMethodsOfOthersNamesNoUserHostOrHome) {
  const Person person;
  const std::string order = person.in("small.json", "tests/data/experiments/small.json");
  const std::string script = person.in("client.sh", "tests/data/experiments/small.json");
  write_file(script, "echo \"$0: no licence\" >&2; exit 3\n");
  const std::string methods = person.home / "in/methods.json";
  const nlohmann::json method{{"name", "other"},
                              {"label", "Other"},
                              {"input", "distances"},
                              {"command", std::vector<std::string>{"sh", script}}};
  const nlohmann::json file{{"schema", {{"name", "mapproof.methods"}, {"version", 1}}},
                            {"methods", std::vector<nlohmann::json>{method}}};
  write_file(methods, file.dump());
  const std::string out = person.home / "out";
  for (int i = 0; i < 2; ++i)
    expect_done(
        {"run", order, "--methods", methods, "--profile", "tiny", "--jobs", "1", "--out", out});
  expect_done({"report", out});
  expect_anonymous(out);
  const std::string run = read_file(out + "/runs/layout-1-pose-1.json");
  EXPECT_NE(run.find("~/in/client.sh: no licence"), std::string::npos)
      << "the command was started where it is";
}

TEST(Provenance, OfTheCommandThatBuildsNamesNoHome) {
  const Person person;
  const std::string order = person.in("small.json", "tests/data/experiments/small.json");
  const std::string store = person.home / "store";
  expect_done({"nightly", order, "--profile", "tiny", "--jobs", "1", "--store", store, "--build",
               "make -C '" + (person.home / "project").string() + "'"});
  expect_anonymous(store);
}

TEST(Disclosure, WritesAbsolutePathsOfACommandFromTheWorkingFolderOrTheirLastName) {
  const Environment environment{{{"HOME", "/home/ann"}, {"USER", "ann"}, {"LOGNAME", "ann"}}};
  const fs::path here = fs::current_path(), beside = here.parent_path() / "beside/b.csv";
  ASSERT_GT(std::distance(here.begin(), here.end()), 1) << "all paths are in the root";
  const Disclosure reduced(false);
  const std::vector<std::pair<std::string, std::string>> shown = {
      {"map", "map"},
      {here / "in/a.csv", "in/a.csv"},
      {here / "-a.csv", "./-a.csv"},
      {here, "."},
      {"--out=" + beside.string(), "--out=…/b.csv"},
      {"--images=baseline@/x/y z.png", "--images=baseline@…/y z.png"},
      {"/data of all/plaza/", "…/plaza"},
      {"-I/opt/x", "-I…/x"},
      {"a=/x/b,/y/c", "a=…/b,…/c"},
      {"file:///x/y", "file://…/y"},
      {"http://x/y", "http://x/y"},
      {"../c.csv", "../c.csv"},
      {"/", "/"},
      {"make -C " + here.string() + " DATA='/x y/d e' && /opt/z/run",
       "make -C . DATA='…/d e' && …/run"}};
  for (const auto& [typed, word] : shown) EXPECT_EQ(reduced.words({typed}).front(), word);
  EXPECT_EQ(reduced.method_command({here / "in/a.csv"}).front(), "…/a.csv");
  EXPECT_EQ(Disclosure(true).words({here / "a"}).front(), (here / "a").string());
}

TEST(Provenance, NamesNoFolderThatAnArgumentIsIn) {
  const TemporaryFolder folder;
  const fs::path data = folder / "folder-4711", out = folder / "out-4711";
  fs::create_directories(data);
  fs::create_directories(out);
  fs::copy(kSource + "/examples/hall", data / "hall", fs::copy_options::recursive);
  fs::copy(kSource + "/tests/data/experiments/small.json", data / "small.json");
  const std::string hall = data / "hall", small = data / "small.json";
  const std::vector<std::string> tiny = {"--profile", "tiny", "--jobs", "1", "--out", out / "run"};
  std::vector<std::string> run = {"run", small};
  run.insert(run.end(), tiny.begin(), tiny.end());
  expect_done({"map", hall + "/bearings.csv", "--sensor", "bearing", "--method", "lpca",
               "--anchors=" + hall + "/anchors.csv", "--out", out / "map"});
  expect_done(run);
  expect_done({"report", out / "run"});
  expect_done({"nightly", small, "--profile", "tiny", "--jobs", "1", "--store", out / "store",
               "--build", "make -C " + data.string()});
  for (const auto& [file, bytes] : contents(out))
    EXPECT_EQ(bytes.find("-4711/"), std::string::npos) << file;
  EXPECT_NE(read_file(out / "map/report.html").find("--anchors=…/anchors.csv"), std::string::npos);
  EXPECT_NE(read_file(out / "run/timings.jsonl").find("run …/small.json"), std::string::npos);
}

TEST(Provenance, OfTheCommandThatDrawsAFigureNamesItsFolderIfThatIsAskedFor) {
  const TwoStudies studies;
  const auto has = [&](const std::string& words) {
    return read_file(studies.before + "/report.html").find(words) != std::string::npos;
  };
  expect_done({"report", studies.before});
  EXPECT_TRUE(has("mapproof render …/before --figure ID"));
  expect_done({"report", studies.before, "--provenance", "full"});
  EXPECT_TRUE(has("mapproof render " + studies.before + " --figure ID"));
}

TEST(Disclosure, NamesNoUserHostOrAddressInACommand) {
  const Environment environment{{{"HOME", "/home/ann"}, {"USER", "ann"}, {"LOGNAME", "ann"}}};
  const Disclosure reduced(false);
  const std::vector<std::string> words = {
      "map",  "/scratch/ann/a.csv", "x/ann/a.csv",       "--out=/home/ann/b c",
      "anna", "ann@example.org/x",  "map@cairo-1.18.png"};
  EXPECT_EQ(reduced.words(words),
            (std::vector<std::string>{"map", "…/a.csv", "x/USER/a.csv", "--out=~/b c", "anna",
                                      "E-MAIL/x", "map@cairo-1.18.png"}));
  EXPECT_EQ(Disclosure(true).words(words), words);
  EXPECT_EQ(reduced.host(), Disclosure(false).host());
  EXPECT_EQ(reduced.host().size(), 13U);
  EXPECT_EQ(Disclosure(true).host(), host());
}

}  // namespace
}  // namespace mapproof::test
