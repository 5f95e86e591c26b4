#include "reports/history/finding_groups.hpp"

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <functional>
#include <optional>
#include <set>
#include <string_view>
#include <tuple>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "core/base/not_finite.hpp"
#include "core/base/text/number_text.hpp"
#include "core/base/text/shell_word.hpp"
#include "core/base/text/unit_text.hpp"
#include "core/base/text/words.hpp"
#include "core/json/text_input.hpp"
#include "reports/history/great_medians.hpp"
#include "reports/history/regression_rules.hpp"

namespace mapproof {
namespace {

constexpr std::size_t kShownDigits = 9;
constexpr double kMostPercent = 1e6;  ///< More is shown as this.
constexpr double kLeastAmount = 0.005;  ///< Less is shown as 0.

/// The series that a finding is about; null if it is about others, or is not there any more.
const SeriesId* series_of(const NightlyFinding& finding, const StudyTrend& trend) {
  if (finding.subject == kAllMethods) return nullptr;
  for (const auto& [id, values] : trend.medians)
    if (is_about(finding, id)) return &id;
  return nullptr;
}

/// The subject of a finding that is about no series that is still there.
std::string shown_subject_of(const NightlyFinding& finding, const StudyTrend* trend) {
  return trend == nullptr ? finding.subject : shown_setup(trend->labels, finding.subject);
}

/// What names without settings of their own have in common: "isomap-K" of "isomap-K6", "isomap-K8".
std::string without_last_number(const std::string& name) {
  const std::size_t end = name.find_last_not_of("0123456789.");
  return end == std::string::npos ? name : name.substr(0, end + 1);
}

bool is_time_unit(const std::string& unit) {
  constexpr std::array kUnits = {"s", "ms", "us", "µs", "ns", "min", "h"};
  return std::ranges::find(kUnits, unit) != kUnits.end();
}

/// @param shown  What stands behind the method's name.
FindingSetting setting_of(const StudyLabels& labels, const std::string& method,
                          const std::string& shown) {
  constexpr std::string_view kIs = " = ";
  FindingSetting setting{.shown = shown, .levels = levels_of(labels, method)};
  if (const std::size_t is = shown.find(kIs); is != std::string::npos) {
    const std::size_t value = is + kIs.size();
    const std::string text = shown.substr(value, shown.find(", ", value) - value);
    setting.parameter = {.name = shown.substr(0, is), .value = text, .number = number_in(text)};
  }
  return setting;
}

/// How many settings of the method of a series have values of its setup and quantity.
std::size_t count_settings(const StudyTrend& trend, const SeriesId& series) {
  const std::string base = base_method(trend.labels, series.method);
  std::set<std::string> settings;
  for (const auto& [id, values] : trend.medians)
    if (id.sensor == series.sensor && id.quantity == series.quantity &&
        base_method(trend.labels, id.method) == base)
      settings.insert(id.method);
  return settings.size();
}

/// The last step of what a finding is about; null if it is about no series that is there.
const SeriesId* last_step_of(const NightlyFinding& finding, const StudyTrend& trend) {
  const SeriesId* last = nullptr;  // Series ascend by step.
  for (const auto& [id, values] : trend.medians)
    if (is_about(finding, id)) last = &id;
  return last;
}

/// The nightly run that changes up to `last` are shown against: see base_index().
std::size_t base_before(const StudyTrend& trend, const NightlyFacts& last,
                        std::span<const NightlyFinding> findings) {
  int base = last.reference.value_or(0);
  for (const NightlyFinding& finding : findings)
    if (finding.study == trend.name && finding.since <= base)
      base = commits_of(trend, finding.since).before.number;
  const auto found = std::ranges::find(trend.nightly_runs, base, &NightlyFacts::number);
  return found == trend.nightly_runs.end()
             ? 0
             : static_cast<std::size_t>(found - trend.nightly_runs.begin());
}

/// The medians of what a finding by rule kAccuracy is about; nothing where one is not known, or the
/// nightly run was not compared.
std::optional<MedianPair> medians_of(const NightlyFinding& finding, const SeriesId& series,
                                     const StudyTrend& trend, int nightly_run,
                                     std::span<const NightlyFinding> findings) {
  const auto last = std::ranges::find(trend.nightly_runs, nightly_run, &NightlyFacts::number);
  if (finding.rule != HistoryRule::kAccuracy || last == trend.nightly_runs.end() ||
      !last->reference)
    return std::nullopt;
  const std::vector<double>& values = trend.medians.at(series);
  const MedianPair medians{values[base_before(trend, *last, findings)],
                           values[static_cast<std::size_t>(last - trend.nightly_runs.begin())]};
  if (!std::isfinite(medians.before) || !std::isfinite(medians.after)) return std::nullopt;
  return medians;
}

/// Shows the change of the median in place of the rule's estimate, where the finding has medians.
void show_median(const NightlyFinding& finding, const StudyTrend& trend, int nightly_run,
                 std::span<const NightlyFinding> findings, FindingGroup& group) {
  const SeriesId* series = last_step_of(finding, trend);
  if (series == nullptr || finding.subject == kAllMethods) return;
  group.over_steps = finding.rule == HistoryRule::kAccuracy &&
                     finding.subject != subject_of(*series) &&
                     finding.subject != method_of(*series);
  if (group.over_steps) return;
  group.medians = medians_of(finding, *series, trend, nightly_run, findings);
  if (!group.medians) return;
  const double change = median_change(trend.quantities.at(series->quantity), group.medians->before,
                                      group.medians->after);
  if (std::isfinite(change)) {
    group.changes = {change};
  } else {
    group.changes.clear();
    group.from_zero = {*group.medians};
  }
}

/// One finding as a group.
FindingGroup group_of(const NightlyFinding& finding, const StudyTrend* trend) {
  FindingGroup group{.study = finding.study,
                     .rule = finding.rule,
                     .method = shown_subject_of(finding, trend),
                     .family = shown_subject_of(finding, trend),
                     .quantity = finding.quantity == "memory" ? "peak memory" : finding.quantity,
                     .quantity_id = finding.quantity};
  if (finding.change) group.changes.push_back(*finding.change);
  group.sentences.push_back(finding.sentence);
  if (trend == nullptr) return group;
  group.commits = commits_of(*trend, finding.since);
  if (const Quantity* quantity = trend->quantities.find(finding.quantity)) {
    group.quantity = quantity->label;
    group.in_points = quantity->nightly == NightlyRule::kPoints;
    group.higher_is_better = quantity->better == Better::kHigher;
    group.is_time = is_time_unit(quantity->unit);
    group.unit = quantity->unit;
    group.great_errors = has_great_errors(*trend, *quantity);
  }
  const SeriesId* series = series_of(finding, *trend);
  if (series == nullptr) return group;
  group.setup = shown_setup(trend->labels, series->sensor);
  const std::string shown = shown_method(trend->labels, series->method);
  group.lines.push_back(shown);
  group.series.push_back(*series);
  group.method = shown_method(trend->labels, base_method(trend->labels, series->method));
  if (shown.starts_with(group.method + ", "))
    group.settings.push_back(
        setting_of(trend->labels, series->method, shown.substr(group.method.size() + 2)));
  else
    group.method = shown;
  group.family = group.settings.empty() ? without_last_number(group.method) : group.method;
  return group;
}

bool is_same(const FindingGroup& a, const FindingGroup& b) {
  const auto key = [](const FindingGroup& group) {
    return std::tie(group.study, group.rule, group.setup, group.family, group.quantity_id,
                    group.commits.since.number, group.over_steps);
  };
  const bool both_known = a.known.has_value() == b.known.has_value();
  return both_known && key(a) == key(b) && (!a.known || a.known->text == b.known->text) &&
         a.settings.empty() == b.settings.empty() && a.from_zero.empty() == b.from_zero.empty();
}

/// Of several methods without settings the names of all.
void name_methods(FindingGroup& group) {
  constexpr std::size_t kMost = 4;
  std::vector<std::string> names;
  for (const std::string& line : group.lines)
    if (std::ranges::find(names, line) == names.end()) names.push_back(line);
  if (group.settings.empty() && names.size() > 1) group.method = listed(names, kMost);
}

template <typename T>
void append(std::vector<T>& all, const std::vector<T>& more) {
  all.insert(all.end(), more.begin(), more.end());
}

/// The only thing that a setting consists of; nothing if there are several.
std::optional<ShownLevel> only_level(const FindingSetting& setting) {
  if (setting.levels.empty()) return setting.parameter;
  if (setting.parameter || setting.levels.size() > 1) return std::nullopt;
  return setting.levels.front();
}

/// "K = 6 and 8" of "K = 6" and "K = 8", "range noise 0.1 and 0.2 m" of two levels.
std::string settings_text(const std::vector<FindingSetting>& settings) {
  constexpr std::size_t kMost = 6;
  std::vector<std::string> values;
  const std::optional<ShownLevel> first = only_level(settings.front());
  for (const FindingSetting& setting : settings)
    if (const auto level = only_level(setting); level && first && level->name == first->name)
      values.push_back(level->value);
  if (first && values.size() == settings.size())
    return first->name + (settings.front().parameter ? " = " : " ") +
           with_unit(listed(values, kMost), first->unit);
  // Settings with levels hold commas of their own.
  std::string text;
  for (std::size_t i = 0; i < std::min(settings.size(), kMost); ++i)
    text += (i > 0 ? "; " : "") + settings[i].shown;
  if (settings.size() > kMost) text += fmt::format("; and {} more", settings.size() - kMost);
  return text;
}

/// "all 4 settings", "all 3 levels of laser noise".
std::string all_text(const std::vector<FindingSetting>& settings, std::size_t count) {
  const std::optional<ShownLevel> first = only_level(settings.front());
  const bool are_levels = std::ranges::all_of(settings, [&](const FindingSetting& setting) {
    const auto level = only_level(setting);
    return !setting.parameter && level && first && level->name == first->name;
  });
  return are_levels ? fmt::format("all {} levels of {}", count, first->name)
                    : fmt::format("all {} settings", count);
}

std::string amount(double change) {
  if (std::abs(change) > kMostPercent) return change > 0 ? "over +1,000,000" : "below −1,000,000";
  return fmt::format("{}{:.{}f}", change < 0 ? "−" : "+", std::abs(change),
                     std::abs(change) < 0.095 ? 2 : 1);
}

/// The words of a command that quoted_command() of the program made: words between blanks, parts of
/// them between single quotes, \' for a single quote.
std::vector<std::string> words_of(const std::string& command) {
  std::vector<std::string> words(1);
  bool is_quoted = false;
  for (std::size_t i = 0; i < command.size(); ++i) {
    if (command[i] == '\'')
      is_quoted = !is_quoted;
    else if (!is_quoted && command[i] == '\\' && i + 1 < command.size())
      words.back() += command[++i];
    else if (!is_quoted && command[i] == ' ')
      words.emplace_back();
    else
      words.back() += command[i];
  }
  return words;
}

/// A command of `nightly` for any commit: without the options that name the commit of one nightly
/// run, build it, choose its reference or write files.
std::string for_any_commit(const std::string& command) {
  static const std::set<std::string, std::less<>> kLeftOut = {
      "--build", "--commit",    "--junit",          "--markdown", "--on-worse",
      "--out",   "--reference", "--repository-url", "-o"};
  std::string kept;
  bool skips_value = false;
  for (const std::string& word : words_of(command)) {
    const std::string option = word.substr(0, word.find('='));
    const bool is_left_out = kLeftOut.contains(option);
    if (!skips_value && !is_left_out) kept += (kept.empty() ? "" : " ") + shell_word(word);
    skips_value = !skips_value && is_left_out && option.size() == word.size();
  }
  return kept;
}

bool is_address(std::string_view text) {
  return text.starts_with("https://") || text.starts_with("http://");
}

}  // namespace

std::string CommitRange::words() const {
  return before.number == 0
             ? fmt::format("since nightly run {}", since.number)
             : fmt::format("between nightly runs {} and {}", before.number, since.number);
}

std::string CommitRange::dated_words() const {
  const auto dated = [](const NightlyFacts& nightly_run) {
    const std::string time = local_time(nightly_run);
    return std::to_string(nightly_run.number) + (time.empty() ? "" : " (" + time + ")");
  };
  return before.number == 0 ? "since nightly run " + dated(since)
                            : "between nightly runs " + dated(before) + " and " + dated(since);
}

bool CommitRange::has_commits() const {
  return !before.commit.empty() && !since.commit.empty() && before.commit != since.commit;
}

std::string CommitRange::text() const {
  return has_commits() ? short_commit(before.commit) + ".." + short_commit(since.commit) : "";
}

std::string CommitRange::url() const {
  if (!has_commits() || !is_address(since.repository)) return "";
  const bool is_gitlab = since.repository.find("gitlab") != std::string::npos;
  return fmt::format("{}/{}compare/{}...{}", since.repository, is_gitlab ? "-/" : "", before.commit,
                     since.commit);
}

std::string CommitRange::bisect() const {
  if (!has_commits()) return "";
  const std::string run =
      fmt::format("({}) || exit 125; {} --bisect {}", since.build.empty() ? "BUILD" : since.build,
                  for_any_commit(since.command), since.number);
  return fmt::format("git bisect start {} {} && git bisect run sh -c {}",
                     short_commit(since.commit), short_commit(before.commit), shell_word(run));
}

std::string CommitRange::bisect_gaps() const {
  if (!has_commits()) return "";
  std::vector<std::string> gaps;
  if (since.build.empty())
    gaps.push_back(
        "Put the command that builds a commit and makes its results in place of BUILD, or give it "
        "to nightly as --build.");
  if (bisect().find(kUnshownFolder) != std::string::npos)
    gaps.push_back("Put the path of the folder, which is not shown, in place of each ….");
  return fmt::format("{}", fmt::join(gaps, " "));
}

CommitRange commits_of(const StudyTrend& trend, int since) {
  CommitRange range;
  for (const NightlyFacts& nightly_run : trend.nightly_runs) {
    if (nightly_run.number < since) range.before = nightly_run;
    if (nightly_run.number == since) range.since = nightly_run;
  }
  return range;
}

std::string store_word(const std::string& command) {
  constexpr std::string_view kOption = "--store";
  const std::vector<std::string> words = words_of(command);
  for (std::size_t i = 0; i < words.size(); ++i) {
    if (words[i] == kOption && i + 1 < words.size()) return shell_word(words[i + 1]);
    if (words[i].starts_with(std::string(kOption) + "="))
      return shell_word(words[i].substr(kOption.size() + 1));
  }
  return kUnknownStore;
}

std::string short_commit(const std::string& commit) { return commit.substr(0, kShownDigits); }

std::string commit_url(const std::string& repository, const std::string& commit) {
  if (commit.empty() || !is_address(repository)) return "";
  return repository + "/commit/" + commit;
}

namespace {

/// "0.1 m", "between 0.1 m and 0.2 m".
std::string span_text(const std::string& low, const std::string& high) {
  return low == high ? low : "between " + low + " and " + high;
}

/// "from 0 to 0.00400 m", "from 0 to between 0.00400 m and 0.00500 m".
std::string from_to_text(const FindingGroup& group) {
  const auto [least, most] = std::ranges::minmax(group.from_zero, {}, &MedianPair::before);
  const auto [low, high] = std::ranges::minmax(group.from_zero, {}, &MedianPair::after);
  const auto text = [&](double median) {
    return median_text(median, group.unit, group.great_errors);
  };
  return fmt::format("from {} to {}",
                     span_text(significant(least.before), significant(most.before)),
                     span_text(text(low.after), text(high.after)));
}

}  // namespace

std::string FindingGroup::change_text() const {
  if (rule == HistoryRule::kLostResults) return quantity + ": results are lost";
  const std::string subject = over_steps ? quantity + " over all steps" : quantity;
  if (!from_zero.empty()) return subject + " " + from_to_text(*this);
  if (changes.empty()) return subject + " got worse";
  const auto [least, most] = std::ranges::minmax(changes);
  const std::string low = amount(least), high = amount(most);
  const std::string change = fmt::format("{}\u00a0{}", low == high ? low : low + " to " + high,
                                         in_points ? "points" : "%");
  const double worsening = higher_is_better ? -least : most;
  if (worsening >= kLeastAmount) return subject + " " + change;
  const bool is_unchanged = std::max(std::abs(least), std::abs(most)) < kLeastAmount;
  return fmt::format("{} got worse in pairs of runs, its median {}", subject,
                     is_unchanged ? "unchanged" : change);
}

bool FindingGroup::has_all_settings() const {
  constexpr std::size_t kFewest = 3;  // The names of two are as short.
  std::set<std::string> distinct;
  for (const FindingSetting& setting : settings) distinct.insert(setting.shown);
  return distinct.size() >= kFewest && distinct.size() == settings_of_method;
}

std::string FindingGroup::change_of_settings() const {
  if (settings.empty()) return change_text();
  return fmt::format(
      "{} ({})", change_text(),
      has_all_settings() ? all_text(settings, settings_of_method) : settings_text(settings));
}

std::string FindingGroup::headline() const { return method + ": " + change_of_settings(); }

std::string FindingGroup::values_text() const {
  if (numbers.size() > 1 || !medians || !from_zero.empty()) return "";
  return "median " + medians_text(medians->before, medians->after, unit, great_errors);
}

std::string FindingGroup::count_text() const {
  return numbers.size() < 2 ? "" : counted(std::ssize(numbers), "finding");
}

double FindingGroup::worsening() const {
  if (rule == HistoryRule::kLostResults) return kInfinity;
  if (changes.empty()) return 0.0;
  const auto [least, most] = std::ranges::minmax(changes);
  const RegressionRules rules;
  return (higher_is_better ? -least : most) /
         (in_points ? rules.least_points : 100.0 * rules.least_ratio);
}

std::size_t count_findings(std::span<const FindingGroup> groups, bool known) {
  std::size_t count = 0;
  for (const FindingGroup& group : groups)
    if (group.known.has_value() == known) count += group.numbers.size();
  return count;
}

std::vector<FindingGroup> grouped(int nightly_run, std::span<const NightlyFinding> findings,
                                  std::span<const StudyTrend> trends,
                                  std::span<const NightlyNote> notes) {
  std::vector<FindingGroup> groups;
  for (std::size_t i = 0; i < findings.size(); ++i) {
    const auto trend = std::ranges::find(trends, findings[i].study, &StudyTrend::name);
    FindingGroup group = group_of(findings[i], trend == trends.end() ? nullptr : &*trend);
    if (trend != trends.end()) show_median(findings[i], *trend, nightly_run, findings, group);
    group.numbers.push_back(static_cast<int>(i) + 1);
    if (group.commits.since.number == 0) group.commits.since.number = findings[i].since;
    if (const NightlyNote* known = known_by(notes, findings[i])) group.known = *known;
    const auto same = std::ranges::find_if(
        groups, [&](const FindingGroup& other) { return is_same(other, group); });
    if (same == groups.end()) {
      groups.push_back(std::move(group));
      continue;
    }
    append(same->settings, group.settings);
    append(same->changes, group.changes);
    append(same->from_zero, group.from_zero);
    append(same->numbers, group.numbers);
    append(same->sentences, group.sentences);
    append(same->lines, group.lines);
    append(same->series, group.series);
  }
  for (FindingGroup& group : groups) {
    name_methods(group);
    const auto trend = std::ranges::find(trends, group.study, &StudyTrend::name);
    if (trend != trends.end() && !group.series.empty())
      group.settings_of_method = count_settings(*trend, group.series.front());
  }
  std::ranges::stable_sort(groups, {}, [](const FindingGroup& group) {
    const bool is_cost = group.is_time || verdict_of(group.rule) == NightlyVerdict::kCost;
    return std::tuple(group.known.has_value(), is_cost, -group.worsening());
  });
  return groups;
}

std::size_t base_index(const StudyTrend& trend, std::span<const NightlyFinding> findings) {
  return base_before(trend, trend.nightly_runs.back(), findings);
}

std::string local_time(const NightlyFacts& nightly_run) {
  namespace ch = std::chrono;
  int year = 0, month = 0, day = 0, hour = 0, minute = 0, second = 0;
  char zone = 0;
  const int read = std::sscanf(nightly_run.started_utc.c_str(), "%4d-%2d-%2dT%2d:%2d:%2d%c", &year,
                               &month, &day, &hour, &minute, &second, &zone);
  const ch::year_month_day date{ch::year(year), ch::month(static_cast<unsigned>(month)),
                                ch::day(static_cast<unsigned>(day))};
  if (read != 7 || zone != 'Z' || !date.ok()) return nightly_run.started_utc;
  const auto at = ch::sys_days(date) + ch::hours(hour) + ch::minutes(minute) +
                  ch::seconds(second + nightly_run.utc_offset_s);
  const ch::sys_days of_day = ch::floor<ch::days>(at);
  const ch::year_month_day local(of_day);
  const auto minutes = ch::duration_cast<ch::minutes>(at - of_day).count();
  const int offset = std::abs(nightly_run.utc_offset_s) / 60;
  const std::string place =
      nightly_run.utc_offset_s == 0
          ? "UTC"
          : fmt::format("{}{:02}:{:02}", nightly_run.utc_offset_s < 0 ? "−" : "+", offset / 60,
                        offset % 60);
  return fmt::format("{}-{:02}-{:02} {:02}:{:02} {}", int(local.year()), unsigned(local.month()),
                     unsigned(local.day()), minutes / 60, minutes % 60, place);
}

std::string dated_name(const NightlyFacts& nightly_run) {
  return fmt::format(
      "nightly run {}, {}{}", nightly_run.number, local_time(nightly_run),
      nightly_run.commit.empty() ? "" : ", commit " + short_commit(nightly_run.commit));
}

}  // namespace mapproof
