#include "app/results_outputs.hpp"

#include <utility>

#include "core/records/results_study_json.hpp"
#include "reports/sections/results/results_report.hpp"

namespace mapproof {

FolderReport results_folder_report(const std::filesystem::path& folder,
                                   const std::string& command) {
  const ResultsStudy study = read_results_study(folder);
  const ResultsView view(study);
  const std::vector<MethodComparison> comparisons = compare_methods(view);
  StudyFigures figures = results_figures(view, comparisons);
  FigureGroup given = given_figures(study, read_given_maps(folder), read_given_paths(folder));
  if (!given.empty()) figures.groups.push_back(std::move(given));
  const ResultsReportInput input{.view = view,
                                 .comparisons = comparisons,
                                 .figures = figures,
                                 .provenance = given_provenance(view, command)};
  FolderReport result{.folder = folder,
                      .of_paper = false,
                      .report = results_report(input),
                      .in_company = results_sections(input),
                      .figures = {},
                      .scenes = {},
                      .films = {},
                      .runs = view.runs(),
                      .missing = {}};
  for (const Figure* figure : all_figures(figures)) result.figures.push_back(*figure);
  return result;
}

}  // namespace mapproof
