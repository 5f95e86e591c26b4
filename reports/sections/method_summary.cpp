#include "reports/sections/method_summary.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

namespace mapproof {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

/// What the records of one setting hold, value by value.
struct Samples {
  std::vector<double> mpe, moe, mpe_all, moe_unmirrored;
  std::vector<int> layouts;

  void add(const Score& score, int layout) {
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
  return count > 0 ? sum / count : kNan;
}

std::vector<MethodSetting> settings_of(const MethodGrid& grid) {
  if (grid.parameters.empty()) return {{grid.method, std::nullopt}};
  std::vector<MethodSetting> settings;
  for (const double parameter : grid.parameters) settings.push_back({grid.method, parameter});
  return settings;
}

std::optional<PublishedValue> published_for(const SensorStudy& sensor, Method method) {
  for (const PublishedValue& value : sensor.published)
    if (value.setting.method == method) return value;
  return std::nullopt;
}

/// A score can be used if both of the numbers that are averaged are.
bool usable(const Score& score) {
  return std::isfinite(score.mpe_m) && std::isfinite(score.moe_percent);
}

SettingSummary summarize_setting(const Study& study, const SensorStudy& sensor,
                                 const MethodSetting& setting, int step) {
  SettingSummary summary;
  summary.sensor = sensor.sensor.sensor;
  summary.setting = setting;
  summary.step = step;
  summary.published = published_for(sensor, setting.method);
  Samples samples;
  for (const Run& run : study.runs)
    for (const RunRecord& record : run.records) {
      if (record.sensor != summary.sensor || record.setting != setting || record.step != step)
        continue;
      ++summary.runs;
      if (!record.statuses.empty()) ++summary.with_status;
      if (record.score && usable(*record.score)) samples.add(*record.score, run.id.layout);
    }
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

std::vector<SettingSummary> summarize(const Study& study, const SensorStudy& sensor, int step) {
  std::vector<SettingSummary> summaries;
  for (const MethodGrid& grid : sensor.methods)
    for (const MethodSetting& setting : settings_of(grid))
      summaries.push_back(summarize_setting(study, sensor, setting, step));
  return summaries;
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
  if (!summary.mpe_m || !summary.published) return kNan;
  return summary.mpe_m->mean - summary.published->mpe_m;
}

double moe_difference_percent(const SettingSummary& summary) {
  if (!summary.moe_percent || !summary.published) return kNan;
  return summary.moe_percent->mean - summary.published->moe_percent;
}

std::optional<Interval> interval_of(const std::optional<MeanEstimate>& estimate) {
  if (!estimate || !estimate->half_width) return std::nullopt;
  return Interval{std::max(0.0, estimate->mean - *estimate->half_width),
                  estimate->mean + *estimate->half_width};
}

std::string record_id(const RunId& run, Sensor sensor, const MethodSetting& setting, int step) {
  return fmt::format("{}/{}/{}/{}", slug(run), name(sensor), slug(setting), step);
}

std::string source_of(const SettingSummary& summary) {
  return fmt::format("{}/{}/{} of {} run{}", name(summary.sensor), slug(summary.setting),
                     summary.step, summary.runs, summary.runs == 1 ? "" : "s");
}

}  // namespace mapproof
