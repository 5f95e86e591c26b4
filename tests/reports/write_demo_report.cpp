// Writes the report of a synthetic study into a folder, for a person to look at:
//   write_demo_report FOLDER
#include <cstdio>
#include <exception>
#include <map>

#include "core/base/files.hpp"
#include "render/output/write_figure.hpp"
#include "reports/html/report_html.hpp"
#include "reports/sections/study_report.hpp"
#include "reports/tables/write_tables.hpp"
#include "tests/reports/synthetic_study.hpp"

namespace mapproof::test {
namespace {

void write_demo(const std::filesystem::path& folder) {
  const Study study = synthetic_study();
  const StudyFigures figures = synthetic_figures(study);
  std::map<std::string, std::string> drawings;
  for (const Figure* figure : all_figures(figures))
    drawings[figure->id] = write_figure(*figure, report_theme(), folder / "figures");
  const auto sessions = synthetic_sessions();
  const auto timings = synthetic_timings(study);
  const Report report = study_report(
      {study, sessions, timings, figures, "mapproof run yairi2007 --out out --seed 2007"});
  write_tables(report, folder / "tables");
  write_file(
      folder / "report.html",
      report_html(report, load_templates(), [&](const std::string& id) { return drawings[id]; }));
}

}  // namespace
}  // namespace mapproof::test

int main(int count, char** arguments) {
  if (count != 2) {
    std::fputs("usage: write_demo_report FOLDER\n", stderr);
    return 2;
  }
  try {
    mapproof::test::write_demo(arguments[1]);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
}
