#include <utility>

#include "app/study_outputs.hpp"
#include "core/records/results_study_json.hpp"
#include "reports/sections/results/results_report.hpp"

namespace mapproof {
namespace {

FolderReport table_report(const std::filesystem::path& folder, const std::string& command) {
  const ResultsStudy study = read_results_study(folder);
  const ResultsView view(study);
  const std::vector<MethodComparison> comparisons = compare_methods(view);
  StudyFigures figures = results_figures(view, comparisons);
  FigureGroup given = given_figures(study, read_given_maps(folder), read_given_paths(folder));
  if (!given.empty()) figures.groups.push_back(std::move(given));
  const ResultsReportInput input{
      .view = view, .comparisons = comparisons, .figures = figures, .command = command};
  FolderReport result{.folder = folder,
                      .of_paper = false,
                      .report = results_report(input),
                      .in_company = results_sections(input),
                      .runs = view.runs()};
  add_pictures(figures, result);
  return result;
}

}  // namespace

const StudyOutputs kTableOutputs = {
    .study = kResultsStudy, .report = table_report, .numbers = nullptr};

}  // namespace mapproof
