#include "render/figures/curves/convergence.hpp"

#include <algorithm>
#include <cmath>
#include <set>

#include <fmt/format.h>

#include "core/base/errors.hpp"
#include "core/base/not_finite.hpp"
#include "core/base/text/number_text.hpp"
#include "core/base/text/unit_text.hpp"
#include "core/base/text/words.hpp"
#include "render/figures/curves/error_lines.hpp"
#include "render/figures/curves/log_log.hpp"
#include "render/figures/layer_shapes.hpp"
#include "render/figures/unit_scale.hpp"

namespace mapproof {
namespace {

void require_consistent(const WindowCurveSpec& spec) {
  const WindowCurve& windows = spec.windows;
  if (windows.lengths_s.size() != windows.held_out_m.size())
    throw InvalidInput("figure " + printable(spec.id) + ": lengths and errors differ in number");
  for (const double length : windows.lengths_s)
    if (!(length > 0.0) || std::isinf(length))
      throw InvalidInput("figure " + printable(spec.id) + ": a length is not positive");
}

/// The tried lengths, ascending.
std::vector<std::size_t> by_length(const WindowCurve& windows) {
  std::vector<std::size_t> order(windows.lengths_s.size());
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
  std::ranges::sort(order, {}, [&](std::size_t i) { return windows.lengths_s[i]; });
  return order;
}

/// "4 windows, of 2.3 s to 6.4 s, predict nothing." @param lengths_s  Ascending, not empty.
std::string failed_words(const std::vector<double>& lengths_s) {
  const auto seconds = [](double length_s) {
    return with_unit(fmt::format("{:.3g}", length_s), "s");
  };
  const std::string shortest = seconds(lengths_s.front());
  return lengths_s.size() == 1 ? fmt::format("The window of {} predicts nothing.", shortest)
                               : fmt::format("{} windows, of {} to {}, predict nothing.",
                                             lengths_s.size(), shortest, seconds(lengths_s.back()));
}

constexpr const char* kMeasurements = "ranges";
constexpr const char* kObservation = "error of \u0108";
const SlopeGuide kRootLaw{"slope \u22121/2", -0.5};

/// A mean of each point over the number of measurements.
ErrorLine line_of(const ConvergenceCurve& curve, MeanEstimate ConvergencePoint::*what,
                  const std::string& label, const std::string& key) {
  ErrorLine line{.label = label, .key = key};
  for (const ConvergencePoint& point : curve.points) {
    const MeanEstimate& estimate = point.*what;
    const double mean = estimate.values > 0 ? estimate.mean : kNaN;
    const double half = estimate.half_width.value_or(0.0);
    line.x.push_back(static_cast<double>(point.steps) * std::max(curve.landmarks, 1));
    line.mean.push_back(mean);
    line.low.push_back(mean - half);
    line.high.push_back(mean + half);
  }
  return line;
}

int pairs_of(const ConvergenceCurve& curve) {
  int pairs = 0;
  for (const ConvergencePoint& point : curve.points)
    pairs = std::max(pairs, point.observation.values);
  return pairs;
}

/// "; arrows: those that reach below the frame, as to 0"; empty if none does.
std::string arrow_words(const Figure& figure) {
  for (const Panel& panel : figure.panels)
    for (const Layer& layer : panel.layers)
      if (const auto* bars = std::get_if<Segments>(&layer); bars != nullptr && bars->arrow)
        return "; arrows: those that reach below the frame, as to 0";
  return "";
}

std::string means_of(const ConvergenceCurve& curve, const Figure& figure) {
  return fmt::format("Means over {} of path and environment, {}, {}; bars: 95 % intervals{}.",
                     counted(pairs_of(curve), "random pair"), counted(curve.landmarks, "landmark"),
                     curve.title, arrow_words(figure));
}

std::string slope_of(const ErrorLine& line) {
  return slope_words(log_log_slope(line.x, line.mean));
}

LogLogSpec spec_of(const std::string& id, const char* title, const ConvergenceCurve& curve) {
  LogLogSpec spec;
  spec.id = id;
  spec.title = title;
  spec.record_ids = {"convergence/" + curve.id};
  return spec;
}

/// "1 % of the range" of "white noise, 1 % of the range, plain SVD".
std::string amplitude_of(const ConvergenceCurve& curve) {
  const std::size_t begin = std::min(curve.title.find(", "), curve.title.size());
  return curve.title.substr(begin, curve.title.find(", ", begin + 1) - begin);
}

/// How many times as large the error of the landmarks is with the worst noise as with the least of
/// the same amplitude, after the most measurements.
std::string noise_title(std::span<const ConvergenceCurve> curves) {
  const auto error_of = [](const ConvergenceCurve& curve) {
    const double mean = curve.points.empty() ? kNaN : curve.points.back().landmarks_m.mean;
    return mean > 0.0 && curve.points.back().landmarks_m.values > 0 ? mean : kNaN;
  };
  std::vector<const ConvergenceCurve*> known;
  for (const ConvergenceCurve& curve : curves)
    if (std::isfinite(error_of(curve))) known.push_back(&curve);
  constexpr const char* kPlain = "Convergence under other noise";
  if (known.empty()) return kPlain;
  const auto by_error = [&](const ConvergenceCurve* curve) { return error_of(*curve); };
  const ConvergenceCurve* most = *std::ranges::max_element(known, {}, by_error);
  std::erase_if(known, [&](const ConvergenceCurve* curve) {
    return curve == most || amplitude_of(*curve) != amplitude_of(*most);
  });
  if (known.empty()) return kPlain;
  const ConvergenceCurve* least = *std::ranges::min_element(known, {}, by_error);
  return fmt::format("{} makes landmarks err {} times as much as {}",
                     capitalised(most->title.substr(0, most->title.find(','))),
                     significant(error_of(*most) / error_of(*least), 2),
                     least->title.substr(0, least->title.find(',')));
}

/// How far the sine of the subspace's angle and its bound came from the fewest ranges to the most.
std::string angle_title(const ErrorLine& sine, const ErrorLine& bound) {
  if (sine.mean.size() < 2 || !(sine.mean.front() > 0.0) || !(sine.mean.back() > 0.0))
    return "Angle of the learned subspace and its bound";
  const double fell = sine.mean.front() / sine.mean.back();
  const double bound_fell = bound.mean.front() / bound.mean.back();
  return fmt::format(
      "The angle of the learned subspace {} by a factor of {}, its bound falls by {}",
      fell >= 1.0 ? "falls" : "grows", significant(std::max(fell, 1.0 / fell), 2),
      significant(bound_fell, 2));
}

/// What the largest factorisation took.
std::string factorization_title(std::span<const FactorizationCost> costs) {
  if (costs.empty()) return "Time of the factorisation";
  const FactorizationCost& most = *std::ranges::max_element(costs, {}, [](const auto& cost) {
    return static_cast<double>(cost.landmarks) * cost.landmarks * static_cast<double>(cost.steps);
  });
  return fmt::format("The factorisation of {} and {} takes {}", counted(most.landmarks, "landmark"),
                     counted(most.steps, "step"), seconds_text(most.seconds));
}

/// Costs with the same N or the same T as a line; alone they make none.
/// @param factor  Of the seconds.
std::vector<ErrorLine> cost_lines(std::span<const FactorizationCost> costs, bool over_steps,
                                  double factor) {
  const auto fixed = [&](const FactorizationCost& cost) {
    return over_steps ? static_cast<long>(cost.landmarks) : cost.steps;
  };
  const auto varied = [&](const FactorizationCost& cost) {
    return over_steps ? cost.steps : static_cast<long>(cost.landmarks);
  };
  std::set<long> groups;
  for (const FactorizationCost& cost : costs) groups.insert(fixed(cost));
  std::vector<ErrorLine> lines;
  for (const long group : groups) {
    const char* symbol = over_steps ? "N" : "T";
    ErrorLine line{.label = fmt::format("{} = {}", symbol, count_text(group)),
                   .key = fmt::format("{}-{}", over_steps ? "landmarks" : "steps", group)};
    std::vector<FactorizationCost> members;
    for (const FactorizationCost& cost : costs)
      if (fixed(cost) == group) members.push_back(cost);
    std::ranges::sort(members, {}, varied);
    for (const FactorizationCost& cost : members) {
      line.x.push_back(static_cast<double>(varied(cost)));
      line.mean.push_back(factor * cost.seconds);
    }
    if (line.x.size() > 1 && line.x.front() < line.x.back()) lines.push_back(std::move(line));
  }
  return lines;
}

}  // namespace

Figure window_curve_figure(const WindowCurveSpec& spec) {
  require_consistent(spec);
  const WindowCurve& windows = spec.windows;
  const ErrorAxis axis = error_axis(windows.held_out_m, {}, 6.0);
  Polyline curve{.label = "held-out ranges", .marker = Marker::kCircle, .mark = {"held-out", {}}};
  Scatter chosen{.label = "chosen", .colour = ThemeColour::kSeries2, .filled = false, .size = 2.0};
  std::vector<double> failed_s;
  Figure figure;
  figure.alt = "Typical error of held-out ranges by window length:";
  for (const std::size_t i : by_length(windows)) {
    const double length = windows.lengths_s[i], error = windows.held_out_m[i];
    const bool predicts = std::isfinite(error);
    figure.alt +=
        fmt::format(" {:.3g} s {};", length, predicts ? error_text(error) : "predicts nothing");
    if (!predicts) {
      failed_s.push_back(length);
      continue;
    }
    const Point at{length, axis.raised({error}).front()};
    add_point(curve, at);
    if (length != windows.chosen_s) continue;
    add_point(chosen, at);
    chosen.marks.push_back({"chosen", {{"x", data_number(length)}, {"y", data_number(error)}}});
  }
  figure.alt.back() = '.';
  figure.id = spec.id;
  figure.title = spec.title;
  figure.record_ids = {spec.record_id};
  const std::string length = fmt::format("{:.3g}", windows.chosen_s);
  figure.caption = fmt::format(
      "Typical error of ranges that were held out, by window length; chosen: {} s, the least error "
      "among the lengths that give ranges at the most times. No ground truth enters the choice.",
      length);
  figure.alt += fmt::format(" Chosen: {} s.", length);
  Panel& panel = figure.panels.emplace_back();
  panel.x = {.label = "window length [s]", .scale = Scale::kLog};
  panel.y = {.label = "held-out range error [m]", .scale = axis.scale, .limits = axis.limits};
  panel.layers = {curve, chosen};
  std::erase_if(panel.layers, is_empty);
  if (!failed_s.empty()) {
    const std::string failed = failed_words(failed_s);
    figure.caption += " " + failed;
    figure.notes.push_back({failed, ThemeColour::kText});
  }
  if (panel.layers.empty() && failed_s.empty())
    figure.notes.push_back({"No length was tried.", ThemeColour::kWarning});
  require_valid(figure);
  return figure;
}

Figure convergence_figure(const std::string& id, const ConvergenceCurve& curve) {
  LogLogSpec spec = spec_of(id, "Convergence of the map with the number of ranges", curve);
  const ErrorLine observation =
      line_of(curve, &ConvergencePoint::observation, "measured", "observation");
  const ErrorLine landmarks =
      line_of(curve, &ConvergencePoint::landmarks_m, "measured", "landmarks");
  spec.panels = {{"Observation model", kMeasurements, kObservation, {observation}, kRootLaw, {}},
                 {"Landmarks", kMeasurements, "error [m]", {landmarks}, kRootLaw, {}}};
  Figure figure = log_log_figure(spec);
  figure.caption = fmt::format(
      "{} Error of \u0108: Frobenius norm. Slopes by least squares: {} and {}; "
      "theory: \u22121/2.",
      means_of(curve, figure), slope_of(observation), slope_of(landmarks));
  return figure;
}

Figure subspace_angle_figure(const std::string& id, const ConvergenceCurve& curve) {
  LogLogSpec spec = spec_of(id, "", curve);
  const ErrorLine sine = line_of(curve, &ConvergencePoint::sine, "measured", "sine");
  ErrorLine bound{.label = "bound, eq. 5", .key = "bound"};
  for (const ConvergencePoint& point : curve.points) bound.mean.push_back(point.bound);
  bound.x = sine.x;
  spec.title = angle_title(sine, bound);
  spec.panels = {
      {"", kMeasurements, "sine of the largest canonical angle", {sine}, std::nullopt, {bound}}};
  Figure figure = log_log_figure(spec);
  figure.caption = fmt::format(
      "{} Dashed: N c \u221A(2 log T / T) / \u03B3, its constant fitted at the first point. Slope "
      "of the measured sine: {}.",
      means_of(curve, figure), slope_of(sine));
  return figure;
}

Figure positions_figure(const std::string& id, const ConvergenceCurve& curve) {
  LogLogSpec spec = spec_of(id, "The map converges, single positions do not", curve);
  const ErrorLine landmarks =
      line_of(curve, &ConvergencePoint::landmarks_m, "landmarks", "landmarks");
  ErrorLine positions =
      line_of(curve, &ConvergencePoint::positions_m, "robot\u2019s positions", "positions");
  spec.panels = {{"", kMeasurements, "error [m]", {landmarks, positions}, kRootLaw, {}}};
  Figure figure = log_log_figure(spec);
  figure.caption = fmt::format(
      "{} A landmark is seen again and again, a position by {} alone: its error ends at what these "
      "allow. Slopes: {} and {}.",
      means_of(curve, figure), counted(curve.landmarks, "measurement"), slope_of(landmarks),
      slope_of(positions));
  return figure;
}

Figure noise_models_figure(const std::string& id, std::span<const ConvergenceCurve> curves) {
  LogLogSpec spec;
  spec.id = id;
  spec.title = noise_title(curves);
  spec.columns = 1;  // The noise is described in the legend, which is that of all panels.
  LogLogPanel observation{"Observation model", kMeasurements, kObservation, {}, kRootLaw, {}};
  LogLogPanel landmarks{"Landmarks", kMeasurements, "error [m]", {}, kRootLaw, {}};
  std::string slopes;
  for (const ConvergenceCurve& curve : curves) {
    observation.lines.push_back(
        line_of(curve, &ConvergencePoint::observation, curve.title, "observation-" + curve.id));
    landmarks.lines.push_back(
        line_of(curve, &ConvergencePoint::landmarks_m, curve.title, "landmarks-" + curve.id));
    slopes += fmt::format("{}{} {}", slopes.empty() ? "" : "; ", curve.title,
                          slope_of(observation.lines.back()));
    spec.record_ids.push_back("convergence/" + curve.id);
  }
  spec.panels = {std::move(observation), std::move(landmarks)};
  Figure figure = log_log_figure(spec);
  figure.shared_x = true;
  figure.caption = fmt::format("Means and 95 % intervals{}. Slopes of the observation model: {}.",
                               arrow_words(figure), slopes.empty() ? "none" : slopes);
  return figure;
}

Figure factorization_cost_figure(const std::string& id, std::span<const FactorizationCost> costs) {
  LogLogSpec spec;
  spec.id = id;
  spec.title = factorization_title(costs);
  spec.varies = true;
  spec.caption =
      "Time of singular values and upgrade, the least of five, over the number of steps T and of "
      "landmarks N, with the slopes of O((2N)\u00B2 T). It varies from run to run.";
  double longest_s = 0.0;
  for (const FactorizationCost& cost : costs) longest_s = std::max(longest_s, cost.seconds);
  const ScaledUnit unit = scaled_unit("s", longest_s);
  const std::string label = fmt::format("time [{}]", unit.unit);
  spec.panels = {{"Over steps",
                  "steps T",
                  label,
                  cost_lines(costs, true, unit.factor),
                  SlopeGuide{"slope 1", 1.0},
                  {}},
                 {"Over landmarks",
                  "landmarks N",
                  label,
                  cost_lines(costs, false, unit.factor),
                  SlopeGuide{"slope 2", 2.0},
                  {}}};
  return log_log_figure(spec);
}

}  // namespace mapproof
