#include "app/study/study_outputs.hpp"

#include <fmt/format.h>

#include "app/slam/slam_json.hpp"
#include "app/study/folder_report.hpp"
#include "core/records/studies/slam_store.hpp"
#include "core/records/studies/study_store.hpp"
#include "reports/sections/slam/slam_text.hpp"

namespace mapproof {
namespace {

namespace fs = std::filesystem;

FolderReport range_report(const fs::path& folder, const std::string& command) {
  return slam_folder_report(folder, read_slam_study(folder), read_slam_timings(folder),
                            read_sessions(folder), command);
}

nlohmann::ordered_json range_object(const SlamStudy& study) {
  nlohmann::ordered_json object{{"experiment", study.experiment.name},
                                {"seed", study.experiment.seed},
                                {"runs", study.runs.size()},
                                {"missing", missing_logs(study)},
                                {"results", nlohmann::ordered_json::array()}};
  for (const SlamRun& run : study.runs)
    for (const SlamRecord& record : run.records) {
      nlohmann::ordered_json result{{"run", run.id}, {"method", info(record.method).name}};
      put_slam_errors(result, record);
      object["results"].push_back(std::move(result));
    }
  return object;
}

std::string range_text(const SlamStudy& study) {
  std::string text;
  for (const SlamRun& run : study.runs)
    for (const SlamRecord& record : run.records)
      text += fmt::format("{:<10}  {}\n", run.id, slam_record_text(record));
  return text;
}

StudyNumbers range_numbers(const fs::path& folder) {
  const SlamStudy study = read_slam_study(folder);
  return {.text = range_text(study), .object = range_object(study), .missing = missing_logs(study)};
}

}  // namespace

const StudyOutputs kRangeOutputs = {
    .study = "mapproof.slam_study", .report = range_report, .numbers = range_numbers};

}  // namespace mapproof
