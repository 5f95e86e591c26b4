#pragma once

#include <map>
#include <string>
#include <vector>

#include "core/model/study.hpp"
#include "reports/model/report.hpp"
#include "reports/sections/method_summary.hpp"
#include "reports/sections/run_scores.hpp"

namespace mapproof {

/// One setting over the levels of a variation. All vectors are as long as the levels.
struct VariedSetting {
  MethodSetting setting;
  std::vector<int> runs;    ///< Records found.
  std::vector<int> scored;  ///< Of them with a score.
  /// How many of them carry each status.
  std::vector<std::map<StatusCode, int>> statuses;
  std::vector<std::optional<MeanEstimate>> mpe_m;  ///< Over the scored.
  std::vector<std::optional<MeanEstimate>> moe_percent;
  std::vector<RunValues> mpe_by_run;  ///< What mpe_m are the means of.
};

/// Every setting of a variation, in its order.
std::vector<VariedSetting> summarize(const Study& study, const Variation& variation);

/// Whether the 95 % intervals of all means overlap, so that none of them stands apart from another;
/// false if an interval is not known.
bool all_overlap(const std::vector<std::optional<MeanEstimate>>& means);

/// A level as a reader takes it: degrees for bearing noise, percent for shares.
double shown_level(const Variation& variation, double level);

/// A level as a text, "0.5"; one that is a choice by its name, "covisible pairs only".
std::string level_text(const Variation& variation, double level);

/// "bearing noise [°]": what the levels are, with their unit.
std::string level_words(const Variation& variation);

/// "variation-bearing-noise": MPE of each setting at each level.
Table variation_table(const Study& study, const Variation& variation);

}  // namespace mapproof
