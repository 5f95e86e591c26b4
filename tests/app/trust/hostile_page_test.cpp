#include <filesystem>
#include <string>

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "core/base/files/files.hpp"
#include "tests/app/two_studies.hpp"
#include "tests/support/program.hpp"
#include "tests/support/samples/active_svgs.hpp"

namespace mapproof::test {
namespace {

/// What a fired trap does to the page that it stands in.
const std::string kFire = "document.documentElement.dataset.trap=1";

/// Ways to make a text more than a text, one behind the other.
const std::string kTrap = "<script>" + kFire + "</script><img src=x onerror=\"" + kFire +
                          "\"><svg onload='" + kFire + "'/>\"'></script></style></title>" +
                          "</textarea><script>" + kFire + "</script>{{{x}}}]]>-->";

/// The same where a text is short.
const std::string kShortTrap = "<svg onload='" + kFire + "'>";

/// The page as Chromium has it after its scripts ran; empty if there is no Chromium.
std::string opened(const fs::path& page) {
  const TemporaryFolder profile;
  return run_program({"chromium", "--headless", "--no-sandbox", "--disable-gpu", "--disable-quic",
                      "--no-first-run", "--disable-background-networking",
                      "--disable-component-update", "--disable-sync",
                      "--allow-file-access-from-files",
                      "--user-data-dir=" + profile.path().string(), "--virtual-time-budget=2000",
                      "--dump-dom", "file://" + page.string()})
      .out;
}

void expect_not_fired(const fs::path& page) {
  const std::string dom = opened(page);
  EXPECT_GT(dom.size(), 200U) << page;
  EXPECT_EQ(dom.find("data-trap="), std::string::npos) << page << ": the trap fired";
  EXPECT_EQ(dom.find("href=\"javascript:"), std::string::npos) << page;
}

class HostilePage : public ::testing::Test {
 protected:
  void SetUp() override {
    const std::string plain = folder_.file("trap.html", "<title>t</title>" + kTrap);
    const std::string dom = opened(plain);
    if (dom.empty()) GTEST_SKIP() << "no Chromium on this machine: apt-get install chromium";
    ASSERT_NE(dom.find("data-trap="), std::string::npos) << "the trap itself does not fire";
  }

  /// A study of results with the trap in every text.
  fs::path study(const std::string& name, double value) const {
    const nlohmann::json head = {
        {"schema", {{"name", "mapproof.results_study"}, {"version", 1}}},
        {"title", kTrap},
        {"question", kTrap},
        {"quantities",
         {{{"id", "e"}, {"label", kShortTrap}, {"unit", kShortTrap}, {"better", "lower"}}}},
        {"setups", {{{"id", kTrap}, {"label", kTrap}}}},
        {"methods", {{{"id", kTrap}, {"label", kTrap}}, {{"id", "b"}, {"label", kTrap}}}}};
    const fs::path study = folder_ / name;
    write_file(study / "study.json", head.dump());
    std::string quoted = "\"";
    for (const char c : kTrap) quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
    quoted += "\"";
    std::string table = "setup,method,quantity,run,value,at.noise\n";
    for (const std::string& method : {quoted, std::string("b")})
      for (int run = 0; run < 4; ++run)
        for (const double noise : {0.1, 0.2})
          table +=
              fmt::format("{},{},e,r{},{},{}\n", quoted, method, run, value + noise * run, noise);
    write_file(study / "results.csv", table);
    return study;
  }

  TemporaryFolder folder_;
};

TEST_F(HostilePage, TextsOfAStudyStayTexts) {
  const fs::path first = study("a", 1.0), second = study("b", 2.0), store = folder_ / "store";
  for (const fs::path& one : {first, second}) {
    const Outcome made = mapproof({"report", one});
    ASSERT_EQ(made.exit_code, 0) << made.error;
    const Outcome recorded = mapproof({"nightly", one, "--store", store});
    ASSERT_EQ(recorded.exit_code, one == first ? 0 : 1) << recorded.error;
  }
  const fs::path page = folder_ / "diff.html";
  EXPECT_EQ(mapproof({"diff", first, second, "--page", page}).exit_code, 1);
  expect_not_fired(first / "report.html");
  expect_not_fired(page);
  expect_not_fired(store / "index.html");
  for (const auto& entry : fs::directory_iterator(store / "trends"))
    expect_not_fired(entry.path() / "report.html");
  for (const auto& entry : fs::directory_iterator(first / "figures"))
    if (entry.path().extension() == ".svg") {
      expect_not_fired(entry.path());
      break;  // All are written by one writer.
    }
}

TEST_F(HostilePage, ImagesOfABaselineStayImages) {
  const fs::path before = folder_ / "before", after = folder_ / "after";
  for (auto [name, text] : active_svgs()) {
    for (std::size_t at = text.find("x()"); at != std::string::npos; at = text.find("x()", at + 1))
      text.replace(at, 3, kFire);
    write_file(before / (name + ".svg"), text);
    write_file(after / (name + ".svg"), "<svg xmlns='http://www.w3.org/2000/svg'/>");
  }
  const fs::path page = folder_ / "diff.html";
  EXPECT_EQ(mapproof({"diff", before, after, "--page", page}).exit_code, 1);
  expect_not_fired(page);
  EXPECT_EQ(mapproof({"diff", after, before, "--page", page}).exit_code, 1);
  expect_not_fired(page);
}

}  // namespace

TEST(ApproveCommand, TakesNoSvgThatRunsOrLoadsSomething) {
  const TemporaryFolder folder;
  const fs::path baseline = folder / "baseline", current = folder / "current";
  const auto active = active_svgs();
  for (const auto& [name, text] : active) write_file(current / (name + ".svg"), text);
  write_file(current / "good.svg", "<svg xmlns='http://www.w3.org/2000/svg'/>");
  const Outcome outcome = mapproof({"approve", baseline, current, "--all"});
  EXPECT_EQ(outcome.exit_code, 1) << outcome.error;
  for (const auto& [name, text] : active)
    EXPECT_NE(outcome.error.find(name + ".svg: "), std::string::npos) << name;
  EXPECT_EQ(contents(baseline).size(), 1U);
}

}  // namespace mapproof::test
