#pragma once

#include <map>
#include <string>
#include <vector>

#include "render/plot/figure.hpp"
#include "reports/history/nightly_run.hpp"

namespace mapproof {

/// Findings by nightly run.
using NightlyFindings = std::map<int, std::vector<NightlyFinding>>;

/// The page that a trend's figures are for.
struct TrendLocation {
  bool among_others = false;  ///< With other studies': ids and titles name the study.
  std::size_t most = 0;  ///< Figures at most; 0: all. Those that this nightly run's findings are
                         ///< about go first.
};

/// Figures of a trend: one a sensor and quantity of accuracy, seconds, memory. Lines are the
/// setting of each method that was best over the nightly runs, and every setting that has a finding
/// on one of them, which is marked there. Pure: the same values give the same figures.
/// @param trend     At least one nightly run.
/// @param findings  Of any study; those of other studies are left out.
std::vector<Figure> trend_figures(const StudyTrend& trend, const NightlyFindings& findings,
                                  const TrendLocation& location = {});

}  // namespace mapproof
