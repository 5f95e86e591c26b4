#include "app/study_outputs.hpp"

#include "core/records/study_store.hpp"
#include "reports/sections/study_report.hpp"

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

FolderReport study_folder_report(const StudyView& view, const std::string& command) {
  const std::vector<Session> sessions = read_sessions(view.folder);
  FolderReport report{.folder = view.folder,
                      .report = study_report({.study = view.study,
                                              .sessions = sessions,
                                              .timings = view.timings,
                                              .figures = view.figures,
                                              .command = command}),
                      .figures = {},
                      .runs = view.study.runs.size(),
                      .missing = {}};
  for (const Figure* figure : all_figures(view.figures)) report.figures.push_back(*figure);
  return report;
}

}  // namespace mapproof
