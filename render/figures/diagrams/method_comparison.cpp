#include "render/figures/diagrams/method_comparison.hpp"

#include <algorithm>
#include <cmath>
#include <functional>

#include <fmt/format.h>

#include "core/base/errors.hpp"
#include "core/base/text/error_text.hpp"
#include "core/base/text/number_text.hpp"
#include "core/base/text/words.hpp"
#include "core/statistics/nemenyi.hpp"
#include "render/figures/curves/diverged.hpp"
#include "render/figures/curves/error_lines.hpp"
#include "render/figures/layer_shapes.hpp"
#include "render/figures/unit_scale.hpp"
#include "render/plot/short_names.hpp"

namespace mapproof {
namespace {

bool is_drawn(double error_m) { return std::isfinite(error_m) && error_m > 0.0; }

/// Those that a logarithmic axis takes, the greatest error first: row 0 is lowest.
std::vector<PublishedError> drawn_methods(const PublishedErrorsSpec::Sensor& sensor) {
  std::vector<PublishedError> methods;
  for (PublishedError method : sensor.methods) {
    if (!is_drawn(method.mean_m)) continue;
    if (method.published_m && !is_drawn(*method.published_m)) method.published_m.reset();
    methods.push_back(std::move(method));
  }
  std::ranges::stable_sort(methods, std::greater<>(), &PublishedError::mean_m);
  return methods;
}

bool is_outside(const PublishedError& method) {
  return method.interval && method.published_m && method.can_compare &&
         !(*method.published_m >= method.interval->low &&
           *method.published_m <= method.interval->high);
}

std::string title_of(const PublishedAgreement& all) {
  if (all.compared == 0) return "Errors of the methods, ours and published";
  return fmt::format("{} of {}{} published errors lie within our 95 % intervals", all.within,
                     all.compared, all.apart > 0 ? " comparable" : "");
}

std::string note_of(const PublishedAgreement& all) {
  const int outside = all.compared - all.within;
  if (outside == 0) return "";
  if (all.ours_smaller == outside)
    return outside == 1 ? "In the other one our error is smaller."
                        : fmt::format("In the other {} our error is smaller.", outside);
  return fmt::format("Of the other {}, our error is smaller in {} and larger in {}.", outside,
                     all.ours_smaller, outside - all.ours_smaller);
}

Mark mark_of(const PublishedError& method, std::size_t panel, const char* whose, double error_m) {
  Mark mark{fmt::format("{}-{}-{}", whose, panel, method.key),
            {{"method", method.label}, {"mpe", data_number(error_m)}}};
  if (error_m > kGreatestError_m) mark.data.emplace_back("x", kGreatErrorText);
  return mark;
}

/// The errors of all sensors, ours with their intervals up to where maps diverge, if these did not.
std::vector<double> errors_of(const PublishedErrorsSpec& spec) {
  std::vector<double> errors;
  for (const PublishedErrorsSpec::Sensor& sensor : spec.sensors)
    for (const PublishedError& method : drawn_methods(sensor)) {
      errors.push_back(method.mean_m);
      if (method.published_m) errors.push_back(*method.published_m);
      const bool has_diverged = method.mean_m > kGreatestError_m;
      if (has_diverged || !method.interval || !is_drawn(method.interval->low)) continue;
      for (const double end : {method.interval->low, method.interval->high})
        errors.push_back(std::min(end, kGreatestError_m));
    }
  return errors;
}

/// By method and sensor, of ours.
std::vector<DivergedCount> count_diverged(const PublishedErrorsSpec& spec) {
  std::vector<DivergedCount> counts;
  for (const PublishedErrorsSpec::Sensor& sensor : spec.sensors)
    for (const PublishedError& method : sensor.methods) {
      auto count = std::ranges::find(counts, method.label, &DivergedCount::label);
      if (count == counts.end()) count = counts.insert(count, {.label = method.label});
      count->see(method.mean_m, kGreatestError_m);
    }
  return counts;
}

void add_panel(Figure& figure, const PublishedErrorsSpec::Sensor& sensor, const DotAxis& axis) {
  const std::vector<PublishedError> methods = drawn_methods(sensor);
  const std::size_t number = figure.panels.size();
  Panel& panel = figure.panels.emplace_back();
  panel.title = sensor.title;
  panel.x = {.label = "MPE [m]", .scale = Scale::kLog, .limits = axis.limits};
  panel.y = {.label = ""};
  panel.y.limits = Range{-0.6, std::max(1.0, static_cast<double>(methods.size())) - 0.4};
  Segments intervals{.label = "95 % interval", .colour = ThemeColour::kSeries1, .width = 2.5};
  Scatter ours{.label = "ours", .colour = ThemeColour::kSeries1, .marker = Marker::kCircle};
  Scatter published{.label = "published",
                    .colour = ThemeColour::kSeries2,
                    .marker = Marker::kDiamond,
                    .filled = false,
                    .size = 1.3};
  Scatter outside = published, apart = published;
  outside.label = "published, outside the interval";
  outside.filled = true;
  apart.label = "published, not comparable";
  apart.colour = ThemeColour::kMuted;
  Scatter diverged = diverged_dots(ours.colour);
  for (std::size_t i = 0; i < methods.size(); ++i) {
    const PublishedError& method = methods[i];
    const double y = static_cast<double>(i);
    panel.y.names.push_back(method.label);
    const bool has_diverged = method.mean_m > axis.ceiling;
    if (method.interval && is_drawn(method.interval->low) && !has_diverged) {
      add_line(intervals, {method.interval->low, y}, {method.interval->high, y});
      intervals.marks.push_back({"", {{"method", method.label}, {"kind", "interval"}}});
    }
    Scatter& mean = has_diverged ? diverged : ours;
    add_point(mean, {axis.place_of(method.mean_m), y});
    mean.marks.push_back(mark_of(method, number, "ours", method.mean_m));
    if (!method.published_m) continue;
    Scatter& theirs = !method.can_compare ? apart : is_outside(method) ? outside : published;
    add_point(theirs, {axis.place_of(*method.published_m), y});
    theirs.marks.push_back(mark_of(method, number, "published", *method.published_m));
  }
  // Ours show in open diamonds.
  panel.layers = {intervals, published, outside, apart, ours, diverged};
  std::erase_if(panel.layers, is_empty);
}

constexpr std::size_t kMostMethods = 30;
constexpr double kBarStep = 0.4;          // Between bars, in rows of labels.
constexpr std::size_t kColumnLabel = 17;  // Characters in a line of a label, in a journal's column.
constexpr std::size_t kMostFurtherLines = 23;  // A name in a figure has no more.
constexpr double kFurtherLine = 0.5;           // In rows: on wider pages a label has fewer lines.

void require_consistent(const CriticalDifferenceSpec& spec) {
  const auto refuse = [&spec](const std::string& what) {
    throw InvalidInput("figure " + printable(spec.id) + ": " + what);
  };
  if (spec.methods.size() > kMostMethods) refuse("more than 30 methods");
  if (!(spec.critical_difference > 0.0) || !std::isfinite(spec.critical_difference))
    refuse("the critical difference is not positive");
  for (const RankedMethod& method : spec.methods)
    if (!(method.mean_rank >= 1.0 && method.mean_rank <= static_cast<double>(spec.methods.size())))
      refuse("the mean rank of " + printable(method.label) + " is out of range");
}

/// Draws in rows of labels: 0 is the axis of ranks, labels count downward.
class Diagram {
 public:
  explicit Diagram(const CriticalDifferenceSpec& spec) : spec_(spec), methods_(spec.methods) {
    std::ranges::stable_sort(methods_, {}, &RankedMethod::mean_rank);
    std::vector<double> ranks;
    for (const RankedMethod& method : methods_) ranks.push_back(method.mean_rank);
    groups_ = alike_groups(ranks, spec.critical_difference);
    highest_ = std::max(2.0, static_cast<double>(methods_.size()));
    place_rows();
  }

  Panel panel() {
    draw_axis();
    draw_difference();
    for (std::size_t g = 0; g < groups_.size(); ++g) draw_group(g);
    for (std::size_t i = 0; i < methods_.size(); ++i) draw_method(i);
    Panel panel;
    panel.bare = true;
    const double margin = 0.02 * (highest_ - 1.0);
    panel.x.limits = Range{1.0 - margin, highest_ + margin};
    panel.y.limits = Range{-first_row() - rows_ + 0.4, 2.9};
    panel.layers = {lines_, bars_, difference_, open_difference_, dots_, numbers_, left_, right_};
    std::erase_if(panel.layers, is_empty);
    return panel;
  }

  const std::vector<RankedMethod>& methods() const { return methods_; }
  const std::vector<std::vector<int>>& groups() const { return groups_; }

  /// No two mean ranks can then differ by the critical difference.
  bool beyond_axis() const { return 1.0 + spec_.critical_difference > highest_; }

 private:
  void draw_axis() {
    add_line(lines_, {1.0, 0.0}, {highest_, 0.0});
    const int step = number_step();
    for (int rank = 1; rank <= static_cast<int>(highest_); ++rank) {
      add_line(lines_, {static_cast<double>(rank), 0.0}, {static_cast<double>(rank), 0.25});
      if ((rank - 1) % step == 0)
        add_text(numbers_, {static_cast<double>(rank), 0.75}, std::to_string(rank));
    }
  }

  /// From one rank with a number to the next: between long names the axis is short in a column of a
  /// journal.
  int number_step() const {
    constexpr double kMostSteps = 5.0;
    int step = highest_ > 16.0 ? 5 : highest_ > 6.0 ? 2 : 1;
    const bool are_long = std::ranges::any_of(methods_, [](const RankedMethod& method) {
      return short_name(method.label).size() > kColumnLabel / 2;
    });
    while (are_long && (highest_ - 1.0) / step > kMostSteps) step = step == 2 ? 5 : 2 * step;
    return step;
  }

  /// The length of the critical difference above the axis; an arrow if it is longer than the axis.
  void draw_difference() {
    const double end = std::min(1.0 + spec_.critical_difference, highest_);
    add_line(difference_, {1.0, 1.55}, {1.0, 1.85});
    if (beyond_axis()) {
      add_line(open_difference_, {1.0, 1.7}, {end, 1.7});
    } else {
      add_line(difference_, {1.0, 1.7}, {end, 1.7});
      add_line(difference_, {end, 1.55}, {end, 1.85});
    }
    add_text(numbers_, {(1.0 + end) / 2.0, 2.4}, "CD = " + significant(spec_.critical_difference));
  }

  void draw_group(std::size_t g) {
    const double y = -kBarStep * static_cast<double>(g + 1);
    const double reach = 0.008 * (highest_ - 1.0);
    add_line(bars_, {methods_[groups_[g].front()].mean_rank - reach, y},
             {methods_[groups_[g].back()].mean_rank + reach, y});
  }

  /// Down from the axis, then out to the label: the better half to the left.
  void draw_method(std::size_t i) {
    const double rank = methods_[i].mean_rank;
    const bool to_left = i < left_count();
    const double y = -first_row() - below_first_[i];
    add_line(lines_, {rank, 0.0}, {rank, y});
    add_line(lines_, {rank, y}, {to_left ? 1.0 : highest_, y});
    add_point(dots_, {rank, 0.0});
    dots_.marks.push_back({fmt::format("method-{}", i + 1),
                           {{"method", methods_[i].label}, {"rank", data_number(rank)}}});
    const std::string text = fmt::format("{} {:.2f}", methods_[i].label, rank);
    const double side = 0.012 * (highest_ - 1.0);
    if (to_left)
      add_text(left_, {1.0 - side, y}, text);
    else
      add_text(right_, {highest_ + side, y}, text);
  }

  std::size_t left_count() const { return (methods_.size() + 1) / 2; }

  /// What a label takes of a side, in rows: it has several lines in a column of a journal.
  static double height_of(const RankedMethod& method) {
    const std::size_t further = short_name(method.label).size() / kColumnLabel;
    return 1.0 + kFurtherLine * static_cast<double>(std::min(further, kMostFurtherLines));
  }

  /// Each side from above to below, the best and the worst method first.
  void place_rows() {
    below_first_.resize(methods_.size());
    double left = 0.0, right = 0.0;
    const auto place = [&](std::size_t i, double& taken) {
      const double height = height_of(methods_[i]);
      below_first_[i] = taken + (height - 1.0) / 2.0;
      taken += height;
    };
    for (std::size_t i = 0; i < left_count(); ++i) place(i, left);
    for (std::size_t i = methods_.size(); i-- > left_count();) place(i, right);
    rows_ = std::max(left, right);
  }

  /// Below all bars.
  double first_row() const { return kBarStep * static_cast<double>(groups_.size()) + 0.8; }

  const CriticalDifferenceSpec& spec_;
  std::vector<RankedMethod> methods_;
  std::vector<std::vector<int>> groups_;
  double highest_ = 2.0;
  std::vector<double> below_first_;  ///< From the first row to the middle of each label, in rows.
  double rows_ = 0.0;                ///< What the side with more of them takes.
  Segments lines_{.colour = ThemeColour::kText, .width = 0.6};
  Segments bars_{.colour = ThemeColour::kMuted, .width = 3.0};  // Not that of a method.
  Segments difference_{.colour = ThemeColour::kText};
  Segments open_difference_{.colour = ThemeColour::kText, .arrow = true};
  Scatter dots_{.colour = ThemeColour::kText, .size = 0.7};
  Texts numbers_;
  Texts left_{.align = Align::kEnd};
  Texts right_{.align = Align::kStart};
};

std::string words_of(const Diagram& diagram) {
  std::string text;
  for (const RankedMethod& method : diagram.methods())
    text += fmt::format(" {} {:.2f};", method.label, method.mean_rank);
  if (!text.empty()) text.back() = '.';
  for (const std::vector<int>& group : diagram.groups()) {
    std::vector<std::string> names;
    for (const int i : group) names.push_back(diagram.methods()[i].label);
    text += " No difference between " + listed(names, 12) + ".";
  }
  return text;
}

std::string probability(double p) { return p < 0.001 ? "p < 0.001" : "p = " + significant(p, 2); }

constexpr int kMostNamedSettings = 14;  // Of more settings only those on the front are named.

bool usable(const CostedSetting& setting) {
  return setting.seconds > 0.0 && !std::isnan(setting.mpe_m);
}

std::vector<double> errors_of(const std::vector<CostedSetting>& settings) {
  std::vector<double> errors_m;
  for (const CostedSetting& one : settings)
    if (usable(one)) errors_m.push_back(one.mpe_m);
  return errors_m;
}

/// Above which a mean error is that of maps that diverged [m].
double divergence_m() { return divergence_in("m", true); }

/// An axis of errors, and where triangles stand for those that are not on it.
struct ParetoAxis {
  ErrorAxis axis;
  double ceiling = kInfinity;

  explicit ParetoAxis(const std::vector<double>& errors_m)
      : axis(error_axis(without_diverged(errors_m, divergence_m()), {}, 8.0)),
        ceiling(axis_ceiling(errors_m, divergence_m())) {}

  bool holds(double error_m) const { return error_m <= ceiling; }
};

/// The points of a Pareto figure and the words on them.
struct ParetoLayers {
  Polyline steps{.label = "Pareto front",
                 .colour = ThemeColour::kSeries2,
                 .dash = Dash::kDashed,
                 .mark = {"front", {}}};
  Scatter best{
      .label = "on the front", .colour = ThemeColour::kSeries2, .marker = Marker::kDiamond};
  Scatter beaten{.label = "dominated", .colour = ThemeColour::kSeries1, .filled = false};
  Scatter diverged = diverged_dots(ThemeColour::kSeries1);
  PointLabels names;
  std::vector<std::string> words;  ///< Of those on the front.
};

void add_setting(Scatter& points, const CostedSetting& one, Point at, std::size_t i) {
  add_point(points, at);
  points.marks.push_back({fmt::format("setting-{}", i + 1),
                          {{"setting", one.label}, {"error", data_number(one.mpe_m)}}});
}

/// @param unit  Of the times.
ParetoLayers layers_of(const std::vector<CostedSetting>& settings, const ScaledUnit& unit,
                       const ParetoAxis& axis) {
  ParetoLayers layers;
  const std::vector<std::size_t> front = pareto_front(settings);
  for (const std::size_t i : front) {
    const CostedSetting& one = settings[i];
    const double time = unit.factor * one.seconds;
    if (!layers.steps.x.empty()) add_point(layers.steps, {time, layers.steps.y.back()});
    add_point(layers.steps, {time, one.mpe_m});
    add_setting(layers.best, one, {time, one.mpe_m}, i);
    add_label(layers.names, {time, one.mpe_m}, one.label);
    layers.words.push_back(
        fmt::format("{} ({} in {})", one.label, error_text(one.mpe_m), seconds_text(one.seconds)));
  }
  const bool crowded = std::ranges::count_if(settings, usable) > kMostNamedSettings;
  for (std::size_t i = 0; i < settings.size(); ++i) {
    const CostedSetting& one = settings[i];
    if (!usable(one) || std::ranges::find(front, i) != front.end()) continue;
    const bool is_shown = axis.holds(one.mpe_m);
    const Point at{unit.factor * one.seconds,
                   is_shown ? one.mpe_m : near_end(axis.axis.scale, axis.axis.limits)};
    add_setting(is_shown ? layers.beaten : layers.diverged, one, at, i);
    if (!crowded) add_label(layers.names, at, one.label);
  }
  return layers;
}

void require_costs(const ParetoSpec& spec) {
  for (const CostedSetting& one : spec.settings)
    if (std::isinf(one.seconds) || std::isinf(one.mpe_m) || one.seconds < 0.0 || one.mpe_m < 0.0)
      throw InvalidInput("figure " + printable(spec.id) + ": " + printable(one.label) +
                         ": a value is infinite or negative");
}

}  // namespace

PublishedAgreement& PublishedAgreement::operator+=(const PublishedAgreement& other) {
  compared += other.compared;
  within += other.within;
  ours_smaller += other.ours_smaller;
  apart += other.apart;
  return *this;
}

PublishedAgreement agreement_of(std::span<const PublishedError> methods) {
  PublishedAgreement all;
  for (const PublishedError& method : methods) {
    if (!method.published_m) continue;
    if (!method.can_compare) {
      ++all.apart;
      continue;
    }
    if (!method.interval) continue;
    ++all.compared;
    if (!is_outside(method))
      ++all.within;
    else if (*method.published_m > method.interval->high)
      ++all.ours_smaller;
  }
  return all;
}

Figure published_errors_figure(const PublishedErrorsSpec& spec) {
  PublishedAgreement agreement;
  for (const PublishedErrorsSpec::Sensor& sensor : spec.sensors)
    agreement += agreement_of(sensor.methods);
  Figure figure;
  figure.id = spec.id;
  figure.title = title_of(agreement);
  if (const std::string note = note_of(agreement); !note.empty()) figure.notes.push_back({note});
  figure.record_ids = spec.record_ids;
  note_diverged(count_diverged(spec), "with", "sensors", figure.notes);
  const DotAxis axis = dot_axis(errors_of(spec), Scale::kLog, kGreatestError_m);
  std::vector<std::string> sources, errors;
  for (const PublishedErrorsSpec::Sensor& sensor : spec.sensors) {
    add_panel(figure, sensor, axis);
    sources.push_back(sensor.source);
    for (const PublishedError& method : sensor.methods)
      if (method.published_m)
        errors.push_back(fmt::format(
            "{} {} (published {})", method.label,
            method.mean_m > kGreatestError_m ? kGreatErrorText : significant(method.mean_m),
            significant(*method.published_m)));
  }
  figure.caption = fmt::format(
      "Mean position error (MPE) of each method at its best parameter, with the 95 % interval of "
      "the mean, and the error printed in {}, which may belong to another parameter. {}The methods "
      "are in the order of our errors.",
      listed(sources, 4),
      agreement.apart > 0 ? "Printed errors in grey cannot be compared, for reasons in the tables "
                            "of the study, and are not counted. "
                          : "");
  figure.alt = fmt::format("MPE in metres, ours and published: {}.",
                           errors.empty() ? "none" : listed(errors, 12));
  figure.shared_x = figure.panels.size() > 1;
  require_valid(figure);
  return figure;
}

std::string ranking_title(const CriticalDifferenceSpec& spec, const std::string& by) {
  if (spec.methods.empty()) return "";
  const RankedMethod& best = *std::ranges::min_element(spec.methods, {}, &RankedMethod::mean_rank);
  const auto alike =
      std::ranges::count_if(spec.methods,
                            [&](const RankedMethod& method) {
                              return method.mean_rank - best.mean_rank < spec.critical_difference;
                            }) -
      1;
  const auto others = std::ssize(spec.methods) - 1;
  const std::string others_words =
      alike == 0        ? "all others rank significantly lower"
      : alike == others ? "no other differs from it significantly"
                        : fmt::format("{} of {} others rank{} significantly lower", others - alike,
                                      others, others - alike == 1 ? "s" : "");
  constexpr std::size_t kMostNamed = 2;
  std::vector<std::string> names;  // Those whose labels have the same rank.
  for (const RankedMethod& method : spec.methods)
    if (fmt::format("{:.2f}", method.mean_rank) == fmt::format("{:.2f}", best.mean_rank))
      names.push_back(without_parameters(short_method_name(method.label)));
  return fmt::format("{} rank{} best by {}; {}", listed(names, kMostNamed),
                     names.size() == 1 ? "s" : "", by, others_words);
}

Figure critical_difference_figure(const CriticalDifferenceSpec& spec) {
  require_consistent(spec);
  Diagram diagram(spec);
  Figure figure;
  figure.id = spec.id;
  figure.title = spec.title;
  figure.record_ids = spec.record_ids;
  figure.panels.push_back(diagram.panel());
  const std::string units = counted(static_cast<std::size_t>(std::max(spec.units, 0)), spec.unit);
  figure.notes.push_back(
      {fmt::format("Mean ranks over {}; Friedman {}.", units, probability(spec.friedman_p))});
  if (spec.friedman_p > spec.alpha)
    figure.notes.push_back({"The Friedman test finds no difference: the bars have no meaning.",
                            ThemeColour::kWarning});
  if (!spec.methods.empty() && diagram.beyond_axis())
    figure.notes.push_back(
        {"CD is longer than the axis (arrow): with so few units no difference is significant.",
         ThemeColour::kWarning});
  if (spec.methods.empty())
    figure.notes.push_back({"There are no methods.", ThemeColour::kWarning});
  figure.caption = fmt::format(
      "Mean ranks of {} over {}, the best to the left. Bars join methods that do not differ: their "
      "ranks are less than the critical difference {} apart (Nemenyi, α = {}). Friedman test: {}.",
      counted(spec.methods.size(), "method"), units, significant(spec.critical_difference),
      data_number(spec.alpha), probability(spec.friedman_p));
  figure.alt = fmt::format("Critical-difference diagram, CD {}. Mean ranks:{}",
                           significant(spec.critical_difference), words_of(diagram));
  require_valid(figure);
  return figure;
}

std::vector<std::size_t> pareto_front(const std::vector<CostedSetting>& settings) {
  const double ceiling = axis_ceiling(errors_of(settings), divergence_m());
  std::vector<std::size_t> order;
  for (std::size_t i = 0; i < settings.size(); ++i)
    if (usable(settings[i]) && settings[i].mpe_m <= ceiling) order.push_back(i);
  std::ranges::stable_sort(order, [&](std::size_t a, std::size_t b) {
    return std::pair(settings[a].seconds, settings[a].mpe_m) <
           std::pair(settings[b].seconds, settings[b].mpe_m);
  });
  std::vector<std::size_t> front;
  for (const std::size_t i : order)
    if (front.empty() || settings[i].mpe_m < settings[front.back()].mpe_m) front.push_back(i);
  return front;
}

Figure pareto_figure(const ParetoSpec& spec) {
  require_costs(spec);
  const std::vector<double> errors_m = errors_of(spec.settings);
  const ParetoAxis axis(errors_m);
  double longest_s = 0.0;
  std::vector<DivergedCount> diverged;
  for (const CostedSetting& one : spec.settings) {
    if (!usable(one)) continue;
    longest_s = std::max(longest_s, one.seconds);
    diverged.push_back({one.label});
    diverged.back().see(one.mpe_m, divergence_m());
  }
  const ScaledUnit unit = scaled_unit("s", longest_s);
  const ParetoLayers layers = layers_of(spec.settings, unit, axis);

  Figure figure;
  figure.id = spec.id;
  figure.title = spec.title;
  figure.record_ids = spec.record_ids;
  figure.varies = true;
  Panel& panel = figure.panels.emplace_back();
  panel.x.label = fmt::format("time per map [{}]", unit.unit);
  panel.x.scale = Scale::kLog;
  panel.y.label = spec.y_label;
  panel.y.scale = axis.axis.scale;
  panel.y.limits = axis.axis.limits;
  // A front of one setting has its line, too: with other times it may have two settings, and the
  // figure must have the same layers then.
  if (errors_m.size() > 1) panel.layers.emplace_back(layers.steps);
  panel.layers.insert(panel.layers.end(),
                      {layers.beaten, layers.best, layers.diverged, layers.names});
  std::erase_if(panel.layers, is_empty);

  figure.caption =
      "Mean error against the median time per map, that of the maps it starts from included, a "
      "point per setting; filled: no other is both faster and better. Times are of one start of "
      "the program and differ from one to the next.";
  figure.alt = fmt::format("{} against the time per map for {}.", spec.y_label,
                           counted(static_cast<long long>(errors_m.size()), "setting"));
  if (!layers.words.empty())
    figure.alt += " On the Pareto front: " + listed(layers.words, 12) + ".";
  if (errors_m.empty()) figure.notes.push_back({"There are no settings.", ThemeColour::kWarning});
  note_diverged(diverged, "at", "points", figure.notes);
  if (!spec.untimed.empty())
    figure.notes.push_back({fmt::format("Not timed, and not shown: {}.", listed(spec.untimed, 4)),
                            ThemeColour::kWarning});
  require_valid(figure);
  return figure;
}

}  // namespace mapproof
