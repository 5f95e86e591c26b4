#include "reports/sections/figures/figure_builders.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <ranges>
#include <tuple>

#include <fmt/format.h>

#include "core/base/median.hpp"
#include "core/base/not_finite.hpp"
#include "core/base/text/number_text.hpp"
#include "core/base/text/words.hpp"
#include "core/statistics/intervals.hpp"
#include "render/figures/curves/best_line.hpp"
#include "render/figures/curves/spectrum.hpp"
#include "render/figures/diagrams/method_comparison.hpp"
#include "render/figures/diagrams/shepard.hpp"
#include "reports/model/format.hpp"
#include "reports/sections/figures/line_judgement.hpp"
#include "reports/sections/figures/method_styles.hpp"
#include "reports/sections/method_ranks.hpp"
#include "reports/sections/run_scores.hpp"
#include "reports/sections/wording.hpp"

namespace mapproof {
namespace {

void add_published(FigureSource& source, std::vector<Figure>& figures) {
  PublishedErrorsSpec spec;
  spec.id = "published-errors";
  for (const SensorStudy& sensor : source.study().experiment.sensors) {
    if (sensor.published.source.empty()) continue;
    PublishedErrorsSpec::Sensor& panel = spec.sensors.emplace_back();
    panel.title = title_of(sensor.sensor.sensor);
    panel.source = sensor.published.source;
    for (const SettingSummary& best : source.best(sensor)) {
      auto method = published_error(best);
      if (!method) continue;
      panel.methods.push_back(*std::move(method));
      spec.record_ids.push_back(source_of(best));
    }
  }
  if (!spec.sensors.empty()) figures.push_back(published_errors_figure(spec));
}

void add_ranks(FigureSource& source, const SensorStudy& sensor, std::vector<Figure>& figures) {
  constexpr std::size_t kFewest = 3;  // Ranks of two say no more than which of them is better.
  const MethodRanks ranks = method_ranks(source.study(), sensor);
  if (!ranks.test || ranks.critical_difference <= 0.0 || ranks.methods.size() < kFewest) return;
  CriticalDifferenceSpec spec;
  spec.id = fmt::format("ranks-{}", name(sensor.sensor.sensor));
  for (std::size_t i = 0; i < ranks.methods.size(); ++i)
    spec.methods.push_back(
        {std::string(info(ranks.methods[i].method).label), ranks.test->mean_ranks[i]});
  spec.critical_difference = ranks.critical_difference;
  spec.alpha = ranks.alpha;
  spec.units = ranks.test->units;
  spec.friedman_p = ranks.test->chi_square_p;
  spec.title = fmt::format("{}: {}", title_of(sensor.sensor.sensor), ranking_title(spec, "MPE"));
  for (const SettingSummary& best : source.best(sensor)) spec.record_ids.push_back(source_of(best));
  figures.push_back(critical_difference_figure(spec));
  if (const std::string note = disagreement_of(compare_methods(source.study(), sensor));
      !note.empty())
    figures.back().caption += " " + note;
}

/// Of the pairs in the order of SensorDetails::distances.
std::vector<double> map_distances(const Points& points) {
  std::vector<double> distances;
  for (Eigen::Index i = 0; i < points.rows(); ++i)
    for (Eigen::Index j = i + 1; j < points.rows(); ++j)
      distances.push_back((points.row(i) - points.row(j)).norm());
  return distances;
}

/// The run that all methods are shown of: the median one of the best method.
std::optional<RunId> shown_run(FigureSource& source, const SensorStudy& sensor) {
  const std::vector<SettingSummary> all = source.best(sensor);
  const SettingSummary* best = best_of(all);
  return best == nullptr ? std::nullopt : median_run(source.study(), *best);
}

/// By which method map distances follow the observed ones most and least; empty unless two have a
/// correlation.
std::string correlation_words(const std::vector<ShepardPanel>& methods) {
  std::vector<std::pair<double, std::string>> correlations;
  for (const ShepardPanel& method : methods)
    if (const double r = shepard_fit(method).correlation; std::isfinite(r))
      correlations.emplace_back(r, method.title);
  if (correlations.size() < 2) return "";
  const auto [least, most] = std::ranges::minmax(correlations);
  const std::string low = significant(least.first, 2), high = significant(most.first, 2);
  if (low == high)
    return fmt::format("map distances follow the observed ones alike with {} methods (r = {})",
                       correlations.size(), low);
  return fmt::format(
      "map distances follow the observed ones most with {} (r = {}), least with {} (r = {})",
      most.second, high, least.second, low);
}

void add_distances(FigureSource& source, const SensorStudy& sensor, const RunId& run,
                   std::vector<Figure>& figures) {
  const SensorDetails* details = source.details(run, sensor.sensor.sensor);
  if (details == nullptr) return;
  ShepardSpec spec;
  spec.id = fmt::format("distances-{}", name(details->sensor));
  spec.title = fmt::format("{}: map distance against observed distance, layout {}, pose {}",
                           title_of(details->sensor), run.layout, run.pose);
  for (const SettingSummary& best : source.best(sensor)) {
    const MapRecord* map = source.map(run, best.sensor, best.setting, best.step);
    if (map == nullptr || map->frame != Frame::kGroundTruth || best.step != details->step) continue;
    spec.methods.push_back({short_label(best.setting),
                            {details->distances.begin(), details->distances.end()},
                            map_distances(map->estimate)});
    spec.record_ids.push_back(map->id);
  }
  if (spec.methods.empty()) return;
  if (const std::string most = correlation_words(spec.methods); !most.empty())
    spec.title = fmt::format("{}, layout {}, pose {}: {}", title_of(details->sensor), run.layout,
                             run.pose, most);
  figures.push_back(shepard_figure(spec));
}

/// Where two eigenvalues stand out most and least; empty where no method has some.
std::string gap_words(const std::vector<SpectrumPanel>& methods) {
  std::vector<std::pair<double, std::string>> gaps;
  for (const SpectrumPanel& method : methods)
    if (const double gap = spectral_gap(method.eigenvalues); std::isfinite(gap))
      gaps.emplace_back(gap, method.title);
  constexpr int kDigits = 2;
  if (gaps.empty()) return "";
  if (gaps.size() == 1)
    return fmt::format("two eigenvalues of {} stand out {} times", gaps[0].second,
                       significant(gaps[0].first, kDigits));
  constexpr std::size_t kMostNamed = 3;
  const auto [least, most] = std::ranges::minmax(gaps);
  // Those whose panels print the same number.
  const auto named = [&](double gap) {
    std::vector<std::string> names;
    for (const auto& [other, name] : gaps)
      if (significant(other, kDigits) == significant(gap, kDigits)) names.push_back(name);
    return fmt::format("{} ({} times)", listed(names, kMostNamed), significant(gap, kDigits));
  };
  return fmt::format("two eigenvalues stand out most with {}, least with {}", named(most.first),
                     named(least.first));
}

void add_spectra(FigureSource& source, const SensorStudy& sensor, const RunId& run,
                 std::vector<Figure>& figures) {
  const SensorDetails* details = source.details(run, sensor.sensor.sensor);
  if (details == nullptr) return;
  SpectrumSpec spec;
  spec.id = fmt::format("spectrum-{}", name(details->sensor));
  spec.title = fmt::format("{}: leading eigenvalues, layout {}, pose {}", title_of(details->sensor),
                           run.layout, run.pose);
  bool any = false;
  for (const SettingSummary& best : source.best(sensor)) {
    SpectrumPanel& panel =
        spec.methods.emplace_back(short_label(best.setting), std::vector<double>());
    for (const auto& [setting, values] : details->spectra)
      if (setting == best.setting) panel.eigenvalues.assign(values.begin(), values.end());
    any = any || !panel.eigenvalues.empty();
    spec.record_ids.push_back(record_id(run, best.sensor, best.setting, best.step));
  }
  if (const std::string gaps = gap_words(spec.methods); !gaps.empty())
    spec.title = fmt::format("{}: {}", title_of(details->sensor), gaps);
  if (!any) return;
  figures.push_back(spectrum_figure(spec));
  figures.back().caption += fmt::format(" Layout {}, pose {}.", run.layout, run.pose);
}

/// What the maps of a study took, by sensor, step and setting.
class SecondsOfMaps {
 public:
  explicit SecondsOfMaps(std::span<const Timing> timings) {
    for (const Timing& timing : timings)
      seconds_[key(timing.sensor, timing.step, timing.setting)].push_back(timing.seconds);
  }

  /// The median over runs, with that of the maps that the method starts from: they are made once
  /// for all that start from them, in the seconds of the first setting if the study does not have
  /// them as a method. Empty if it, or what it starts from, was not timed.
  std::optional<double> of(Sensor sensor, int step, const MethodSetting& setting) const {
    const auto found = seconds_.find(key(sensor, step, setting));
    if (found == seconds_.end()) return std::nullopt;
    double sum = median(found->second);
    if (const auto start = info(setting.method).starts_from) {
      if (const auto before = of(sensor, step, {*start, std::nullopt}))
        sum += *before;
      else if (starting_from(*start, sensor, step) > 1)
        return std::nullopt;
    }
    return sum;
  }

 private:
  using Key = std::tuple<Sensor, int, Method, double>;
  static Key key(Sensor sensor, int step, const MethodSetting& setting) {
    return {sensor, step, setting.method, setting.parameter.value_or(0.0)};
  }

  /// How many settings were timed whose maps start from those of a method.
  std::ptrdiff_t starting_from(Method start, Sensor sensor, int step) const {
    return std::ranges::count_if(seconds_ | std::views::keys, [&](const Key& one) {
      return std::get<0>(one) == sensor && std::get<1>(one) == step &&
             info(std::get<2>(one)).starts_from == start;
    });
  }

  std::map<Key, std::vector<double>> seconds_;
};

/// The mean of a setting as the last point of a line.
ErrorLine end_of(const SettingSummary& summary) {
  const double mean = summary.mpe_m->mean;
  const Interval interval = interval_of(summary.mpe_m).value_or(Interval{kNaN, kNaN});
  return {.label = label(summary.setting),
          .key = slug(summary.setting),
          .x = {static_cast<double>(summary.step)},
          .mean = {mean},
          .low = {interval.low},
          .high = {interval.high}};
}

/// The means of settings, judged by the paired test.
std::vector<ErrorLine> judged_ends(FigureSource& source, const SensorStudy& sensor,
                                   const std::vector<SettingSummary>& settings) {
  std::vector<ErrorLine> lines;
  for (const SettingSummary& setting : settings) lines.push_back(end_of(setting));
  std::vector<PointOfSetting> points;
  for (std::size_t i = 0; i < settings.size(); ++i)
    points.push_back({&lines[i], 0, settings[i].setting});
  judge(points, &Score::mpe_m, sensor, source);
  return lines;
}

/// Who has the lowest MPE whatever its time, or how many there are that tie for it. Without times,
/// which vary from run to run.
/// @param ends  Of the MPE of each setting.
/// @param all   Whether no method is left out.
std::string cost_finding(const std::vector<CostedSetting>& settings,
                         const std::vector<ErrorLine>& ends, bool all) {
  const auto best = std::ranges::min_element(settings, {}, &CostedSetting::mpe_m);
  const std::size_t ties = ties_at_end(ends, {});
  const std::string name = name_alone(best->label);
  const std::string error = error_text(best->mpe_m);
  if (ties > 1)
    return fmt::format("{} of {}{} methods tie for the lowest MPE, {} with {}", ties,
                       settings.size(), all ? "" : " timed", name, error);
  return all ? fmt::format("whatever the time, {} has the lowest MPE, {}", name, error)
             : fmt::format("{} has the lowest MPE of {} timed methods, {}", name, settings.size(),
                           error);
}

}  // namespace

std::vector<Figure> comparison_figures(FigureSource& source) {
  std::vector<Figure> figures;
  add_published(source, figures);
  const auto& sensors = source.study().experiment.sensors;
  for (const SensorStudy& sensor : sensors) add_ranks(source, sensor, figures);
  for (const SensorStudy& sensor : sensors)
    if (const auto run = shown_run(source, sensor)) {
      add_distances(source, sensor, *run, figures);
      add_spectra(source, sensor, *run, figures);
    }
  return figures;
}

std::vector<Figure> cost_figures(FigureSource& source, std::span<const Timing> timings) {
  const SecondsOfMaps seconds(timings);
  std::vector<Figure> figures;
  for (const SensorStudy& sensor : source.study().experiment.sensors) {
    ParetoSpec spec;
    spec.id = fmt::format("cost-{}", name(sensor.sensor.sensor));
    std::vector<SettingSummary> timed;
    for (const SettingSummary& best : source.best(sensor)) {
      const auto cost = seconds.of(best.sensor, best.step, best.setting);
      if (!best.mpe_m) continue;
      if (!cost) {
        spec.untimed.push_back(short_label(best.setting));
        continue;
      }
      spec.settings.push_back({label(best.setting), *cost, best.mpe_m->mean});
      timed.push_back(best);
      spec.record_ids.push_back(source_of(best));
    }
    if (spec.settings.size() < 2) continue;
    spec.title = fmt::format(
        "{}: {}", title_of(sensor.sensor.sensor),
        cost_finding(spec.settings, judged_ends(source, sensor, timed), spec.untimed.empty()));
    figures.push_back(pareto_figure(spec));
  }
  return figures;
}

}  // namespace mapproof
