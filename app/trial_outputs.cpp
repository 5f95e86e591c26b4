#include "app/trial_outputs.hpp"

#include "app/result_json.hpp"
#include "core/records/study_store.hpp"
#include "core/trials/run_trials.hpp"
#include "reports/sections/trials/trial_figures.hpp"
#include "reports/sections/trials/trial_means.hpp"
#include "reports/sections/trials/trial_report.hpp"

namespace mapproof {

nlohmann::ordered_json trial_study_result(const TrialStudy& study) {
  nlohmann::ordered_json object{
      {"experiment", study.experiment.name}, {"topic", study.experiment.topic},
      {"seed", study.experiment.seed},       {"parts", study.parts.size()},
      {"conclusions", study.conclusions},    {"results", nlohmann::ordered_json::array()}};
  for (const TrialCell& cell : trial_cells(study)) {
    nlohmann::ordered_json result{
        {"setup", cell.setup}, {"series", cell.series}, {"level", cell.level}};
    if (!cell.part.empty()) result["part"] = cell.part;
    for (std::size_t i = 0; i < cell.means.size(); ++i)
      result[study.design.quantities[i].id] =
          cell.means[i] ? number_or_null(cell.means[i]->mean) : nlohmann::ordered_json(nullptr);
    object["results"].push_back(std::move(result));
  }
  return object;
}

std::string trial_study_text(const TrialStudy& study) {
  std::string text;
  for (const std::string& conclusion : study.conclusions) text += conclusion + "\n";
  return text;
}

FolderReport trial_folder_report(const std::filesystem::path& folder, const std::string& command) {
  const TrialStudy study = read_concluded_study(folder);
  const std::vector<Session> sessions = read_sessions(folder);
  const StudyFigures figures = trial_figures(study);
  const TrialReportInput input{
      .study = study, .sessions = sessions, .figures = figures, .command = command};
  FolderReport result{.folder = folder,
                      .of_paper = false,
                      .report = trial_report(input),
                      .in_company = trial_sections(input),
                      .figures = {},
                      .scenes = {},
                      .films = {},
                      .runs = study.parts.size(),
                      .missing = {}};
  for (const Figure* figure : all_figures(figures)) result.figures.push_back(*figure);
  return result;
}

}  // namespace mapproof
