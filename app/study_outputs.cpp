#include "app/study_outputs.hpp"

#include <tbb/global_control.h>
#include <tbb/parallel_for_each.h>

#include "core/base/files.hpp"
#include "core/records/study_store.hpp"
#include "render/output/write_figure.hpp"
#include "reports/html/report_html.hpp"
#include "reports/sections/study_report.hpp"
#include "reports/tables/write_tables.hpp"

namespace mapproof {

StudyView view_study(const std::filesystem::path& folder) {
  StudyView view{.folder = folder,
                 .study = read_study(folder),
                 .timings = read_timings(folder),
                 .figures = {}};
  view.figures =
      study_figures(view.study, view.timings,
                    {.maps = [&](const RunId& run) { return read_maps(folder, run); },
                     .details = [&](const RunId& run) { return read_details(folder, run); }});
  return view;
}

std::map<std::string, std::string> write_figures(const std::vector<const Figure*>& figures,
                                                 const Theme& theme,
                                                 const std::filesystem::path& folder, int jobs) {
  const tbb::global_control limit(tbb::global_control::max_allowed_parallelism,
                                  static_cast<std::size_t>(jobs));
  std::map<std::string, std::string> drawings;
  for (const Figure* figure : figures) drawings[figure->id];  // None is inserted in parallel.
  tbb::parallel_for_each(figures, [&](const Figure* figure) {
    drawings.at(figure->id) = write_figure(*figure, theme, folder);
  });
  return drawings;
}

std::filesystem::path write_report(const StudyView& view, const std::string& command,
                                   const Templates& page, int jobs) {
  const Theme theme = report_theme();
  const std::vector<const Figure*> figures = all_figures(view.figures);
  const std::map<std::string, std::string> drawings =
      write_figures(figures, theme, view.folder / "figures", jobs);

  const std::vector<Session> sessions = read_sessions(view.folder);
  const Report report = study_report({.study = view.study,
                                      .sessions = sessions,
                                      .timings = view.timings,
                                      .figures = view.figures,
                                      .command = command});
  write_tables(report, view.folder / "tables");

  const auto drawing = [&](const std::string& id) {
    const auto found = drawings.find(id);
    return found == drawings.end() ? std::string() : found->second;
  };
  const std::filesystem::path path = view.folder / "report.html";
  write_file(path, report_html(report, page, drawing));
  return path;
}

}  // namespace mapproof
