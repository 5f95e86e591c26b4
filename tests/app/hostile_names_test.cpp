#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "core/base/files/files.hpp"
#include "tests/support/program.hpp"

namespace mapproof::test {
namespace {

namespace fs = std::filesystem;

const std::vector<std::string> kHostile = {
    "<script>document.title='pwned'</script>",
    "\"><img src=x onerror=alert(1)>",
    "'; DROP TABLE maps; --",
    "\u202Eright to left\u202C",
    "../../../../tmp/mapproof-escaped",
    "{{title}} {{{alt}}}",
    "&amp;&#60;",
    std::string(10000, 'W'),
    "=cmd|' /C calc'!A0",
    "\U0001F600\u05D0\u0301 ]]> --> </svg>",
};

std::string quoted_csv(const std::string& name) {
  std::string out = "\"";
  for (const char c : name) out += c == '"' ? std::string("\"\"") : std::string(1, c);
  return out + "\"";
}

TEST(HostileNames, StayTextInEveryOutputAndNeverReachTheFileSystem) {
  const TemporaryFolder folder;
  std::string seen;
  std::string ground_truth;
  for (std::size_t i = 0; i < kHostile.size(); ++i) {
    const auto row = static_cast<double>(i);
    seen += quoted_csv(kHostile[i]);
    for (int t = 0; t < 40; ++t)
      seen +=
          fmt::format(",{}", std::remainder(row * 0.7 + t * 0.31 * (1.0 + row * row * 0.05), 6.28));
    seen += "\n";
    ground_truth += fmt::format("{},{},{}\n", quoted_csv(kHostile[i]), row, (3 * i) % 7);
  }
  const std::string positions = folder.file("groundtruth.csv", ground_truth);
  const Outcome outcome =
      mapproof({"map", folder.file("seen.csv", seen), "--sensor", "bearing", "--method", "lpca",
                "--anchors", positions, "--truth", positions, "--out", folder / "map", "--json"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.error;
  const auto result = nlohmann::json::parse(outcome.out);
  for (std::size_t i = 0; i < kHostile.size(); ++i)
    EXPECT_EQ(result["landmarks"][i]["name"], kHostile[i]);

  for (const auto& [file, bytes] : contents(folder / "map")) {
    EXPECT_TRUE(file.find("escaped") == std::string::npos && file.size() < 60) << file;
    if (file.ends_with(".svg") || file.ends_with(".html")) {
      EXPECT_EQ(bytes.find("<script>document"), std::string::npos) << file;
      EXPECT_EQ(bytes.find("<img src=x"), std::string::npos) << file;
      EXPECT_EQ(bytes.find("]]> --> </svg>"), std::string::npos) << file;
    }
  }
  EXPECT_FALSE(fs::exists("/tmp/mapproof-escaped"));
  const std::string svg = read_file(folder / "map" / "figures" / "map.svg");
  EXPECT_NE(svg.find("&lt;script&gt;document.title="), std::string::npos);
  const std::string html = read_file(folder / "map" / "report.html");
  EXPECT_NE(html.find("&lt;script&gt;document.title="), std::string::npos);
  EXPECT_NE(html.find("{{title}}"), std::string::npos);
}

TEST(HostileNames, InFileNamesAndOptionsComeBackAsOneHarmlessLine) {
  const TemporaryFolder folder;
  const Outcome outcome = mapproof(
      {"map", folder / "no\n\x1B[31mred\u202E.csv", "--sensor", "range", "--out", folder / "x"});
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_EQ(std::ranges::count(outcome.error, '\n'), 1) << outcome.error;
  EXPECT_EQ(outcome.error.find('\x1B'), std::string::npos);
}

}  // namespace
}  // namespace mapproof::test
