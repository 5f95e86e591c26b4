#include "app/nightly/nightly_study.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <memory>
#include <utility>

#include <fmt/format.h>

#include "app/failures.hpp"
#include "app/study/study_run.hpp"
#include "core/base/child_process.hpp"
#include "core/base/errors.hpp"
#include "core/base/files/files.hpp"
#include "core/base/files/output_folder.hpp"
#include "core/base/files/paths.hpp"
#include "core/base/files/temporary_folder.hpp"
#include "core/base/sha256.hpp"
#include "core/base/text/slug.hpp"
#include "core/records/metrics/metrics_json.hpp"
#include "core/records/studies/results_study_json.hpp"
#include "core/records/studies/results_table.hpp"
#include "core/records/studies/study_folder.hpp"
#include "reports/history/finding_groups.hpp"
#include "reports/history/history_store.hpp"
#include "reports/history/judge_nightly_run.hpp"
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

/// A table of results without a study.json: the file that is given, or that of the folder. Empty if
/// there is none.
fs::path lone_table(const fs::path& given) {
  std::error_code error;
  if (!fs::is_directory(given, error)) return given.extension() == ".csv" ? given : fs::path();
  const fs::path table = given / kResultsFile;
  return !is_study(given) && fs::exists(table, error) ? table : fs::path();
}

/// Of a file's name what a study's name may hold; `other` in front if it begins with no letter.
std::string name_from(const std::string& stem, const std::string& other) {
  std::string name = slug_of(stem);
  if (name.empty() || name.front() < 'a') name = other + (name.empty() ? "" : "-" + name);
  return name;
}

/// Declares the quantities of a table that the dictionary lacks: without a unit, under their ids.
/// @throws IoError where it is not known which way they improve, or an id cannot be one.
void declare_quantities(const std::string& file, std::optional<Better> better,
                        ResultsStudy& study) {
  for (const std::string& id : quantities_in(file)) {
    if (find_quantity(id) != nullptr || id.empty()) continue;
    const Quantity quantity{.id = id, .label = id, .better = better.value_or(Better::kNeither)};
    if (const std::string problem = problem_of(quantity); !problem.empty())
      throw IoError(file, problem);
    if (!better)
      throw IoError(file, fmt::format("the quantity \"{}\" is not one of mapproof's: add --better "
                                      "lower or higher, or a study.json that declares it",
                                      printable(id, 40)));
    study.results.quantities.declare(study_quantity(id, id, "", *better));
    study.quantities.push_back(id);
  }
}

/// The request to take a table of results as a study, whose rows it holds. It is named by its file,
/// or by its folder if it is called results.csv, and is the same study whatever rows come and go.
/// @throws IoError.
StudyRequest table_request(const fs::path& file, std::optional<Better> better) {
  const std::string source = file.string();
  ResultsStudy study;
  declare_quantities(source, better, study);
  const fs::path path = real_path(file);
  auto rows = std::make_shared<std::vector<Result>>();
  const std::string digest =
      read_unchanged(file, [&] { *rows = read_results_csv(file, study.results.quantities); });
  if (rows->empty()) throw IoError(source, "has no row");
  const bool is_plain = file.filename() == kResultsFile;
  study.name = name_from(is_plain ? path.parent_path().filename().string() : path.stem().string(),
                         std::string(kNamelessResults));
  study.title = study.name;
  study.question = "Numbers of another program.";
  study.results.are_repeats = true;
  return {.name = study.name,
          .digest = digest,
          .texts = {{kStudyFile, results_study_json(study)}},
          .table = std::move(rows),
          .compared_by = sha256_hex("table\n" + study.name)};
}

}  // namespace

NightlyRequests read_nightly_requests(const NightlyInput& input, const Disclosure& disclosure) {
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
    if (const fs::path table = lone_table(experiment); !table.empty()) {
      file = table.string();
      request = table_request(table, input.better);
    } else if (is_results_study(experiment)) {
      request = given_study_request(experiment);
    } else {
      const ExperimentText text = experiment_of(experiment);
      file = text.source;
      request = read_study_request(text, options, disclosure);
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
    studies.push_back(
        {.name = request.name,
         .experiment_digest = request.compared_by.empty()
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
               const SessionNames& names, const Console& console, const std::string& of) {
  const auto make = [&] { return make_study(request, folder, jobs, names, console), kDone; };
  try {
    // No thread runs yet that the copy would lack. A nightly run that is killed takes its study
    // with it: its locks are free at once.
    ChildProcess process([&] { return exit_code_of(make, of + request.name + ": "); });
    const ProcessEnd end = process.wait();
    if (end.signal == 0) return end.exit_code;
    return report_failure(fmt::format("{}{}: {}", of, request.name, end.text()), kInternal);
  } catch (const ProcessError& error) {
    throw IoError(folder.string(), error.what());
  }
}

namespace {

ResultsStudy study_of(const Metrics& metrics, const std::string& name) {
  ResultsStudy study;
  study.name = study.title = name;
  study.question = "Numbers of another program.";
  for (const Metric& metric : metrics.metrics) {
    const Quantity quantity = quantity_of(metric);
    study.results.quantities.declare(quantity);
    if (std::ranges::find(study.quantities, quantity.id) == study.quantities.end())
      study.quantities.push_back(quantity.id);
    study.results.rows.push_back({.at = Condition{.setup = metric.suite},
                                  .method = metric.name,
                                  .quantity = quantity.id,
                                  .value = metric.value});
  }
  return study;
}

}  // namespace

MetricsRequest read_metrics_request(const std::string& file, std::optional<Better> better) {
  const Metrics metrics = parse_metrics(read_file(file), file, better);
  MetricsRequest request{.commit = {metrics.commit, ""}};
  if (const std::string page = page_of_remote(metrics.repository); !page.empty())
    request.commit.repository = page;
  const ResultsStudy study =
      study_of(metrics, metrics.name.empty() ? name_from(fs::path(file).stem().string(), "metrics")
                                             : metrics.name);
  request.study.name = study.name;
  request.study.texts = {{kStudyFile, results_study_json(study)},
                         {kResultsFile, results_csv(study.results.rows)}};
  request.study.compared_by = sha256_hex("metrics\n" + study.name);
  request.study.digest =
      sha256_hex(request.study.texts.at(kStudyFile) + "\n" + request.study.texts.at(kResultsFile));
  const auto negative = std::ranges::find_if(metrics.metrics, [](const Metric& metric) {
    return metric.value < 0.0 && metric.better != Better::kNeither && metric.unit != "%";
  });
  if (negative != metrics.metrics.end())
    request.remarks.push_back(
        fmt::format("{}: \"{}\" is {}: values below 0 are shown and not judged, since metrics are "
                    "judged by ratio",
                    file, printable(negative->name, 40), negative->value));
  return request;
}

namespace {

/// What began in a nightly run, in whichever nightly run it was found.
std::vector<NightlyFinding> begun_in(HistoryStore& history, int since) {
  std::vector<NightlyFinding> all;
  for (const NightlyFacts& nightly_run : history.nightly_runs())
    if (nightly_run.number >= since)
      for (const NightlyFinding& finding : history.findings(nightly_run.number))
        if (finding.since == since) all.push_back(finding);
  return all;
}

/// The values of one series before, in which it got worse, and now.
struct Triple {
  double before, worse, now;

  bool is_known() const {
    return std::isfinite(before) && std::isfinite(worse) && std::isfinite(now) && before != worse;
  }
  bool is_worse() const { return std::abs(now - worse) < std::abs(now - before); }
};

double median_in(const Scores& scores, const SeriesId& id) {
  const auto found = scores.find(id);
  return found == scores.end() ? known_median({}) : known_median(found->second);
}

/// The series of a study that got worse.
std::vector<Triple> triples_of(HistoryStore& history, const NightlyStudy& study, int since,
                               const std::vector<NightlyFinding>& findings) {
  const StudyTrend trend = history.trend(study.name, study.experiment_digest, kTrendRuns, since);
  const int before = commits_of(trend, since).before.number;
  const Scores good = history.scores(before, study.name), bad = history.scores(since, study.name);
  std::vector<Triple> triples;
  for (const auto& [id, values] : study.scores) {
    const bool is_found = std::ranges::any_of(findings, [&](const NightlyFinding& finding) {
      return finding.study == study.name && finding.subject != kAllMethods && is_about(finding, id);
    });
    if (!is_found) continue;
    const Triple triple{median_in(good, id), median_in(bad, id), known_median(values)};
    if (triple.is_known()) triples.push_back(triple);
  }
  return triples;
}

}  // namespace

int bisect(const NightlyRequests& requests, const BisectTask& task, const Console& console) {
  HistoryStore history = HistoryStore::open_existing(task.store);
  const std::vector<NightlyFinding> findings = begun_in(history, task.since);
  if (findings.empty())
    throw InvalidInput(fmt::format("--bisect: nothing got worse in nightly run {}", task.since));
  const TemporaryFolder folder("bisect");
  for (const StudyRequest& request : requests.studies)
    if (make_apart(request, folder.path() / request.name, task.jobs, task.names, console,
                   "this commit cannot be tested: ") != kDone)
      return kCannotTest;
  std::vector<Triple> all;
  for (const NightlyStudy& study : read_nightly_studies(requests.studies, folder.path()))
    std::ranges::move(triples_of(history, study, task.since, findings), std::back_inserter(all));
  if (all.empty()) {
    console.warning(
        fmt::format("--bisect: no value of what got worse in nightly run {} is here: "
                    "this commit cannot be tested",
                    task.since));
    return kCannotTest;
  }
  const auto worse = std::ranges::count_if(all, &Triple::is_worse);
  console.result(fmt::format("{} of {} values that got worse in nightly run {} are worse here\n",
                             worse, all.size(), task.since),
                 {{"since", task.since}, {"values", all.size()}, {"worse", worse}});
  return worse == 0 ? kDone : kNo;
}

}  // namespace mapproof
