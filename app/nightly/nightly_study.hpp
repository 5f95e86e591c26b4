#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "app/console.hpp"
#include "app/nightly/tested_commit.hpp"
#include "app/study/study_request.hpp"
#include "app/study/study_run.hpp"
#include "core/results/quantity.hpp"
#include "reports/history/nightly_run.hpp"

namespace mapproof {

/// What a nightly run is asked to make.
struct NightlyInput {
  /// Names of embedded ones, files, folders of results, or a results.csv.
  std::vector<std::string> experiments = {};
  std::vector<std::string> metrics = {};      ///< Files of metrics.
  /// Of metrics and tables that do not say which way they improve.
  std::optional<Better> better = {};
  StudyOptions options = {};  ///< Its profile is taken of the experiments that have it.
};

/// What is to be made, and what was measured.
struct NightlyRequests {
  std::vector<StudyRequest> studies = {};
  TestedCommit commit = {};  ///< What a file of metrics says; empty: none does.
  std::vector<std::string> remarks = {};
};

/// Reads what is asked for, all of it before anything is made.
/// @throws IoError, InvalidInput: among others if two have one name, or if there is nothing.
NightlyRequests read_nightly_requests(const NightlyInput& input, const Disclosure& disclosure);

/// What the studies of a nightly run will be, before they are made: names and what they are
/// compared by.
std::vector<NightlyStudy> planned_studies(const std::vector<StudyRequest>& requests);

/// What each study is, from its records in the folder of a nightly run. @throws IoError.
std::vector<NightlyStudy> read_nightly_studies(const std::vector<StudyRequest>& requests,
                                               const std::filesystem::path& folder);

/// Makes the records of a study in a process of its own, so that the peak of its memory is its own
/// and its crash is its own.
/// @param of  What a failure means, put before its line: "nightly run 3 is not recorded: ".
/// @return The ExitCode of that process, kInternal if a signal ended it. @throws IoError.
int make_apart(const StudyRequest& request, const std::filesystem::path& folder, int jobs,
               const SessionNames& names, const Console& console, const std::string& of);

/// A file of metrics as a study.
struct MetricsRequest {
  StudyRequest study = {};
  TestedCommit commit = {};  ///< What the file says was measured; empty: nothing.
  std::vector<std::string> remarks = {};
};

/// Reads a file of metrics (see parse_metrics()). The study is named by the file itself, else by its
/// name, and is the same one whatever metrics come and go.
/// @throws IoError, InvalidInput.
MetricsRequest read_metrics_request(const std::string& file, std::optional<Better> better);

/// What `git bisect run` asks of a commit.
struct BisectTask {
  std::filesystem::path store;
  int since = 0;  ///< The nightly run in which the regression began.
  int jobs = 1;
  SessionNames names;
};

/// Makes the studies in a folder that is removed again, and compares what got worse in nightly run
/// `since` with it and with the nightly run before: the value that is nearer decides. Nothing is
/// recorded.
/// @return kDone if all are nearer to the values before, kNo if one is nearer to those that got
///         worse, kCannotTest if a study was not finished or nothing can be compared.
/// @throws IoError, InvalidInput.
int bisect(const NightlyRequests& requests, const BisectTask& task, const Console& console);

}  // namespace mapproof
