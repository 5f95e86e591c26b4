#include "reports/sections/method_summary.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>

#include <fmt/format.h>

#include "core/base/median.hpp"
#include "core/base/not_finite.hpp"
#include "reports/sections/figures/method_styles.hpp"
#include "reports/sections/run_scores.hpp"

namespace mapproof {
namespace {

/// What the records of one setting at one step hold, value by value.
struct Samples {
  int runs = 0;
  int with_status = 0;
  std::vector<double> mpe, moe, mpe_all, moe_unmirrored;
  std::vector<int> layouts;

  void add(const RunRecord& record, int layout) {
    ++runs;
    if (!record.statuses.empty()) ++with_status;
    if (!record.score || !usable(*record.score)) return;
    const Score& score = *record.score;
    mpe.push_back(score.mpe_m);
    moe.push_back(score.moe_percent);
    mpe_all.push_back(score.mpe_all_fitted_m);
    moe_unmirrored.push_back(score.moe_unmirrored_percent);
    layouts.push_back(layout);
  }
};

/// The mean of what is finite; NaN if nothing is.
double mean_of_finite(std::span<const double> values) {
  double sum = 0.0;
  int count = 0;
  for (const double value : values) {
    if (!std::isfinite(value)) continue;
    sum += value;
    ++count;
  }
  return count > 0 ? sum / count : kNaN;
}

std::optional<PublishedValue> published_for(const SensorStudy& sensor, Method method) {
  for (const PublishedValue& value : sensor.published.values)
    if (value.setting.method == method) return value;
  return std::nullopt;
}

using Key = std::tuple<int, Method, std::optional<double>>;  ///< Step and setting.

Key key_of(int step, const MethodSetting& setting) {
  return {step, setting.method, setting.parameter};
}

/// The samples of each setting at each step, in one pass over the records.
std::map<Key, Samples> samples_of(const Study& study, Sensor sensor,
                                  std::span<const MethodSetting> settings,
                                  std::span<const int> steps) {
  std::map<Key, Samples> samples;
  for (const int step : steps)
    for (const MethodSetting& setting : settings) samples[key_of(step, setting)];
  for (const Run& run : study.runs)
    for (const RunRecord& record : run.records) {
      if (record.sensor != sensor) continue;
      const auto found = samples.find(key_of(record.step, record.setting));
      if (found != samples.end()) found->second.add(record, run.id.layout);
    }
  return samples;
}

SettingSummary summary_of(const Samples& samples) {
  SettingSummary summary;
  summary.runs = samples.runs;
  summary.with_status = samples.with_status;
  summary.scored = static_cast<int>(samples.mpe.size());
  if (summary.scored > 0) {
    summary.mpe_m = clustered_mean(samples.mpe, samples.layouts);
    summary.moe_percent = clustered_mean(samples.moe, samples.layouts);
    summary.mpe_median_m = median(samples.mpe);
  }
  summary.mpe_all_fitted_m = mean_of_finite(samples.mpe_all);
  summary.moe_unmirrored_percent = mean_of_finite(samples.moe_unmirrored);
  return summary;
}

bool better(const SettingSummary& a, const SettingSummary& b) {
  return a.mpe_m && (!b.mpe_m || a.mpe_m->mean < b.mpe_m->mean);
}

}  // namespace

std::vector<std::vector<SettingSummary>> summarize(const Study& study, const SensorStudy& sensor,
                                                   std::span<const int> steps) {
  const std::vector<MethodSetting> settings = settings_of(sensor);
  const auto samples = samples_of(study, sensor.sensor.sensor, settings, steps);
  std::vector<std::vector<SettingSummary>> summaries;
  for (const int step : steps) {
    std::vector<SettingSummary>& at_step = summaries.emplace_back();
    for (const MethodSetting& setting : settings) {
      SettingSummary& summary = at_step.emplace_back(summary_of(samples.at(key_of(step, setting))));
      summary.sensor = sensor.sensor.sensor;
      summary.setting = setting;
      summary.step = step;
      summary.published = published_for(sensor, setting.method);
    }
  }
  return summaries;
}

std::vector<SettingSummary> summarize(const Study& study, const SensorStudy& sensor, int step) {
  return std::move(summarize(study, sensor, std::span(&step, 1)).front());
}

std::vector<SettingSummary> best_of_each_method(std::span<const SettingSummary> summaries) {
  std::vector<SettingSummary> best;
  for (const SettingSummary& summary : summaries) {
    if (best.empty() || best.back().setting.method != summary.setting.method) {
      best.push_back(summary);
    } else if (better(summary, best.back())) {
      best.back() = summary;
    }
  }
  return best;
}

const SettingSummary* best_of(std::span<const SettingSummary> summaries) {
  const SettingSummary* best = nullptr;
  for (const SettingSummary& summary : summaries)
    if (summary.mpe_m && (best == nullptr || better(summary, *best))) best = &summary;
  return best;
}

int last_step(const SensorStudy& sensor) {
  return sensor.checkpoints.empty() ? 0 : sensor.checkpoints.back();
}

double mpe_difference_m(const SettingSummary& summary) {
  if (!summary.mpe_m || !summary.published) return kNaN;
  return summary.mpe_m->mean - summary.published->mpe_m;
}

double moe_difference_percent(const SettingSummary& summary) {
  if (!summary.moe_percent || !summary.published) return kNaN;
  return summary.moe_percent->mean - summary.published->moe_percent;
}

std::optional<Interval> interval_of(const std::optional<MeanEstimate>& estimate) {
  if (!estimate || !estimate->half_width) return std::nullopt;
  return Interval{std::max(0.0, estimate->mean - *estimate->half_width),
                  estimate->mean + *estimate->half_width};
}

std::optional<PublishedError> published_error(const SettingSummary& best) {
  if (!best.mpe_m) return std::nullopt;
  PublishedError method{.label = short_label({best.setting.method, std::nullopt}),
                        .key = std::string(info(best.setting.method).name),
                        .mean_m = best.mpe_m->mean};
  if (const auto interval = interval_of(best.mpe_m))
    method.interval = Range{interval->low, interval->high};
  if (best.published) {
    method.published_m = best.published->mpe_m;
    method.can_compare = best.published->note.empty();
  }
  return method;
}

PublishedAgreement agreement_of(std::span<const SettingSummary> summaries) {
  std::vector<PublishedError> methods;
  for (const SettingSummary& summary : summaries)
    if (auto method = published_error(summary)) methods.push_back(*std::move(method));
  return agreement_of(methods);
}

std::string source_of(const SettingSummary& summary) {
  return fmt::format("{}/{}/{} of {} run{}", name(summary.sensor), slug(summary.setting),
                     summary.step, summary.runs, summary.runs == 1 ? "" : "s");
}

}  // namespace mapproof
