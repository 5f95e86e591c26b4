// Writes the reports of two synthetic studies into a folder and its folder slam, for a person to
// look at:
//   write_demo_report FOLDER
#include <cstdio>
#include <exception>
#include <map>

#include "core/base/files/files.hpp"
#include "render/output/write_figure.hpp"
#include "reports/html/report_html.hpp"
#include "reports/sections/slam/slam_report.hpp"
#include "reports/sections/study_report.hpp"
#include "reports/tables/write_tables.hpp"
#include "tests/reports/synthetic_study.hpp"
#include "tests/support/samples/sample_slam.hpp"

namespace mapproof::test {
namespace {

using Drawings = std::map<std::string, std::string>;

Drawings draw(const StudyFigures& figures, const std::filesystem::path& folder) {
  Drawings drawings;
  for (const Figure* figure : all_figures(figures))
    drawings[figure->id] = write_figure(*figure, report_theme(), folder / "figures");
  return drawings;
}

void write(const Report& report, Drawings drawings, const std::filesystem::path& folder) {
  write_tables(report, folder / "tables");
  write_file(
      folder / "report.html",
      report_html(report, load_templates(), [&](const std::string& id) { return drawings[id]; }));
}

void write_demo(const std::filesystem::path& folder) {
  const Study study = synthetic_study();
  const StudyFigures figures = synthetic_figures(study);
  const auto sessions = synthetic_sessions();
  const auto timings = synthetic_timings(study);
  write(study_report(
            {study, sessions, timings, figures, "mapproof run yairi2007 --out out --seed 2007"}),
        draw(figures, folder), folder);

  const SlamStudy slam = sample_slam_study();
  const SlamTimings slam_timings = sample_slam_timings();
  const StudyFigures slam_drawn = slam_figures(slam, slam_timings);
  write(slam_report(
            {slam, sessions, slam_timings, slam_drawn, "mapproof reproduce boots2013 --out out"}),
        draw(slam_drawn, folder / "slam"), folder / "slam");
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
