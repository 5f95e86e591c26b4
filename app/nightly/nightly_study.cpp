#include "app/nightly/nightly_study.hpp"

#include <algorithm>
#include <iterator>
#include <map>
#include <utility>

#include <fmt/format.h>

#include "app/failures.hpp"
#include "app/nightly/metrics_request.hpp"
#include "app/study/study_run.hpp"
#include "core/base/child_process.hpp"
#include "core/base/errors.hpp"
#include "core/base/files/output_folder.hpp"
#include "core/records/studies/results_study_json.hpp"
#include "core/records/studies/study_folder.hpp"
#include "reports/history/nightly_scores.hpp"

namespace mapproof {

namespace fs = std::filesystem;

namespace {

/// Two studies of a nightly run that share their name would share their folder and their history.
/// @throws InvalidInput.
[[noreturn]] void refuse_same_name(const StudyRequest& request, const std::string& first,
                                   const std::string& second) {
  if (first == second) throw InvalidInput(printable(first) + ": is given twice");
  const bool may_be_left_out = !request.given.empty() && request.name == kNamelessResults;
  throw InvalidInput(fmt::format(
      "{} and {}: both studies have the name \"{}\"{}; add a \"name\" of its own to one of them",
      printable(first), printable(second), printable(request.name),
      may_be_left_out ? ", which is that of a study.json without one" : ""));
}

}  // namespace

NightlyRequests read_nightly_requests(const NightlyInput& input) {
  StudyOptions options = input.options;
  options.profile_if_there = options.one_of_several = true;
  NightlyRequests all;
  std::vector<StudyRequest>& requests = all.studies;
  std::map<std::string, std::string> files;  // By the study's name.
  const auto add = [&](StudyRequest request, const std::string& file) {
    const auto [other, is_new] = files.try_emplace(request.name, file);
    if (!is_new) refuse_same_name(request, other->second, file);
    requests.push_back(std::move(request));
  };
  for (const std::string& experiment : input.experiments) {
    refuse_links_out(experiment);  // Of the folder of a study of results.
    StudyRequest request;
    std::string file = (fs::path(experiment) / kStudyFile).string();
    if (is_results_study(experiment)) {
      request = given_study_request(experiment);
    } else {
      const ExperimentText text = experiment_of(experiment);
      file = text.source;
      request = read_study_request(text, options);
    }
    add(std::move(request), file);
  }
  check_data_used(requests, options);
  for (const std::string& file : input.metrics) {
    MetricsRequest metrics = read_metrics_request(file, input.better);
    if (!metrics.commit.id.empty()) all.commit = metrics.commit;
    std::ranges::move(metrics.remarks, std::back_inserter(all.remarks));
    add(std::move(metrics.study), file);
  }
  if (requests.empty())
    throw InvalidInput("there is nothing to run: name an EXPERIMENT, or a file with --metrics");
  return all;
}

std::vector<NightlyStudy> planned_studies(const std::vector<StudyRequest>& requests) {
  std::vector<NightlyStudy> studies;
  for (const StudyRequest& request : requests)
    studies.push_back({.name = request.name,
                       .experiment_digest =
                           request.compared_by.empty()
                               ? experiment_digest(study_json(request), request.name)
                               : request.compared_by});
  return studies;
}

std::vector<NightlyStudy> read_nightly_studies(const std::vector<StudyRequest>& requests,
                                               const fs::path& folder) {
  std::vector<NightlyStudy> studies;
  for (const StudyRequest& request : requests) {
    studies.push_back(read_nightly_study(folder / request.name, request.name));
    if (!request.compared_by.empty()) studies.back().experiment_digest = request.compared_by;
  }
  return studies;
}

int make_apart(const StudyRequest& request, const fs::path& folder, int jobs,
               const SessionNames& names, const Console& console) {
  const auto make = [&] { return make_study(request, folder, jobs, names, console), kDone; };
  try {
    // No thread runs yet that the copy would lack. A nightly run that is killed takes its study
    // with it: its locks are free at once.
    ChildProcess process([&] { return exit_code_of(make, request.name + ": "); });
    const ProcessEnd end = process.wait();
    if (end.signal == 0) return end.exit_code;
    return report_failure(fmt::format("{}: {}", request.name, end.text()), kInternal);
  } catch (const ProcessError& error) {
    throw IoError(folder.string(), error.what());
  }
}

}  // namespace mapproof
