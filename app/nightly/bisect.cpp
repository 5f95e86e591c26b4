#include "app/nightly/bisect.hpp"

#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstring>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "core/base/errors.hpp"
#include "core/base/files/output_folder.hpp"
#include "reports/history/finding_groups.hpp"
#include "reports/history/history_store.hpp"
#include "reports/history/judge_nightly_run.hpp"

namespace mapproof {
namespace {

namespace fs = std::filesystem;

/// A folder that is removed with all that is in it.
class PassingFolder {
 public:
  PassingFolder() {
    std::string name = (fs::temp_directory_path() / "mapproof-bisect-XXXXXX").string();
    if (::mkdtemp(name.data()) == nullptr) throw IoError(name, std::strerror(errno));
    path_ = name;
  }
  ~PassingFolder() {
    std::error_code error;
    fs::remove_all(path_, error);
  }
  PassingFolder(const PassingFolder&) = delete;
  PassingFolder& operator=(const PassingFolder&) = delete;
  const fs::path& path() const { return path_; }

 private:
  fs::path path_;
};

/// What began in a nightly run, in whichever nightly run it was found.
std::vector<NightlyFinding> begun_in(HistoryStore& history, int since) {
  std::vector<NightlyFinding> all;
  for (const NightlyFacts& nightly_run : history.nightly_runs())
    if (nightly_run.number >= since)
      for (const NightlyFinding& finding : history.findings(nightly_run.number))
        if (finding.since == since) all.push_back(finding);
  return all;
}

bool is_about(const NightlyFinding& finding, const SeriesId& id) {
  return id.quantity == finding.quantity &&
         (finding.subject == method_of(id) || finding.subject.starts_with(method_of(id) + ", "));
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
      return finding.study == study.name && is_about(finding, id);
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
  const PassingFolder folder;
  for (const StudyRequest& request : requests.studies)
    if (make_apart(request, folder.path() / request.name, task.jobs, task.names, console) != kDone) {
      console.warning(request.name + ": was not finished: this commit cannot be tested");
      return kCannotTest;
    }
  std::vector<Triple> all;
  for (const NightlyStudy& study : read_nightly_studies(requests.studies, folder.path()))
    std::ranges::move(triples_of(history, study, task.since, findings), std::back_inserter(all));
  if (all.empty()) {
    console.warning(fmt::format("--bisect: no value of what got worse in nightly run {} is here: "
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
