#include <cstdlib>
#include <sstream>

#include <gtest/gtest.h>

#include "core/base/files/files.hpp"
#include "render/plot/figure_json.hpp"
#include "render/plot/layout.hpp"
#include "tests/support/images/figure_checks.hpp"
#include "tests/support/images/figure_rules.hpp"
#include "tests/support/program.hpp"

namespace mapproof::test {
namespace {

namespace fs = std::filesystem;

void add_figures(const fs::path& folder, std::vector<Figure>& figures) {
  std::vector<fs::path> paths;
  for (const auto& entry : fs::recursive_directory_iterator(folder))
    if (entry.path().string().ends_with(".figure.json")) paths.push_back(entry.path());
  std::ranges::sort(paths);
  for (const fs::path& path : paths)
    figures.push_back(figure_from_json(read_file(path.string()), path.string()));
}

/// The figures of all studies that need no data of others, in their quick profiles; those of the
/// folders in MAPPROOF_STUDIES instead, if it is set, separated by colons.
std::vector<Figure> all_figures() {
  std::vector<Figure> figures;
  if (const char* folders = std::getenv("MAPPROOF_STUDIES")) {
    std::istringstream rest(folders);
    for (std::string folder; std::getline(rest, folder, ':');) add_figures(folder, figures);
    return figures;
  }
  const TemporaryFolder folder;
  for (const char* experiment : {"yairi2007", "boots2013", "extensions"}) {
    const fs::path out = folder / experiment;
    EXPECT_EQ(mapproof({"reproduce", experiment, "--profile", "quick", "--out", out}).exit_code, 0);
    add_figures(out, figures);
  }
  return figures;
}

void expect_clean(const Figure& figure, const Theme& theme) {
  for (const std::string& rule : broken_rules(figure, theme))
    ADD_FAILURE() << figure.id << ", " << rule;
  for (const std::string& flaw : flaws(lay_out(figure, theme)))
    ADD_FAILURE() << figure.id << ", " << theme.name << ": " << flaw;
}

/// One test: its studies take minutes.
TEST(EveryFigureOfEveryStudy, KeepsTheRulesAndShowsAMethodInOneStyleThatNoOtherHas) {
  const std::vector<Figure> figures = all_figures();
  EXPECT_GT(figures.size(), 100U);
  MethodStyles styles;
  for (const Figure& figure : figures) {
    styles.see(figure);
    for (const Theme& theme : {report_theme(), dark_theme(), paper_theme(3.25)})
      expect_clean(figure, theme);
  }
  for (const std::string& conflict : styles.conflicts()) ADD_FAILURE() << conflict;
}

}  // namespace
}  // namespace mapproof::test
