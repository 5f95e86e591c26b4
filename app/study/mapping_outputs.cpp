#include <fmt/format.h>

#include "app/result_json.hpp"
#include "app/study/folder_report.hpp"
#include "app/study/study_outputs.hpp"
#include "core/base/text/number_text.hpp"
#include "core/records/studies/study_store.hpp"
#include "reports/model/format.hpp"
#include "reports/sections/method_summary.hpp"
#include "reports/sections/study_counts.hpp"
#include "reports/sections/study_figures.hpp"
#include "reports/sections/study_report.hpp"

namespace mapproof {
namespace {

namespace fs = std::filesystem;

FolderReport mapping_report(const fs::path& folder, const std::string& command) {
  const Study study = read_study(folder);
  const std::vector<Timing> timings = read_timings(folder);
  const StudyFigures figures =
      study_figures(study, timings,
                    {.maps = [&](const RunId& run) { return read_maps(folder, run); },
                     .details = [&](const RunId& run) { return read_details(folder, run); }});
  const std::vector<Session> sessions = read_sessions(folder);
  FolderReport report{.folder = folder,
                      .report = study_report({.study = study,
                                              .sessions = sessions,
                                              .timings = timings,
                                              .figures = figures,
                                              .command = command}),
                      .group = "Map building",
                      .runs = study.runs.size(),
                      .incomplete = mapping_incomplete(study)};
  add_images(figures, report);
  report.in_company = report.report.sections;
  return report;
}

/// Calls `use` with the best setting of each method and sensor at its last checkpoint.
template <typename Use>
void for_each_result(const Study& study, Use use) {
  for (const SensorStudy& sensor : study.experiment.sensors)
    for (const SettingSummary& summary :
         best_of_each_method(summarize(study, sensor, last_step(sensor))))
      use(summary);
}

nlohmann::ordered_json number(const std::optional<MeanEstimate>& estimate) {
  return estimate ? nlohmann::ordered_json(estimate->mean) : nlohmann::ordered_json(nullptr);
}

nlohmann::ordered_json mapping_object(const Study& study) {
  const StudyCounts counts = count(study);
  nlohmann::ordered_json object{{"experiment", study.experiment.name},
                                {"seed", study.experiment.seed},
                                {"runs", study.runs.size()},
                                {"records", counts.maps},
                                {"records_with_status", counts.with_status},
                                {"records_without_map", counts.failed},
                                {"results", nlohmann::ordered_json::array()}};
  for_each_result(study, [&](const SettingSummary& result) {
    object["results"].push_back({{"sensor", name(result.sensor)},
                                 {"method", info(result.setting.method).name},
                                 {"parameter", parameter_json(result.setting)},
                                 {"step", result.step},
                                 {"mpe_m", number(result.mpe_m)},
                                 {"moe_percent", number(result.moe_percent)}});
  });
  return object;
}

std::string mapping_text(const Study& study) {
  std::string text;
  for_each_result(study, [&](const SettingSummary& result) {
    text += fmt::format("{:<10}  {:<28}", name(result.sensor), label(result.setting));
    text += result.mpe_m && result.moe_percent
                ? fmt::format("  MPE {}  MOE {:5.2f} %\n", error_text(result.mpe_m->mean),
                              result.moe_percent->mean)
                : std::string("  no map\n");
  });
  return text;
}

StudyNumbers mapping_numbers(const fs::path& folder) {
  const Study study = read_study(folder);
  return {.text = mapping_text(study), .object = mapping_object(study)};
}

}  // namespace

const StudyOutputs kMappingOutputs = {
    .study = "mapproof.study", .report = mapping_report, .numbers = mapping_numbers};

}  // namespace mapproof
