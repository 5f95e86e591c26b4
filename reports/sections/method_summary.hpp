#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/base/not_finite.hpp"
#include "core/model/study.hpp"
#include "core/statistics/intervals.hpp"
#include "render/figures/diagrams/method_comparison.hpp"

namespace mapproof {

/// How one method with one parameter did at one step, over all runs of a study.
struct SettingSummary {
  Sensor sensor = Sensor::kVisibility;
  MethodSetting setting;
  int step = 0;
  int runs = 0;                       ///< Records found.
  int scored = 0;                     ///< Of them with a score.
  int with_status = 0;                ///< Of them with a status of any kind.
  std::optional<MeanEstimate> mpe_m;  ///< Over the scored; empty if there are none.
  std::optional<MeanEstimate> moe_percent;
  double mpe_median_m = kNaN;               ///< NaN: no score, as below.
  double mpe_all_fitted_m = kNaN;           ///< Mean.
  double moe_unmirrored_percent = kNaN;     ///< Mean.
  std::optional<PublishedValue> published;  ///< Of the same method, whatever its parameter.
};

/// Every parameter of every method of `sensor` at `step`, in the order of the experiment.
std::vector<SettingSummary> summarize(const Study& study, const SensorStudy& sensor, int step);

/// The same at each of `steps`, in one pass over the records.
std::vector<std::vector<SettingSummary>> summarize(const Study& study, const SensorStudy& sensor,
                                                   std::span<const int> steps);

/// For each method the parameter of least mean MPE, as the paper chose; a method without any score
/// stands with its first parameter.
std::vector<SettingSummary> best_of_each_method(std::span<const SettingSummary> summaries);

/// The one of least mean MPE; null if none has a score.
const SettingSummary* best_of(std::span<const SettingSummary> summaries);

/// The last checkpoint, 0 if there is none.
int last_step(const SensorStudy& sensor);

/// Ours less the paper's; NaN where either is missing.
double mpe_difference_m(const SettingSummary& summary);
double moe_difference_percent(const SettingSummary& summary);

struct Interval {
  double low = 0.0;
  double high = 0.0;
};

/// The 95 % interval of an error, cut at 0; empty where one layout, or none, was run.
std::optional<Interval> interval_of(const std::optional<MeanEstimate>& estimate);

/// The best setting of a method as the figure of published errors shows it; empty where it has no
/// error.
std::optional<PublishedError> published_error(const SettingSummary& best);

/// How the published errors of these settings lie to our intervals.
PublishedAgreement agreement_of(std::span<const SettingSummary> summaries);

/// "bearing/isomap-K9/2000 of 25 runs": which records a summary rests on.
std::string source_of(const SettingSummary& summary);

}  // namespace mapproof
