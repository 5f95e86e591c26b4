#include "app/result_json.hpp"
#include "app/study_outputs.hpp"
#include "core/records/study_store.hpp"
#include "core/trials/run_trials.hpp"
#include "reports/sections/trials/trial_figures.hpp"
#include "reports/sections/trials/trial_means.hpp"
#include "reports/sections/trials/trial_report.hpp"

namespace mapproof {
namespace {

nlohmann::ordered_json trial_object(const TrialStudy& study) {
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

std::string trial_text(const TrialStudy& study) {
  std::string text;
  for (const std::string& conclusion : study.conclusions) text += conclusion + "\n";
  return text;
}

FolderReport trials_report(const std::filesystem::path& folder, const std::string& command) {
  const TrialStudy study = read_concluded_study(folder);
  const std::vector<Session> sessions = read_sessions(folder);
  const StudyFigures figures = trial_figures(study);
  const TrialReportInput input{
      .study = study, .sessions = sessions, .figures = figures, .command = command};
  FolderReport result{.folder = folder,
                      .of_paper = false,
                      .report = trial_report(input),
                      .in_company = trial_sections(input),
                      .runs = study.parts.size()};
  add_pictures(figures, result);
  return result;
}

StudyNumbers trial_numbers(const std::filesystem::path& folder) {
  const TrialStudy study = read_concluded_study(folder);
  return {.text = trial_text(study), .object = trial_object(study)};
}

}  // namespace

const StudyOutputs kTrialOutputs = {
    .study = "mapproof.trial_study", .report = trials_report, .numbers = trial_numbers};

}  // namespace mapproof
