#include "app/study_outputs.hpp"

#include "core/records/study_store.hpp"
#include "reports/sections/study_report.hpp"

namespace mapproof {
namespace {

/// As it stands within a sentence; names in capitals stay.
std::string lower_first(std::string text) {
  const bool is_word = text.size() > 1 && text[1] >= 'a' && text[1] <= 'z';
  if (is_word && text[0] >= 'A' && text[0] <= 'Z') text[0] = static_cast<char>(text[0] - 'A' + 'a');
  return text;
}

}  // namespace

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
                      .in_company = {},
                      .figures = {},
                      .scenes = {},
                      .films = {},
                      .runs = view.study.runs.size(),
                      .missing = {}};
  for (const Figure* figure : all_figures(view.figures)) report.figures.push_back(*figure);
  for (const Scene* scene : all_scenes(view.figures)) report.scenes.push_back(*scene);
  for (const Film* film : all_films(view.figures)) report.films.push_back(*film);
  report.in_company = report.report.sections;
  for (Section& section : report.in_company)
    section.title = "Map building: " + lower_first(section.title);
  return report;
}

}  // namespace mapproof
