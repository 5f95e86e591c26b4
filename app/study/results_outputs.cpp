#include <algorithm>
#include <map>
#include <string>
#include <utility>

#include "app/study/folder_report.hpp"
#include "app/study/study_outputs.hpp"
#include "core/records/studies/results_study_json.hpp"
#include "core/records/studies/study_store.hpp"
#include "core/score/trajectory_error.hpp"
#include "reports/sections/opening.hpp"
#include "reports/sections/results/given_figures.hpp"
#include "reports/sections/results/path_error_figures.hpp"
#include "reports/sections/results/results_figures.hpp"
#include "reports/sections/results/results_report.hpp"

namespace mapproof {
namespace {

/// The folder's paths, aligned to their ground truths as study.json asks.
std::vector<GivenPath> aligned_paths(const std::filesystem::path& folder) {
  std::vector<GivenPath> paths = read_given_paths(folder);
  for (GivenPath& path : paths) {
    if (path.alignment == Alignment::kNone) continue;
    SlamEstimate estimate;
    estimate.path = path.path;
    const auto map = path_alignment(path.path, *path.ground_truth, path.alignment);
    if (const auto error =
            trajectory_error(estimate, *path.ground_truth, std::nullopt, path.alignment))
      path.rms_m = error->rmse_m;
    if (map) path.path.positions_m = (*map)(path.path.positions_m);
  }
  return paths;
}

/// About study.json, maps/ and paths/.
std::vector<std::string> file_remarks(const ResultsStudy& study,
                                      const std::filesystem::path& folder) {
  std::vector<std::string> remarks;
  for (const std::string& remark : label_remarks_of(study))
    remarks.push_back("In study.json, " + remark + ".");
  for (const std::string& remark : passed_over_files(folder)) remarks.push_back(remark + ".");
  return remarks;
}

/// What the results are judged against: as study.json states, else the ground truths beside the
/// table; empty if there are none.
std::string compared_words(const ResultsStudy& study, const std::vector<MapRecord>& maps,
                           const std::vector<GivenPath>& paths,
                           const std::vector<PathErrors>& errors) {
  if (!study.compared_with.empty()) return study.compared_with;
  const auto known = [](const auto& ground_truth) { return ground_truth.has_value(); };
  const bool has_ground_truth = !errors.empty() ||
                                std::ranges::any_of(maps, known, &MapRecord::ground_truth_m) ||
                                std::ranges::any_of(paths, known, &GivenPath::ground_truth);
  if (!has_ground_truth) return "";
  return study.methods.size() > 1 ? "the ground truth, and each other" : "the ground truth";
}

FolderReport table_report(const std::filesystem::path& folder, const std::string& command) {
  const ResultsStudy study = read_results_study(folder);
  const ResultsView view(study);
  const std::vector<MethodComparison> comparisons = compare_methods(view);
  StudyFigures figures = results_figures(view, comparisons);
  const std::vector<MapRecord> maps = read_given_maps(folder);
  const std::vector<GivenPath> paths = aligned_paths(folder);
  FigureGroup given = given_figures(study, maps, paths);
  if (!given.empty()) figures.groups.push_back(std::move(given));
  const std::vector<PathErrors> errors = read_path_errors(folder);
  for (FigureGroup& group : path_error_figures(study, errors))
    figures.groups.push_back(std::move(group));
  std::map<std::string, long long> poses;
  for (const PathErrors& one : errors) poses[one.method] += one.poses.size();
  const ResultsReportInput input{.view = view,
                                 .comparisons = comparisons,
                                 .figures = figures,
                                 .provenance = given_provenance(view, command),
                                 .compared_with = compared_words(study, maps, paths, errors),
                                 .remarks = file_remarks(study, folder),
                                 .poses = std::move(poses),
                                 .date = date_of(read_sessions(folder))};
  FolderReport result{.folder = folder,
                      .origin = StudyOrigin::kTable,
                      .report = results_report(input),
                      .in_company = results_sections(input),
                      .group = study.title,
                      .runs = view.runs()};
  add_images(figures, result);
  return result;
}

}  // namespace

const StudyOutputs kTableOutputs = {
    .study = kResultsStudy, .report = table_report, .numbers = nullptr};

}  // namespace mapproof
