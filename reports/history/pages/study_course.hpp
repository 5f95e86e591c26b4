#pragma once

#include <optional>
#include <span>
#include <string>

#include "reports/history/finding_groups.hpp"
#include "reports/history/nightly_notes.hpp"
#include "reports/history/nightly_run.hpp"
#include "reports/history/pages/trend_figures.hpp"
#include "reports/model/report.hpp"

namespace mapproof {

/// How one series of a study went over its nightly runs.
struct Course {
  std::string words = {};  ///< "bearing, ISOMAP: MPE +17.6 % (K = 6 and 8)".
  /// In percent of the run that changes are shown against (see base_index()), or in points of what
  /// is judged by points; worse is above zero. Empty: there is no such series, as of results that
  /// are lost.
  ChangeCurve curve = {};
};

/// What got worse most: of the findings of the last nightly run the one with the greatest change,
/// those that are known last; without any the judged error that rose most; nothing if none rose.
std::optional<Course> worst_course(const StudyTrend& trend, const NightlyFindings& findings,
                                   std::span<const NightlyNote> notes);

/// The judged error that fell most, by the least change of a finding or more; it is not tested.
std::optional<Course> best_course(const StudyTrend& trend, const NightlyFindings& findings);

}  // namespace mapproof
