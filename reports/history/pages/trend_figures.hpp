#pragma once

#include <cstddef>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "render/plot/figure.hpp"
#include "reports/history/nightly_notes.hpp"
#include "reports/history/nightly_run.hpp"

namespace mapproof {

/// Findings by nightly run.
using NightlyFindings = std::map<int, std::vector<NightlyFinding>>;

/// The page that a trend's figures are for.
struct TrendLocation {
  bool among_others = false;  ///< With other studies': ids and titles name the study.
  std::size_t most = 0;       ///< Figures or sentences at most, the first ones; 0: all.
};

/// Figures of a trend: one a sensor and quantity of accuracy, seconds, memory. Those that the last
/// nightly run's findings are about go first, in the order of their groups: what is new before what
/// is known. Lines are the setting of each method that was best over the nightly runs, and every
/// setting that has a finding on one of them, which is marked there. Settings of one method have
/// its style and one entry in the legend; their ends are named where they lie apart. What has
/// fewer than two values of a line, or did not change and has no finding, has a sentence instead;
/// where every accuracy has, a figure before those without findings shows the values of the
/// methods. Pure: the same values give the same figures.
/// @param trend     At least one nightly run.
/// @param findings  Of any study; those of other studies are left out.
/// @param notes     By which findings are known.
std::vector<Figure> trend_figures(const StudyTrend& trend, const NightlyFindings& findings,
                                  std::span<const NightlyNote> notes = {},
                                  const TrendLocation& location = {});

/// What trend_figures() draws nothing of: "Bearing: MPE from 0.06 m (SMACOF) to 0.3 m (LPCA), 10
/// methods; change 0 % in 2 nightly runs." Values are medians over runs and over the nightly runs.
/// Peak memory is only there where all are.
/// @param trend, findings  As for trend_figures().
std::vector<std::string> trend_sentences(const StudyTrend& trend, const NightlyFindings& findings,
                                         const TrendLocation& location = {});

}  // namespace mapproof
