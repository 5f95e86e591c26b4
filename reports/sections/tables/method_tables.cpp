#include "reports/sections/tables/method_tables.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include <fmt/format.h>

#include "core/base/not_finite.hpp"
#include "core/base/text/error_text.hpp"
#include "core/base/text/number_text.hpp"
#include "core/base/text/words.hpp"
#include "reports/model/format.hpp"
#include "reports/sections/tables/cells.hpp"
#include "reports/sections/wording.hpp"

namespace mapproof {
namespace {

constexpr std::size_t kMostListed = 50;

std::string numbers_text(const std::vector<int>& numbers) {
  std::vector<std::string> words;
  for (const int number : numbers) words.push_back(fmt::format("{}", number));
  return listed(words, kMostListed);
}

std::string halves_note(const HalfChoices& choices) {
  const char* what = choices.halves == Halves::kLayouts ? "layouts" : "initial poses";
  return fmt::format(
      "First half: {} {}; second half: {}. Each run is judged with the parameter of least mean MPE "
      "on the half that it is not in.",
      what, numbers_text(choices.members[0]), numbers_text(choices.members[1]));
}

/// A letter for each group of methods that do not differ significantly, as "a, b"; beyond z: "27".
std::string group_letters(const MethodRanks& ranks, int method) {
  std::vector<std::string> letters;
  for (std::size_t i = 0; i < ranks.alike.size(); ++i)
    if (std::ranges::find(ranks.alike[i], method) != ranks.alike[i].end())
      letters.push_back(i < 26 ? std::string(1, static_cast<char>('a' + i))
                               : fmt::format("{}", i + 1));
  return fmt::format("{}", fmt::join(letters, ", "));
}

std::string test_note(const MethodRanks& ranks) {
  const FriedmanTest& test = *ranks.test;
  const std::string f = std::isfinite(test.f)
                            ? fmt::format("F = {}, {}", format_number(test.f, 2), p_words(test.f_p))
                            : "F is infinite, all layouts agreeing";
  return fmt::format(
      "Friedman\u2019s test that no method differs, over {}: \u03C7\u00B2 = {}, {}; in Iman and "
      "Davenport\u2019s form {}.",
      counted(test.units, "layout"), format_number(test.chi_square, 2), p_words(test.chi_square_p),
      f);
}

void add_rank_rows(Table& table, const MethodRanks& ranks, int mpe_decimals) {
  std::vector<int> order(ranks.methods.size());
  std::iota(order.begin(), order.end(), 0);
  const auto& mean_ranks = ranks.test->mean_ranks;
  std::ranges::stable_sort(
      order, {}, [&](int method) { return mean_ranks[static_cast<std::size_t>(method)]; });
  for (const int method : order) {
    const auto i = static_cast<std::size_t>(method);
    const std::string letters = group_letters(ranks, method);
    table.rows.push_back(
        {{method_cell(ranks.methods[i].method), parameter_cell(ranks.methods[i]),
          NumberCell{mean_ranks[i], 2}, NumberCell{ranks.mpe_m.col(method).mean(), mpe_decimals},
          letters.empty() ? Cell{MissingCell{}} : Cell{TextCell{letters}}},
         "",
         method == order.front()});
  }
}

constexpr const char* kMpe = "MPE";
constexpr const char* kMoe = "MOE";
constexpr const char* kInterval = "Of the mean; layouts are the units.";

bool any_published(std::span<const SettingSummary> summaries) {
  return std::ranges::any_of(summaries, [](const auto& s) { return s.published.has_value(); });
}

bool any_interval(std::span<const SettingSummary> summaries) {
  return std::ranges::any_of(summaries,
                             [](const auto& s) { return interval_of(s.mpe_m).has_value(); });
}

/// Of both errors: ours, its interval and, if there is one, the paper's and the difference.
void add_error_columns(std::vector<Column>& columns, bool published) {
  const std::string ours = published ? "Ours" : "Mean";
  columns.push_back({ours, "m", kMpe, "Mean over runs."});
  columns.push_back({"95 % interval", "m", kMpe, kInterval});
  if (published) {
    columns.push_back({"Paper", "m", kMpe, "As printed."});
    columns.push_back(
        {"Difference", "%", kMpe, "Ours less the paper\u2019s, of the paper\u2019s."});
  }
  columns.push_back({ours, "%", kMoe, "Mean over runs."});
  columns.push_back({"95 % interval", "%", kMoe, kInterval});
  if (published) {
    columns.push_back({"Paper", "%", kMoe, "As printed."});
    columns.push_back({"Difference", "points", kMoe, "Ours less the paper\u2019s."});
  }
}

void add_error_cells(std::vector<Cell>& cells, const SettingSummary& s, bool published,
                     int mpe_decimals) {
  const double paper_mpe = s.published ? s.published->mpe_m : kNaN;
  const double paper_moe = s.published ? s.published->moe_percent : kNaN;
  cells.push_back(mean_cell(s.mpe_m, mpe_decimals));
  cells.push_back(interval_cell(s.mpe_m, mpe_decimals));
  if (published) {
    cells.push_back(NumberCell{paper_mpe, printed_decimals(paper_mpe)});
    // By how much a map diverged says nothing.
    const bool diverged = s.mpe_m && s.mpe_m->mean > kGreatestError_m;
    cells.push_back(diverged ? Cell{MissingCell{}}
                             : Cell{NumberCell{100.0 * mpe_difference_m(s) / paper_mpe, 1, true}});
  }
  cells.push_back(mean_cell(s.moe_percent, kMoeDecimals));
  cells.push_back(interval_cell(s.moe_percent, kMoeDecimals));
  if (published) {
    cells.push_back(NumberCell{paper_moe, printed_decimals(paper_moe)});
    cells.push_back(NumberCell{moe_difference_percent(s), kMoeDecimals, true});
  }
}

void mark_best(Table& table, std::span<const SettingSummary> summaries) {
  const SettingSummary* best = best_of(summaries);
  if (best != nullptr && summaries.size() > 1)
    table.rows[static_cast<std::size_t>(best - summaries.data())].marked = true;
}

bool has_method(std::span<const SettingSummary> tried, Method method) {
  return std::ranges::any_of(
      tried, [&](const SettingSummary& one) { return one.setting.method == method; });
}

/// "Paper: Yairi 2007, Table 1." and the notes on its numbers of the methods that were tried.
void add_paper_notes(Table& table, const Published& published,
                     std::span<const SettingSummary> tried) {
  table.notes.push_back("Paper: " + published.source + ".");
  for (const PublishedValue& value : published.values)
    if (!value.note.empty() && has_method(tried, value.setting.method))
      table.notes.push_back(label(value.setting) + ": " + value.note);
  table.notes.insert(table.notes.end(), published.notes.begin(), published.notes.end());
}

/// "LLE, K = 14": the optima that are the first or the last of several values tried.
std::string optima_at_an_end(const SensorStudy& sensor, std::span<const SettingSummary> best) {
  std::vector<std::string> labels;
  for (const SettingSummary& s : best)
    for (const MethodGrid& grid : sensor.methods)
      if (grid.method == s.setting.method && grid.parameters.size() > 1 && s.scored > 0 &&
          (s.setting.parameter == grid.parameters.front() ||
           s.setting.parameter == grid.parameters.back()))
        labels.push_back(label(s.setting));
  return fmt::format("{}", fmt::join(labels, "; "));
}

}  // namespace

Table half_table(const SensorStudy& sensor, const HalfChoices& choices, int mpe_decimals) {
  const std::string chosen = "Parameter chosen on the";
  const std::string mpe = "MPE";
  const std::string moe = "MOE";
  const std::string other = "Runs that had no part in the choice of their parameter.";
  const std::string same = "The same runs at the parameter of least mean MPE over all of them.";
  Table table;
  table.id = paper_table_id(sensor, "half");
  table.caption = title_of(sensor.sensor.sensor) +
                  ": parameter chosen on half of the runs, error from the other half";
  table.columns = {{"Method", "", "", ""},
                   {"First half", "", chosen, ""},
                   {"Second half", "", chosen, ""},
                   {"Other half", "m", mpe, other},
                   {"95 % interval", "m", mpe, "Of the mean; layouts are the units."},
                   {"Same runs", "m", mpe, same},
                   {"Optimism", "m", mpe, "Other half less same runs, run by run."},
                   {"Its 95 % interval", "m", mpe, ""},
                   {"Other half", "%", moe, other},
                   {"95 % interval", "%", moe, ""}};
  bool any_interval = false;
  for (const HalfChoice& c : choices.methods) {
    any_interval = any_interval || interval_of(c.mpe_m);
    table.rows.push_back(
        {{method_cell(c.method), parameter_cell(c.chosen[0]), parameter_cell(c.chosen[1]),
          mean_cell(c.mpe_m, mpe_decimals), interval_cell(c.mpe_m, mpe_decimals),
          mean_cell(c.same_runs_mpe_m, mpe_decimals),
          c.has_choice ? mean_cell(c.optimism_m, mpe_decimals, true) : Cell{MissingCell{}},
          c.has_choice ? difference_interval_cell(c.optimism_m, mpe_decimals) : Cell{MissingCell{}},
          mean_cell(c.moe_percent, kMoeDecimals), interval_cell(c.moe_percent, kMoeDecimals)},
         "",
         false});
  }
  table.notes.push_back(halves_note(choices));
  table.notes.push_back(interval_note(any_interval));
  return table;
}

Table rank_table(const SensorStudy& sensor, const MethodRanks& ranks, int mpe_decimals) {
  Table table;
  table.id = fmt::format("friedman-{}", name(sensor.sensor.sensor));
  table.caption = title_of(sensor.sensor.sensor) + ": methods ranked by MPE over layouts";
  table.columns = {{"Method", "", "", ""},
                   {"Parameter", "", "", "The one of least mean MPE."},
                   {"Mean rank", "", "", "1 is the least MPE in each layout."},
                   {"MPE", "m", "", "Mean over layouts."},
                   {"Alike", "", "", "Methods that share a letter do not differ significantly."}};
  if (!ranks.test) return table;
  add_rank_rows(table, ranks, mpe_decimals);
  table.notes.push_back(test_note(ranks));
  table.notes.push_back(fmt::format(
      "Methods that share a letter do not differ significantly by Nemenyi\u2019s test at {} %: "
      "their mean ranks differ by less than the critical difference, {}. Layouts are the units, "
      "their poses "
      "averaged.",
      format_number(100.0 * ranks.alpha, 0), significant(ranks.critical_difference)));
  std::vector<std::string> left_out;
  for (const Method method : ranks.left_out) left_out.emplace_back(info(method).label);
  if (!left_out.empty())
    table.notes.push_back(fmt::format("Left out, without a score in some layout: {}.",
                                      listed(left_out, kMostListed)));
  return table;
}

std::string ordering_table_id(const SensorStudy& sensor) {
  return fmt::format("orderings-{}", name(sensor.sensor.sensor));
}

Table ordering_table(const SensorStudy& sensor, std::span<const OrderingClaim> claims,
                     int mpe_decimals) {
  Table table;
  table.id = ordering_table_id(sensor);
  table.caption = title_of(sensor.sensor.sensor) + ": the paper\u2019s orderings";
  table.columns = {{"Less MPE", "", "Claim", ""},
                   {"More MPE", "", "Claim", ""},
                   {"Holds", "", "", "In the mean over runs."},
                   {"Difference", "m", "", "The second method\u2019s MPE less the first\u2019s."},
                   {"95 % interval", "m", "", "Layouts are the units."},
                   {"Layouts", "", "", "Where it holds in the mean over poses."}};
  bool any_interval = false;
  std::size_t left_out = 0;
  for (const OrderingClaim& claim : claims) {
    if (!claim.difference_m) {
      ++left_out;
      continue;
    }
    any_interval = any_interval || claim.difference_m->half_width;
    const std::string holds = fmt::format("{}{}", claim.holds() ? "yes" : "no",
                                          claim.is_significant() ? "" : ", not significant");
    table.rows.push_back({{method_cell(claim.less), method_cell(claim.more), TextCell{holds},
                           mean_cell(claim.difference_m, mpe_decimals, true),
                           difference_interval_cell(claim.difference_m, mpe_decimals),
                           claim.layouts > 0 ? Cell{TextCell{fmt::format(
                                                   "{} of {}", claim.layouts_where, claim.layouts)}}
                                             : Cell{MissingCell{}}},
                          "",
                          false});
  }
  table.notes.push_back(
      "By mean MPE, each method at its best parameter, over the runs that both have a score in. "
      "Not significant: the interval of the difference holds 0, or there is none.");
  table.notes.push_back(interval_note(any_interval));
  if (left_out > 0)
    table.notes.push_back(
        fmt::format("Left out, without a run that both methods have a score in: {}.",
                    counted(left_out, "ordering")));
  return table;
}

std::string paper_table_id(const SensorStudy& sensor, std::string_view kind) {
  const std::string& table = sensor.published.table;
  if (table.empty()) return fmt::format("{}-{}", kind, name(sensor.sensor.sensor));
  return kind == "accuracy" ? table : fmt::format("{}-{}", table, kind);
}

Table accuracy_table(const SensorStudy& sensor, std::span<const SettingSummary> best, bool grid,
                     int mpe_decimals) {
  const bool published = any_published(best);
  Table table;
  table.id = paper_table_id(sensor, "accuracy");
  const std::string number = paper_number(table.id);
  table.caption =
      fmt::format("{}{}: mean position error (MPE) and mean orientation error (MOE) after {}",
                  number.empty() ? "" : number + ". ", title_of(sensor.sensor.sensor),
                  counted(last_step(sensor), "observation"));
  table.columns = {{"Method", "", "", ""}};
  const std::string chosen = "The one of least mean MPE among those tried.";
  if (published) {
    table.columns.push_back({"Ours", "", "Best parameter", chosen});
    table.columns.push_back({"Paper", "", "Best parameter", "The one that the paper found best."});
  } else {
    table.columns.push_back({"Parameter", "", "", chosen});
  }
  add_error_columns(table.columns, published);
  for (const SettingSummary& s : best) {
    std::vector<Cell> cells = {method_cell(s.setting.method), parameter_cell(s.setting)};
    if (published)
      cells.push_back(s.published ? parameter_cell(s.published->setting) : Cell{MissingCell{}});
    add_error_cells(cells, s, published, mpe_decimals);
    table.rows.push_back({std::move(cells), source_of(s), false});
  }
  mark_best(table, best);
  if (grid)
    table.notes.push_back(
        "Each method has the parameter of least mean MPE over these same runs, as in the paper: an "
        "optimistic choice.");
  if (const std::string ends = optima_at_an_end(sensor, best); !ends.empty())
    table.notes.push_back(
        "At an end of the values tried, so that a better one may lie beyond: " + ends + ".");
  table.notes.push_back(interval_note(any_interval(best)));
  if (published) add_paper_notes(table, sensor.published, best);
  return table;
}

Table paper_parameter_table(const SensorStudy& sensor, std::span<const SettingSummary> all,
                            int mpe_decimals) {
  Table table;
  table.id = paper_table_id(sensor, "paper");
  table.caption = title_of(sensor.sensor.sensor) + ": errors at the paper\u2019s parameters";
  table.columns = {{"Method", "", "", ""}, {"Parameter", "", "", "The one that was published."}};
  add_error_columns(table.columns, true);
  table.columns.push_back(
      {"Printed MPE within", "", "",
       "Whether the printed MPE lies in the 95 % interval of ours; not where a note says that the "
       "two cannot be compared."});
  std::vector<std::string> left_out;
  for (const PublishedValue& value : sensor.published.values) {
    if (!has_method(all, value.setting.method)) {
      left_out.emplace_back(info(value.setting.method).label);
      continue;
    }
    SettingSummary s;
    for (const SettingSummary& tried : all)
      if (tried.setting == value.setting) s = tried;
    s.setting = value.setting;
    s.published = value;
    std::vector<Cell> cells = {method_cell(value.setting.method), parameter_cell(value.setting)};
    add_error_cells(cells, s, true, mpe_decimals);
    const auto interval = interval_of(s.mpe_m);
    if (interval && value.note.empty())
      cells.emplace_back(
          TextCell{value.mpe_m >= interval->low && value.mpe_m <= interval->high ? "yes" : "no"});
    else
      cells.emplace_back(MissingCell{});
    table.rows.push_back({std::move(cells), s.runs > 0 ? source_of(s) : "", false});
  }
  table.notes.push_back(
      "Nothing is chosen here: each method has the parameter that was published for it. Where ours "
      "is missing, it was not tried.");
  if (!left_out.empty())
    table.notes.push_back(
        fmt::format("Left out, not in this study: {}.", listed(left_out, kMostListed)));
  table.notes.push_back(interval_note(any_interval(all)));
  return table;
}

Table spread_table(const SensorStudy& sensor, std::span<const SettingSummary> best,
                   int mpe_decimals) {
  const std::string free = "Free of the choice of anchors";
  Table table;
  table.id = fmt::format("behind-{}", name(sensor.sensor.sensor));
  table.caption = title_of(sensor.sensor.sensor) + ": behind the means";
  table.columns = {{"Method", "", "", ""},
                   {"Parameter", "", "", ""},
                   {"Median MPE", "m", "", "Over runs."},
                   {"MPE", "m", free, "The affine map is fitted to all landmarks."},
                   {"MOE", "%", free, "The smaller of MOE and 100 % less MOE."},
                   {"All", "", "Runs", ""},
                   {"Scored", "", "Runs", "Their map could be scored."},
                   {"With warning", "", "Runs", "A warning or a failure."}};
  for (const SettingSummary& s : best)
    table.rows.push_back(
        {{method_cell(s.setting.method), parameter_cell(s.setting),
          NumberCell{s.mpe_median_m, mpe_decimals}, NumberCell{s.mpe_all_fitted_m, mpe_decimals},
          NumberCell{s.moe_unmirrored_percent, kMoeDecimals},
          NumberCell{static_cast<double>(s.runs), 0}, NumberCell{static_cast<double>(s.scored), 0},
          NumberCell{static_cast<double>(s.with_status), 0}},
         source_of(s),
         false});
  table.notes.push_back(
      "MPE depends on which landmarks are anchors. These errors do not: MPE over all landmarks "
      "with the affine map fitted to all of them, and MOE with reflected maps reflected back.");
  return table;
}

Table parameter_table(const SensorStudy& sensor, std::span<const SettingSummary> all,
                      int mpe_decimals) {
  Table table;
  table.id = fmt::format("parameters-{}", name(sensor.sensor.sensor));
  table.caption = title_of(sensor.sensor.sensor) + ": every parameter tried";
  table.columns = {{"Method", "", "", ""},
                   {"Parameter", "", "", ""},
                   {"MPE", "m", "", "Mean over runs."},
                   {"95 % interval", "m", "", ""},
                   {"MOE", "%", "", "Mean over runs."},
                   {"Scored", "", "", ""},
                   {"With warning", "", "", ""}};
  for (const SettingSummary& s : all)
    table.rows.push_back(
        {{method_cell(s.setting.method), parameter_cell(s.setting),
          mean_cell(s.mpe_m, mpe_decimals), interval_cell(s.mpe_m, mpe_decimals),
          mean_cell(s.moe_percent, kMoeDecimals), NumberCell{static_cast<double>(s.scored), 0},
          NumberCell{static_cast<double>(s.with_status), 0}},
         source_of(s),
         false});
  mark_best(table, all);
  return table;
}

}  // namespace mapproof
