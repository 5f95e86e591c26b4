#include "app/slam_outputs.hpp"

#include "core/records/slam_store.hpp"
#include "core/records/study_store.hpp"
#include "reports/sections/slam/slam_figures.hpp"
#include "reports/sections/slam/slam_report.hpp"

namespace mapproof {

FolderReport slam_folder_report(const std::filesystem::path& folder, const std::string& command) {
  return slam_folder_report(folder, read_slam_study(folder), read_slam_timings(folder),
                            read_sessions(folder), command);
}

FolderReport slam_folder_report(const std::filesystem::path& folder, const SlamStudy& study,
                                const SlamTimings& timings, std::span<const Session> sessions,
                                const std::string& command) {
  const StudyFigures figures = slam_figures(study, timings);
  const SlamReportInput input{.study = study,
                              .sessions = sessions,
                              .timings = timings,
                              .figures = figures,
                              .command = command};
  FolderReport result{.folder = folder,
                      .report = slam_report(input),
                      .in_company = slam_sections(input),
                      .figures = {},
                      .scenes = {},
                      .films = {},
                      .runs = study.runs.size(),
                      .missing = study.missing};
  for (const Figure* figure : all_figures(figures)) result.figures.push_back(*figure);
  for (const Scene* scene : all_scenes(figures)) result.scenes.push_back(*scene);
  for (const Film* film : all_films(figures)) result.films.push_back(*film);
  return result;
}

}  // namespace mapproof
