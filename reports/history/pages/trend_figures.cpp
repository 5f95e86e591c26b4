#include "reports/history/pages/trend_figures.hpp"

#include <algorithm>
#include <cmath>
#include <compare>
#include <functional>
#include <iterator>
#include <limits>
#include <map>
#include <numeric>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "core/base/median.hpp"
#include "core/base/not_finite.hpp"
#include "core/base/text/number_text.hpp"
#include "core/base/text/slug.hpp"
#include "core/base/text/words.hpp"
#include "core/model/method.hpp"
#include "core/statistics/intervals.hpp"
#include "render/figures/curves/error_lines.hpp"
#include "render/figures/curves/method_series.hpp"
#include "render/figures/diagrams/value_dots.hpp"
#include "reports/history/finding_groups.hpp"
#include "reports/history/great_medians.hpp"
#include "reports/history/shown_names.hpp"
#include "reports/model/format.hpp"

namespace mapproof {
namespace {

/// Entries of a legend. More lines would hide each other; the table has all.
constexpr std::size_t kMostLines = 12;

constexpr const char* kFound = "a finding";

/// A part of an id.
std::string id_of(const std::string& name) {
  const std::string slug = slug_of(name);
  return slug.empty() ? "other" : slug;
}
/// Over the nightly runs; infinite if none has a value.
double level_over_nightly_runs(const std::vector<double>& values) {
  std::vector<double> known;
  std::ranges::copy_if(values, std::back_inserter(known),
                       [](double v) { return std::isfinite(v); });
  return known.empty() ? kInfinity : median(known);
}

/// The style of each method that the study declares, in all figures, its report's too.
std::map<std::string, std::size_t> method_styles(const StudyTrend& trend) {
  std::map<std::string, std::set<std::string>> setups_by_method;
  for (const auto& [series, values] : trend.medians)
    setups_by_method[base_method(trend.labels, series.method)].insert(series.sensor);
  std::vector<std::string> ids, shown;
  std::vector<std::set<std::string>> setups;
  if (!trend.labels.methods.empty()) ids = trend.labels.ordered();
  for (const std::string& id : ids) {
    shown.push_back(trend.labels.methods.at(id));
    setups.push_back(setups_by_method[id]);
  }
  const std::vector<std::size_t> series = series_of_methods(ids, shown, setups);
  std::map<std::string, std::size_t> styles;
  for (std::size_t i = 0; i < ids.size(); ++i) styles[ids[i]] = series[i];
  return styles;
}

/// A trend with what was found of it.
struct Reported {
  const StudyTrend& trend;
  std::vector<std::pair<std::size_t, const NightlyFinding*>>
      findings;  ///< By the index of the nightly run.
  const TrendLocation& location;
  std::map<std::string, std::size_t> method_styles;
  std::vector<NightlyFinding> last = {};       ///< The findings of the last nightly run.
  std::vector<FindingGroup> last_groups = {};  ///< Of these: what is new goes first.
  std::size_t base = 0;  ///< The index of the nightly run that changes are shown against.
};

/// Of mapproof's own methods where the study declares none.
std::optional<std::size_t> style_of(const Reported& reported, const std::string& method) {
  const std::string base = base_method(reported.trend.labels, method);
  if (const auto found = reported.method_styles.find(base); found != reported.method_styles.end())
    return found->second;
  if (!reported.trend.labels.methods.empty()) return std::nullopt;
  const std::optional<Method> known = method_named(base);
  return known ? std::optional(method_series(*known)) : std::nullopt;
}

Reported reported_of(const StudyTrend& trend, const NightlyFindings& findings,
                     std::span<const NightlyNote> notes, const TrendLocation& location) {
  Reported reported{trend, {}, location, method_styles(trend)};
  for (std::size_t i = 0; i < trend.nightly_runs.size(); ++i)
    if (const auto nightly_run = findings.find(trend.nightly_runs[i].number);
        nightly_run != findings.end())
      for (const NightlyFinding& finding : nightly_run->second)
        if (finding.study == trend.name) reported.findings.emplace_back(i, &finding);
  for (const auto& [nightly_run, finding] : reported.findings)
    if (nightly_run + 1 == trend.nightly_runs.size()) reported.last.push_back(*finding);
  reported.last_groups =
      grouped(trend.nightly_runs.back().number, reported.last, std::span(&trend, 1), notes);
  reported.base = base_index(trend, reported.last);
  return reported;
}

/// Whether one is about it by name.
bool is_found(const Reported& reported, const SeriesId& id) {
  return std::ranges::any_of(reported.findings, [&](const auto& found) {
    return found.second->subject != kAllMethods && is_about(*found.second, id);
  });
}

struct Line {
  SeriesId id = {};
  const std::vector<double>* values = nullptr;
  bool is_found = false;
  /// What a legend calls the line: "ISOMAP, K = 6", or together with the others of its method
  /// "ISOMAP, 2 of 3 settings".
  std::string entry = {};
  std::string setting = {};  ///< "K = 6", of one of several of its method; else empty.
};

/// "all 16 settings", "2 of 3 settings".
std::string count_words(std::size_t shown, std::size_t all) {
  if (shown < all) return fmt::format("{} of {} settings", shown, all);
  return all == 2 ? "both settings" : fmt::format("all {} settings", all);
}

/// What distinguishes a setting from others of its method: "K = 6" of "ISOMAP, K = 6".
std::string setting_words(const StudyLabels& labels, const std::string& method) {
  const std::string shown = shown_method(labels, method),
                    begin = shown_method(labels, base_method(labels, method)) + ", ";
  return shown.starts_with(begin) ? shown.substr(begin.size()) : shown;
}

/// Names the lines of a figure. The settings of a method are one entry of its legend: they have the
/// colour, the dash and the marker of the method, and no other method has.
/// @param all  All settings, those that the figure does not show, too.
void name_lines(const StudyLabels& labels, const std::vector<Line>& all, std::vector<Line>& shown) {
  std::map<std::string, std::size_t> of_method, shown_of_method;
  for (const Line& line : all) ++of_method[base_method(labels, line.id.method)];
  for (const Line& line : shown) ++shown_of_method[base_method(labels, line.id.method)];
  for (Line& line : shown) {
    const std::string base = base_method(labels, line.id.method);
    const std::size_t count = shown_of_method[base];
    if (count > 1) line.setting = setting_words(labels, line.id.method);
    line.entry = count > 1 ? shown_method(labels, base) + ", " + count_words(count, of_method[base])
                           : shown_method(labels, line.id.method);
  }
}

/// The lines of the first kMostLines entries.
std::vector<Line> first_entries(std::vector<Line> lines) {
  std::set<std::string> entries;
  std::vector<Line> first;
  for (Line& line : lines) {
    if (entries.size() == kMostLines && !entries.contains(line.entry)) continue;
    entries.insert(line.entry);
    first.push_back(std::move(line));
  }
  return first;
}

/// The last step of each setting that has values.
std::vector<Line> all_settings(const Reported& reported, const std::string& sensor,
                               const std::string& quantity) {
  std::map<std::string, Line> last;  // Series ascend by step.
  for (const auto& [id, values] : reported.trend.medians)
    if (id.sensor == sensor && id.quantity == quantity)
      last[id.method] = {id, &values, is_found(reported, id)};
  std::vector<Line> lines;
  for (const auto& [method, line] : last)
    if (std::isfinite(level_over_nightly_runs(*line.values))) lines.push_back(line);
  return lines;
}

/// Of each method the setting that was best over the nightly runs, and all that have findings: one
/// that got worse may have been the best. In the order of their names.
std::vector<Line> shown_settings(const Reported& reported, const std::string& sensor,
                                 const std::string& quantity) {
  const std::vector<Line> all = all_settings(reported, sensor, quantity);
  std::map<std::string, const Line*> best;
  const bool higher = reported.trend.quantities.at(quantity).better == Better::kHigher;
  const auto is_better = [&](const Line& a, const Line& b) {
    const double level = level_over_nightly_runs(*a.values),
                 other = level_over_nightly_runs(*b.values);
    return higher ? level > other : level < other;
  };
  const auto is_variation = [&](const std::string& method) {
    const std::size_t levels = levels_begin(method);
    return levels < method.size() && std::ranges::any_of(all, [&](const Line& line) {
             return line.id.method == method.substr(0, levels);
           });
  };
  for (const Line& line : all) {
    if (is_variation(line.id.method)) continue;
    const Line*& known = best[base_method(reported.trend.labels, line.id.method)];
    if (known == nullptr || is_better(line, *known)) known = &line;
  }
  std::vector<Line> lines;
  for (const Line& line : all)
    if (line.is_found) lines.push_back(line);
  for (const auto& [method, line] : best)
    if (!line->is_found) lines.push_back(*line);
  name_lines(reported.trend.labels, all, lines);
  lines = first_entries(std::move(lines));
  std::ranges::sort(lines, {}, &Line::id);
  return lines;
}

constexpr std::size_t kDay = 10, kTime = 16;  ///< Digits of "2026-11-22 02:30 …" up to these.

/// The local date of a nightly run, "2026-11-22"; empty if it is not known.
std::string day_of(const NightlyFacts& nightly_run) {
  const std::string time = local_time(nightly_run);
  return time.size() >= kTime && time[4] == '-' ? time.substr(0, kDay) : "";
}

/// The local time of a nightly run, "02:30".
std::string minute_of(const NightlyFacts& nightly_run) {
  return local_time(nightly_run).substr(kDay + 1, kTime - kDay - 1);
}

/// "7: 11-22", the number and the local date of a nightly run.
std::string dated_tick(const NightlyFacts& nightly_run) {
  constexpr std::size_t kMonth = 5;  // In "2026-11-22".
  const std::string number = std::to_string(nightly_run.number), day = day_of(nightly_run);
  return day.empty() ? number : number + ": " + day.substr(kMonth);
}

/// Names an axis on which the nightly runs are side by side: by their dates; where all are of one
/// day by their times, and by their numbers alone where two of these are the same.
void name_nightly_runs(const StudyTrend& trend, Axis& axis) {
  const std::string day = day_of(trend.nightly_runs.front());
  const bool is_one_day =
      !day.empty() && std::ranges::all_of(trend.nightly_runs, [&](const NightlyFacts& other) {
        return day_of(other) == day;
      });
  std::set<std::string> times;
  for (const NightlyFacts& nightly_run : trend.nightly_runs)
    if (is_one_day) times.insert(minute_of(nightly_run));
  const bool by_time = is_one_day && times.size() == trend.nightly_runs.size();
  axis.label = by_time      ? "nightly run: time on " + day
               : is_one_day ? "nightly run, " + day
                            : "nightly run: date";
  for (const NightlyFacts& nightly_run : trend.nightly_runs) {
    const std::string number = std::to_string(nightly_run.number);
    axis.names.push_back(by_time      ? number + ": " + minute_of(nightly_run)
                         : is_one_day ? number
                                      : dated_tick(nightly_run));
  }
}

ErrorPanel panel_of(const StudyTrend& trend) {
  ErrorPanel panel;
  name_nightly_runs(trend, panel.x);
  panel.x.limits = Range{-0.5, static_cast<double>(trend.nightly_runs.size()) - 0.5};
  return panel;
}

std::vector<double> places_of(const StudyTrend& trend) {
  std::vector<double> x(trend.nightly_runs.size());
  std::iota(x.begin(), x.end(), 0.0);
  return x;
}

/// Values as changes since the nightly run of index `from`, or the first that has a value. NaN
/// where there is no such value.
/// @param change  Between two values: percent_change(), median_change().
template <typename Change>
std::vector<double> changes_of(const std::vector<double>& values, std::size_t from,
                               const Change& change) {
  double base = values[from];
  for (const double value : values)
    if (!std::isfinite(base)) base = value;
  std::vector<double> changes;
  for (const double value : values) changes.push_back(change(base, value));
  return changes;
}

std::string base_words(const Reported& reported) {
  return fmt::format("nightly run {}", reported.trend.nightly_runs[reported.base].number);
}

/// A mark at each nightly run's value of a line that a finding is about.
template <typename Predicate>
void mark_findings(const Reported& reported, const ErrorLine& line, const Predicate& is_about_it,
                   ErrorPanel& panel) {
  std::set<std::size_t> marked;
  for (const auto& [nightly_run, finding] : reported.findings)
    if (is_about_it(*finding) && std::isfinite(line.mean[nightly_run]) &&
        marked.insert(nightly_run).second)
      panel.points.push_back({.label = kFound,
                              .line = line.label,
                              .x = static_cast<double>(nightly_run),
                              .y = line.mean[nightly_run],
                              .setting = line.setting});
}

/// What all figures of a trend have in common.
ErrorLinesSpec named_spec(const Reported& reported, const std::string& id,
                          const std::string& title) {
  ErrorLinesSpec spec;
  const bool named = reported.location.among_others;
  spec.id = bounded_id("trend-" + (named ? id_of(reported.trend.name) + "-" : "") + id, kLongestId);
  spec.title = (named ? reported.trend.name + ", " : "") + title;
  return spec;
}

/// Ends the caption and draws it.
Figure drawn(ErrorLinesSpec spec, ErrorPanel panel, bool varies) {
  if (!panel.points.empty())
    spec.caption += " Large marks: nightly runs that have a finding about it.";
  spec.panels.push_back(std::move(panel));
  Figure figure = error_lines_figure(spec);
  // Changes lie around 0, by one percent or point at least: lines at 0 are in the middle.
  if (spec.quantity.starts_with("change of ")) {
    const Range found = figure.panels.front().y.limits.value_or(Range{0.0, 0.0});
    // What fell has the room at its edge that the figure leaves above.
    const double low = found.low < 0.0 ? found.low - 0.05 * (found.high - found.low) : found.low;
    figure.panels.front().y.limits = Range{std::min(low, -1.0), std::max(found.high, 1.0)};
  }
  figure.varies = varies;
  return figure;
}

/// A setup as a title or a sentence begins with it; a label of the study stays as it is.
std::string first_setup(const StudyLabels& labels, const std::string& sensor) {
  const std::string setup = shown_setup(labels, sensor);
  return labels.setups.contains(sensor) ? setup : capitalised(setup);
}

/// Of what has no finding: that an error has not got worse; of seconds, which may not be judged
/// yet, by how much they changed; of what is never judged between which values it is.
/// @param last  Of the lines in the last nightly run: changes in percent of seconds, else values.
std::string course_without_finding(const Quantity& quantity, const std::vector<double>& last) {
  if (is_accuracy(quantity.nightly)) return quantity.label + " has not got worse";
  if (last.empty()) return quantity.label;
  const auto [least, most] = std::ranges::minmax(last);
  if (quantity.nightly != NightlyRule::kDuration) {
    const std::string from = quantity_text(least, quantity.unit);
    const std::string to = quantity_text(most, quantity.unit);
    return fmt::format("{} is {} in the last nightly run", quantity.label,
                       from == to ? from : from + " to " + to);
  }
  return fmt::format("{} changed by {} to {}\u00a0%, without a finding", quantity.label,
                     format_number(least, 0, true), format_number(most, 0, true));
}

/// What got worse of a quantity in the last nightly run, or what else is to be said of it.
/// @param last  As for course_without_finding().
std::string course_of(const Reported& reported, const std::string& sensor, const Quantity& quantity,
                      const std::vector<double>& last) {
  const std::string setup = shown_setup(reported.trend.labels, sensor);
  std::vector<std::string> words;
  for (const FindingGroup& group : reported.last_groups)
    if (group.quantity_id == quantity.id && (group.setup == setup || group.setup.empty()))
      words.push_back(group.method + ": " + group.change_text() + (group.known ? " (known)" : ""));
  constexpr std::size_t kMostNamed = 2;
  const std::string text =
      words.empty() ? course_without_finding(quantity, last) : listed(words, kMostNamed);
  return setup.empty() ? text : first_setup(reported.trend.labels, sensor) + ": " + text;
}

std::ptrdiff_t count_known(const std::vector<double>& values) {
  return std::ranges::count_if(values, [](double value) { return std::isfinite(value); });
}

/// Of how many nightly runs the values can be compared: those of the line that has most of them.
std::ptrdiff_t compared_runs(const std::vector<Line>& lines) {
  std::ptrdiff_t most = 0;
  for (const Line& line : lines) most = std::max(most, count_known(*line.values));
  return most;
}

/// Whether a value differs from the first that is known by more than rounding.
bool has_changed(const std::vector<double>& values, const Tolerance& rounding) {
  const auto first =
      std::ranges::find_if(values, [](double value) { return std::isfinite(value); });
  return std::any_of(first, values.end(), [&](double value) {
    return std::isfinite(value) && !rounding.holds(*first, value);
  });
}

/// Whether there is a course to draw: a change over two nightly runs or more, or a finding.
bool has_course(const Reported& reported, const std::vector<Line>& lines,
                const Quantity& quantity) {
  if (compared_runs(lines) < 2) return false;
  return std::ranges::any_of(lines, [&](const Line& line) {
    const bool is_found = std::ranges::any_of(
        reported.findings, [&](const auto& found) { return is_about(*found.second, line.id); });
    return is_found || has_changed(*line.values, quantity.rounding);
  });
}

/// "; change 0 % in 2 nightly runs." of what did not change; of one nightly run which it is.
std::string without_change(const StudyTrend& trend, const std::vector<double>& values) {
  const std::ptrdiff_t known = count_known(values);
  if (known > 1) return fmt::format("; change 0\u00a0% in {} nightly runs.", known);
  std::size_t i = 0;
  while (i + 1 < values.size() && !std::isfinite(values[i])) ++i;
  return fmt::format(" in nightly run {}.", trend.nightly_runs[i].number);
}

/// What was measured where there is no course to draw: "Bearing: MPE from 0.06 m (SMACOF) to 0.3 m
/// (LPCA), 10 methods in nightly run 1."; nothing if there is no value.
std::optional<std::string> values_sentence(const Reported& reported, const std::string& sensor,
                                           const Quantity& quantity) {
  std::vector<Line> lines = shown_settings(reported, sensor, quantity.id);
  if (lines.empty() || has_course(reported, lines, quantity)) return std::nullopt;
  std::ranges::stable_sort(lines, {},
                           [](const Line& line) { return level_over_nightly_runs(*line.values); });
  if (quantity.better == Better::kHigher) std::ranges::reverse(lines);
  const bool great_errors = has_great_errors(reported.trend, quantity);
  const auto value_of = [&](const Line& line) {
    return fmt::format(
        "{} ({})", median_text(level_over_nightly_runs(*line.values), quantity.unit, great_errors),
        shown_method(reported.trend.labels, line.id.method));
  };
  const std::string setup = first_setup(reported.trend.labels, sensor);
  std::string text = fmt::format("{}{} ", setup.empty() ? "" : setup + ": ", quantity.label);
  text += lines.size() == 1 ? value_of(lines.front())
                            : fmt::format("from {} to {}, {} methods", value_of(lines.front()),
                                          value_of(lines.back()), lines.size());
  const Line& longest = *std::ranges::max_element(
      lines, {}, [](const Line& line) { return count_known(*line.values); });
  return text + without_change(reported.trend, *longest.values);
}

/// Whether the lines that have a name at their ends end apart, so that each name is beside its
/// line.
bool has_room_for_names(const std::vector<ErrorLine>& lines) {
  constexpr double kRow = 0.06;  // Of the frame's height: a row of text, 30 of 493 px.
  std::vector<double> all, ends;
  for (const ErrorLine& line : lines) {
    std::ranges::copy_if(line.mean, std::back_inserter(all),
                         [](double value) { return std::isfinite(value); });
    if (!line.end_label.empty() && std::isfinite(line.mean.back()))
      ends.push_back(line.mean.back());
  }
  if (ends.size() < 2) return true;
  std::ranges::sort(ends);
  const auto [low, high] = std::ranges::minmax(all);
  const double row = kRow * (high - low);
  return std::ranges::adjacent_find(ends, [row](double a, double b) { return b - a <= row; }) ==
         ends.end();
}

/// The changes of the medians of a line since the nightly run that they are shown against.
std::vector<double> median_changes(const Reported& reported, const Quantity& quantity,
                                   const Line& line) {
  return changes_of(*line.values, reported.base, [&](double before, double after) {
    return median_change(quantity, before, after);
  });
}

/// Takes out the lines whose changes have no percentage, and names them; nothing if there are none.
std::vector<Note> leave_out_from_zero(const Reported& reported, const Quantity& quantity,
                                      std::vector<Line>& lines) {
  std::vector<std::string> left_out;
  std::erase_if(lines, [&](const Line& line) {
    if (count_known(median_changes(reported, quantity, line)) > 0) return false;
    left_out.push_back(shown_method(reported.trend.labels, line.id.method));
    return true;
  });
  constexpr std::size_t kMostNamed = 3;
  if (left_out.empty()) return {};
  return {{fmt::format("Started at 0, so that changes have no percentage: {}.",
                       listed(left_out, kMostNamed)),
           ThemeColour::kMuted}};
}

std::optional<Figure> lines_figure(const Reported& reported, const std::string& sensor,
                                   const std::string& quantity) {
  std::vector<Line> lines = shown_settings(reported, sensor, quantity);
  const Quantity& facts = reported.trend.quantities.at(quantity);
  if (!has_course(reported, lines, facts)) return std::nullopt;
  const bool by_ratio =
      facts.nightly == NightlyRule::kRatio || facts.nightly == NightlyRule::kDuration;
  // Where no change has a percentage, values are shown.
  const bool changes = (by_ratio || facts.nightly == NightlyRule::kPoints) &&
                       std::ranges::any_of(lines, [&](const Line& line) {
                         return count_known(median_changes(reported, facts, line)) > 0;
                       });
  std::vector<Note> notes;
  if (changes) notes = leave_out_from_zero(reported, facts, lines);
  const auto shown_of = [&](const Line& line) {
    return changes ? median_changes(reported, facts, line) : *line.values;
  };
  std::vector<double> last;
  for (const Line& line : lines)
    if (const double value = shown_of(line).back(); std::isfinite(value)) last.push_back(value);
  ErrorLinesSpec spec = named_spec(reported, id_of(quantity) + "-" + id_of(sensor),
                                   course_of(reported, sensor, facts, last));
  spec.y_label = changes ? fmt::format("change of {} [{}]", facts.label, by_ratio ? "%" : "points")
                         : label_with_unit(facts);
  spec.notes = std::move(notes);
  if (changes || is_accuracy(facts.nightly)) spec.log_from = kInfinity;
  spec.quantity = changes ? "change of " + facts.label : facts.label;
  spec.caption = fmt::format(
      "Lines: median over runs of {}{}{}, of each method the setting that was best over these "
      "nightly runs, and every setting that got worse.",
      facts.label,
      std::ranges::any_of(lines, [](const Line& line) { return line.id.step > 0; })
          ? " at the last step"
          : "",
      changes ? ", as its change since " + base_words(reported) : "");
  ErrorPanel panel = panel_of(reported.trend);
  for (const Line& line : lines) {
    panel.lines.push_back(
        {.label = line.entry,
         .key = id_of(line.id.method),
         .x = places_of(reported.trend),
         .mean = shown_of(line),
         .series = style_of(reported, line.id.method),
         .setting = line.setting.empty() ? "" : shown_method(reported.trend.labels, line.id.method),
         .end_label = line.setting});
    const auto is_about_it = [&](const NightlyFinding& finding) {
      return is_about(finding, line.id);
    };
    mark_findings(reported, panel.lines.back(), is_about_it, panel);
  }
  if (!has_room_for_names(panel.lines))
    for (ErrorLine& line : panel.lines) line.end_label.clear();
  else if (std::ranges::any_of(lines, [](const Line& line) { return !line.setting.empty(); }))
    spec.caption += " The ends of lines name the settings of one method.";
  return drawn(std::move(spec), std::move(panel), facts.nightly == NightlyRule::kDuration);
}

/// "SMACOF has the lowest MPE, 0.0597 m": of values in the order of the lines, the best last.
std::string best_text(const Reported& reported, const Quantity& quantity,
                      const std::vector<Line>& lines) {
  const bool great_errors = has_great_errors(reported.trend, quantity);
  const auto value_of = [&](const Line& line) {
    return median_text(level_over_nightly_runs(*line.values), quantity.unit, great_errors);
  };
  const std::string best = value_of(lines.back());
  std::vector<std::string> methods;
  for (const Line& line : lines)
    if (value_of(line) == best)
      methods.push_back(shown_method(reported.trend.labels, line.id.method));
  constexpr std::size_t kMostNamed = 2;
  return fmt::format(
      "{} {} the {} {}, {}", listed(methods, kMostNamed), methods.size() == 1 ? "has" : "have",
      quantity.better == Better::kHigher ? "highest" : "lowest", quantity.label, best);
}

/// What was measured of the methods where there is no course to draw: a dot each, the best one
/// uppermost. Nothing of what is not an accuracy, or of one method.
std::optional<Figure> values_figure(const Reported& reported, const std::string& sensor,
                                    const std::string& quantity) {
  const Quantity& facts = reported.trend.quantities.at(quantity);
  std::vector<Line> lines = shown_settings(reported, sensor, quantity);
  if (!is_accuracy(facts.nightly) || lines.size() < 2) return std::nullopt;
  const auto level_of = [](const Line& line) { return level_over_nightly_runs(*line.values); };
  std::ranges::stable_sort(lines, std::greater<>(), level_of);
  if (facts.better == Better::kHigher) std::ranges::reverse(lines);
  const std::string setup = first_setup(reported.trend.labels, sensor);
  const ErrorLinesSpec named =
      named_spec(reported, id_of(quantity) + "-" + id_of(sensor) + "-values",
                 (setup.empty() ? "" : setup + ": ") + best_text(reported, facts, lines));
  ValueDotsPanel panel;
  for (std::size_t i = 0; i < lines.size(); ++i)
    panel.methods.push_back({.label = shown_method(reported.trend.labels, lines[i].id.method),
                             .key = id_of(lines[i].id.method),
                             .series = style_of(reported, lines[i].id.method).value_or(i),
                             .value = level_of(lines[i])});
  return value_dots_figure(
      {.id = named.id,
       .title = named.title,
       .caption = fmt::format("Dots: median over runs of {}, of each method the setting that is "
                              "best{}",
                              facts.label, without_change(reported.trend, *lines.back().values)),
       .x_label = label_with_unit(facts),
       .unit = facts.unit,
       .higher_is_better = facts.better == Better::kHigher,
       .great_errors = has_great_errors(reported.trend, facts),
       .panels = {std::move(panel)}});
}

bool is_about_memory(const NightlyFinding& finding) { return finding.quantity == "memory"; }

bool has_memory_course(const Reported& reported) {
  const std::vector<double>& known = reported.trend.peak_memory_mib;
  const bool is_found = std::ranges::any_of(
      reported.findings, [](const auto& found) { return is_about_memory(*found.second); });
  return count_known(known) > 1 && (is_found || has_changed(known, {0.0, 0.0}));
}

std::optional<std::string> memory_sentence(const Reported& reported) {
  const std::vector<double>& known = reported.trend.peak_memory_mib;
  const double level = level_over_nightly_runs(known);
  if (!std::isfinite(level) || has_memory_course(reported)) return std::nullopt;
  return "Peak memory " + quantity_text(level, "MiB") + without_change(reported.trend, known);
}

/// By how much it changed up to the last nightly run that it is known of.
/// @param changes  In percent, since Reported::base.
std::string memory_title(const Reported& reported, const std::vector<double>& changes) {
  const auto known = [](double change) { return std::isfinite(change); };
  const auto last = std::ranges::find_if(changes.rbegin(), changes.rend(), known);
  if (last == changes.rend()) return "Peak memory over the nightly runs";
  constexpr double kLeastWhole = 10.0;
  const std::string change = format_number(*last, std::abs(*last) < kLeastWhole ? 1 : 0, true);
  return fmt::format("Peak memory changed by {}\u00a0% since {}", change, base_words(reported));
}

std::optional<Figure> memory_figure(const Reported& reported) {
  if (!has_memory_course(reported)) return std::nullopt;
  const std::vector<double>& known = reported.trend.peak_memory_mib;
  const std::vector<double> mib = changes_of(known, reported.base, percent_change);
  ErrorLinesSpec spec = named_spec(reported, "memory", memory_title(reported, mib));
  spec.y_label = "change of peak memory [%]";
  spec.log_from = kInfinity;
  spec.quantity = "change of peak memory";
  spec.caption =
      fmt::format("Peak memory of the process that made the study, as its change since {}.",
                  base_words(reported));
  ErrorPanel panel = panel_of(reported.trend);
  panel.lines.push_back(
      {.label = "peak memory", .key = "peak-memory", .x = places_of(reported.trend), .mean = mib});
  mark_findings(reported, panel.lines.back(), is_about_memory, panel);
  return drawn(std::move(spec), std::move(panel), true);
}

/// What a figure is about: a quantity and a sensor, or peak memory.
struct Subject {
  std::size_t group = 0;  ///< The index of the first group of the last findings on it.
  std::size_t rank = 0;   ///< Of its quantity in the dictionary; memory comes last.
  std::string quantity = {};
  std::string sensor = {};

  auto operator<=>(const Subject&) const = default;
};

constexpr std::size_t kLast = std::numeric_limits<std::size_t>::max();

/// The index of the first group that has a finding of which a predicate holds; kLast if none has.
template <typename Predicate>
std::size_t first_group(const Reported& reported, const Predicate& is_about_it) {
  const auto group = std::ranges::find_if(reported.last_groups, [&](const FindingGroup& one) {
    return std::ranges::any_of(one.numbers, [&](int number) {
      return is_about_it(reported.last[static_cast<std::size_t>(number) - 1]);
    });
  });
  return group == reported.last_groups.end()
             ? kLast
             : static_cast<std::size_t>(group - reported.last_groups.begin());
}

/// In the order of the last nightly run's findings, then of the dictionary.
std::set<Subject> subjects_of(const Reported& reported) {
  std::map<std::pair<std::string, std::string>, Subject> subjects;
  for (const auto& [id, values] : reported.trend.medians) {
    const NightlyRule rule = rule_of(id, reported.trend.quantities, reported.trend.medians);
    if (rule == NightlyRule::kNone || rule == NightlyRule::kKept) continue;
    const std::size_t group = first_group(
        reported, [&id = id](const NightlyFinding& finding) { return is_about(finding, id); });
    const std::size_t rank = dictionary_rank(reported.trend.quantities.at(id.quantity));
    const auto [at, is_first] = subjects.try_emplace({id.quantity, id.sensor},
                                                     Subject{group, rank, id.quantity, id.sensor});
    if (!is_first) at->second.group = std::min(at->second.group, group);
  }
  std::set<Subject> ordered = {{first_group(reported, is_about_memory), kLast}};
  for (const auto& [key, subject] : subjects) ordered.insert(subject);
  return ordered;
}

bool is_memory(const Subject& subject) { return subject.rank == kLast; }

bool has_finding(const Subject& subject) { return subject.group != kLast; }

std::optional<Figure> course_figure(const Reported& reported, const Subject& subject) {
  return is_memory(subject) ? memory_figure(reported)
                            : lines_figure(reported, subject.sensor, subject.quantity);
}

/// The first figure of values where no accuracy has a course to draw.
std::optional<Figure> first_values(const Reported& reported, const std::set<Subject>& subjects) {
  std::optional<Figure> first;
  for (const Subject& subject : subjects) {
    if (is_memory(subject)) continue;
    const Quantity& quantity = reported.trend.quantities.at(subject.quantity);
    const bool has_lines =
        has_course(reported, shown_settings(reported, subject.sensor, subject.quantity), quantity);
    if (is_accuracy(quantity.nightly) && has_lines) return std::nullopt;
    if (!first) first = values_figure(reported, subject.sensor, subject.quantity);
  }
  return first;
}

}  // namespace

std::vector<Figure> trend_figures(const StudyTrend& trend, const NightlyFindings& findings,
                                  std::span<const NightlyNote> notes,
                                  const TrendLocation& location) {
  const Reported reported = reported_of(trend, findings, notes, location);
  std::vector<Figure> figures;
  const std::set<Subject> subjects = subjects_of(reported);
  std::optional<Figure> values = first_values(reported, subjects);
  const auto add = [&](std::optional<Figure> figure) {
    const bool is_full = location.most > 0 && figures.size() >= location.most;
    if (figure && !is_full) figures.push_back(*std::move(figure));
  };
  for (const Subject& subject : subjects) {
    if (!has_finding(subject)) add(std::exchange(values, std::nullopt));
    add(course_figure(reported, subject));
  }
  add(std::move(values));
  return figures;
}

std::vector<std::string> trend_sentences(const StudyTrend& trend, const NightlyFindings& findings,
                                         const TrendLocation& location) {
  const Reported reported = reported_of(trend, findings, {}, location);
  std::vector<std::string> sentences;
  const auto add = [&](const std::optional<std::string>& sentence) {
    if (sentence) sentences.push_back((location.among_others ? trend.name + ", " : "") + *sentence);
  };
  for (const Subject& subject : subjects_of(reported)) {
    if (is_memory(subject)) continue;
    if (location.most > 0 && sentences.size() >= location.most) return sentences;
    add(values_sentence(reported, subject.sensor, trend.quantities.at(subject.quantity)));
  }
  if (location.most == 0) add(memory_sentence(reported));
  return sentences;
}

}  // namespace mapproof
