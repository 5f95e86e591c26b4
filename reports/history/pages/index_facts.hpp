#pragma once

#include <map>
#include <set>
#include <span>
#include <string>
#include <vector>

#include "reports/history/nightly_notes.hpp"
#include "reports/history/nightly_run.hpp"
#include "reports/history/pages/trend_figures.hpp"

namespace mapproof {

/// Names of the studies by nightly run.
using NightlyStudies = std::map<int, std::vector<std::string>>;

/// Nightly runs of histories that were damaged and set aside: they are in no history any more.
struct LostNightlyRuns {
  std::vector<std::string> kept_as;  ///< File names: "history.sqlite.damaged-1".
  NightlyStudies reports;            ///< The studies of each whose reports are still there.
};

/// All that the index shows.
struct IndexFacts {
  std::vector<NightlyFacts> nightly_runs = {};
  NightlyFindings findings = {};
  NightlyStudies studies = {};            ///< Of the nightly runs whose reports are to be linked.
  std::vector<std::string> remarks = {};  ///< What could not be judged of the last nightly run, or
                                          ///< is only suspected.
  std::vector<StudyTrend> trends = {};    ///< Of the last nightly run's studies.
  LostNightlyRuns lost = {};
  std::vector<NightlyNote> notes = {};
  std::set<std::string> comparisons = {};  ///< comparison_file() of those that are there.
};

/// The findings of a nightly run.
inline std::span<const NightlyFinding> found_on(int nightly_run, const NightlyFindings& findings) {
  const auto found = findings.find(nightly_run);
  return found == findings.end() ? std::span<const NightlyFinding>{} : found->second;
}

}  // namespace mapproof
