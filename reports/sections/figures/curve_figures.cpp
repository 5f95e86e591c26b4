#include "reports/sections/figures/figure_builders.hpp"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "core/base/not_finite.hpp"
#include "core/base/text/number_text.hpp"
#include "render/figures/curves/best_line.hpp"
#include "render/figures/curves/error_curve.hpp"
#include "reports/sections/figures/line_judgement.hpp"
#include "reports/sections/figures/method_styles.hpp"
#include "reports/sections/wording.hpp"

namespace mapproof {
namespace {

using Steps = std::vector<SettingSummary>;

/// One of the two errors that curves show.
struct Measure {
  const char* id;
  const char* name;
  const char* unit;
  const char* words;
  std::optional<MeanEstimate> SettingSummary::*estimate;
  double Score::*error;  ///< Of a run.
};

constexpr Measure kMpe{"mpe",        "MPE", "m", "mean position error", &SettingSummary::mpe_m,
                       &Score::mpe_m};
constexpr Measure kMoe{
    "moe", "MOE", "%", "mean orientation error", &SettingSummary::moe_percent, &Score::moe_percent};

/// Methods that share a figure, in its order.
struct Family {
  std::string id;
  std::string words;       ///< ", methods on a neighbour graph"; may be empty.
  std::string among = {};  ///< " on a neighbour graph", in a finding about some of all methods.
  std::vector<Method> methods = {};
  std::string note = {};  ///< For the caption.
};

ErrorLine curve(const Experiment& experiment, const Steps& steps, const Measure& measure) {
  ErrorLine curve;
  curve.label = label(steps.front().setting);
  curve.key = std::string(info(steps.front().setting.method).name);
  curve.series = series_of_method(experiment, steps.front().setting.method);
  bool any_interval = false;
  for (const SettingSummary& summary : steps) {
    const auto& estimate = summary.*measure.estimate;
    const auto interval = interval_of(estimate);
    curve.x.push_back(summary.step);
    curve.mean.push_back(estimate ? estimate->mean : kNaN);
    curve.low.push_back(interval ? interval->low : kNaN);
    curve.high.push_back(interval ? interval->high : kNaN);
    any_interval = any_interval || interval;
  }
  if (!any_interval) {
    curve.low.clear();
    curve.high.clear();
  }
  return curve;
}

bool has_score(const Steps& steps) {
  return std::ranges::any_of(steps, [](const SettingSummary& s) { return s.scored > 0; });
}

std::string caption(const std::vector<Steps>& curves, const Measure& measure,
                    const Family& family) {
  std::string ends;
  for (const Steps& steps : curves) {
    const auto& estimate = steps.back().*measure.estimate;
    if (!estimate) continue;
    ends += fmt::format("{}{}: {} {}", ends.empty() ? "" : "; ", label(steps.back().setting),
                        significant(estimate->mean), measure.unit);
  }
  const SettingSummary& first = curves.front().back();
  return fmt::format("{}{}: {} ({}) over observations. After {} of them \u2013 {}.{}",
                     title_of(first.sensor), family.words, measure.words, measure.name, first.step,
                     ends, family.note);
}

/// "these 5", "the 5 on a neighbour graph"; empty if the study has no other methods with a score.
std::string family_words(const Family& family, std::size_t shown,
                         const std::vector<Steps>& history) {
  const auto all = std::ranges::count_if(
      history, [](const Steps& steps) { return !steps.empty() && has_score(steps); });
  if (std::cmp_greater_equal(shown, all)) return "";
  return fmt::format("{} {}{}", family.among.empty() ? "these" : "the", shown, family.among);
}

/// Nothing if none of the methods was scored.
void add_curves(FigureSource& source, const SensorStudy& sensor, const Measure& measure,
                const Family& family, std::vector<Figure>& figures) {
  const std::vector<Steps>& history = source.best_history(sensor);
  std::vector<Steps> shown;
  for (const Method method : family.methods)
    for (const Steps& steps : history)
      if (!steps.empty() && steps.front().setting.method == method && has_score(steps))
        shown.push_back(steps);
  if (shown.empty()) return;
  ErrorCurveSpec spec;
  spec.id = family.id;
  spec.title =
      fmt::format("{}: {}{}", title_of(shown.front().front().sensor), measure.name, family.words);
  spec.y_label = fmt::format("{} [{}]", measure.name, measure.unit);
  spec.quantity = measure.words;
  spec.caption = caption(shown, measure, family);
  for (const Steps& steps : shown) {
    spec.curves.push_back(curve(source.study().experiment, steps, measure));
    for (const SettingSummary& summary : steps) spec.record_ids.push_back(source_of(summary));
  }
  std::vector<PointOfSetting> ends;
  for (std::size_t i = 0; i < shown.size(); ++i)
    ends.push_back({&spec.curves[i], shown[i].size() - 1, shown[i].back().setting});
  judge(ends, measure.error, sensor, source);
  if (const std::string best = best_at_end(spec.curves,
                                           {.label = measure.name,
                                            .unit = measure.unit,
                                            .family = family_words(family, shown.size(), history)},
                                           "after {} observations");
      !best.empty())
    spec.title = fmt::format("{}: {}", title_of(shown.front().front().sensor), best);
  figures.push_back(error_curve_figure(spec));
}

std::vector<Method> methods_where(bool graph) {
  std::vector<Method> methods;
  for (const MethodInfo& method : all_methods())
    if (on_graph(method.method) == graph) methods.push_back(method.method);
  return methods;
}

/// The two families that a sensor's methods fall into.
std::vector<Family> graph_families(const char* id, Sensor sensor) {
  return {{fmt::format("{}-{}-global", id, name(sensor)), ", methods without a neighbour graph",
           " without a neighbour graph", methods_where(false)},
          {fmt::format("{}-{}-graph", id, name(sensor)), ", methods on a neighbour graph",
           " on a neighbour graph", methods_where(true)}};
}

/// The methods of others beside that of mapproof with the least error in the end.
std::optional<Family> family_of_others(FigureSource& source, const SensorStudy& sensor,
                                       const Measure& measure) {
  const Experiment& experiment = source.study().experiment;
  if (experiment.external_methods.empty()) return std::nullopt;
  Family family{fmt::format("{}-{}-external", measure.id, name(sensor.sensor.sensor)),
                ", methods of others",
                "",
                {},
                " The methods of others are shown beside that of mapproof with the least MPE."};
  std::vector<SettingSummary> ours;
  for (const Steps& steps : source.best_history(sensor))
    if (!steps.empty() && find_external(experiment, steps.back().setting.method) == nullptr)
      ours.push_back(steps.back());
  if (const SettingSummary* best = best_of(ours)) family.methods.push_back(best->setting.method);
  for (const ExternalMethod& method : experiment.external_methods)
    family.methods.push_back(method_of(method));
  return family;
}

/// The figures of the paper, and one of the methods that they leave out.
std::vector<Family> paper_families(const Experiment& experiment, Sensor sensor) {
  std::vector<Family> result;
  std::vector<Method> shown;
  for (const PaperFigure& figure : experiment.figures)
    if (figure.kind == FigureKind::kErrorCurve && figure.sensor == sensor) {
      result.push_back({.id = figure.id, .words = "", .methods = figure.methods});
      shown.insert(shown.end(), figure.methods.begin(), figure.methods.end());
    }
  if (result.empty()) return graph_families(kMpe.id, sensor);
  if (result.size() > 1)
    for (Family& family : result)
      family.note = fmt::format(
          " Which methods the paper draws in which of these {} figures is lost with their "
          "captions: "
          "the division is ours.",
          result.size());
  Family others{fmt::format("mpe-{}-others", name(sensor)),
                ", methods that the paper's figures leave out"};
  for (const MethodInfo& method : all_methods())
    if (std::ranges::find(shown, method.method) == shown.end())
      others.methods.push_back(method.method);
  result.push_back(others);
  return result;
}

}  // namespace

std::vector<Figure> curve_figures(FigureSource& source) {
  std::vector<Figure> figures;
  const Experiment& experiment = source.study().experiment;
  const auto add = [&](const SensorStudy& sensor, const Measure& measure,
                       std::vector<Family> families) {
    if (auto others = family_of_others(source, sensor, measure)) families.push_back(*others);
    for (const Family& family : families) add_curves(source, sensor, measure, family, figures);
  };
  for (const SensorStudy& sensor : experiment.sensors)
    add(sensor, kMpe, paper_families(experiment, sensor.sensor.sensor));
  for (const SensorStudy& sensor : experiment.sensors)
    add(sensor, kMoe, graph_families(kMoe.id, sensor.sensor.sensor));
  return figures;
}

}  // namespace mapproof
