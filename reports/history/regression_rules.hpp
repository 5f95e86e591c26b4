#pragma once

#include <optional>
#include <string>
#include <vector>

#include "reports/history/nightly_run.hpp"

namespace mapproof {

/// When a change counts. Chosen by simulation (docs/nightly.md has the rates that follow).
struct RegressionRules {
  double alpha = 0.001;          ///< Of all tests of one rule in one nightly run together.
  double least_ratio = 0.01;     ///< Accuracy: changes of less, as a share, do not count.
  double least_points = 0.5;     ///< Likewise of quantities in percent, percentage points.
  double least_slowdown = 0.10;  ///< Seconds, as a share.
  double least_growth = 0.05;    ///< Memory, and accuracy without runs to pair, as a share.
  double seconds_floor = 0.02;   ///< The least noise that is assumed of seconds, as a share.
  double memory_floor = 0.01;
  double shortest_s =
      1e-3;               ///< Shorter parts are not judged: the resolution of the clock would be.
  int least_lost = 3;     ///< Lost results of a series; fewer count if all are lost.
  double least_lost_share = 0.25;  ///< Of its results.
  int least_passing_nightly_runs =
      4;                            ///< Seconds and memory: nightly runs that define what is usual.
  int most_good_nightly_runs = 20;  ///< At most, the last ones.
  int least_drift_nightly_runs = 12;  ///< Change points are searched from so many nightly runs on.
};

/// The values of the reference nightly run.
struct ReferenceScores {
  int nightly_run = 0;
  Scores scores = {};
};

/// A study of this nightly run, and what it is compared with.
struct StudyEvidence {
  StudyTrend trend = {};  ///< From the pinned reference on, if there is one; this nightly run last.
  Scores this_run = {};
  std::optional<ReferenceScores> reference = {};  ///< Empty: no nightly run to compare with.
  bool draws_groups = false;  ///< A table of results: groups are the units, however few.
};

/// What the rules found.
struct RuleOutcome {
  std::vector<NightlyFinding> findings = {};
  std::vector<std::string> remarks = {};  ///< What could not be judged, or is only suspected yet.
};

}  // namespace mapproof
