#include "reports/sections/tables/comparison_tables.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include <fmt/format.h>

#include "core/base/text/words.hpp"
#include "reports/model/format.hpp"
#include "reports/sections/tables/accuracy_tables.hpp"
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

std::string p_text(double p) {
  return p < 0.001 ? "p < 0.001" : fmt::format("p = {}", format_number(p, 3));
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
                            ? fmt::format("F = {}, {}", format_number(test.f, 2), p_text(test.f_p))
                            : "F is infinite, all layouts agreeing";
  return fmt::format(
      "Friedman\u2019s test that no method differs, over {}: \u03C7\u00B2 = {}, {}; in Iman and "
      "Davenport\u2019s form {}.",
      counted(test.units, "layout"), format_number(test.chi_square, 2), p_text(test.chi_square_p),
      f);
}

void add_rank_rows(Table& table, const MethodRanks& ranks) {
  const int decimals = ranks.mpe_m.size() > 0 && ranks.mpe_m.minCoeff() < 0.1 ? 4 : 3;
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
          NumberCell{mean_ranks[i], 2}, NumberCell{ranks.mpe_m.col(method).mean(), decimals},
          letters.empty() ? Cell{MissingCell{}} : Cell{TextCell{letters}}},
         "",
         method == order.front()});
  }
}

}  // namespace

Table half_table(const SensorStudy& sensor, const HalfChoices& choices) {
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
  const bool small = std::ranges::any_of(choices.methods, [](const HalfChoice& choice) {
    return choice.mpe_m && choice.mpe_m->mean < 0.1;
  });
  const int decimals = small ? 4 : 3;
  bool any_interval = false;
  for (const HalfChoice& c : choices.methods) {
    any_interval = any_interval || interval_of(c.mpe_m);
    table.rows.push_back(
        {{method_cell(c.method), parameter_cell(c.chosen[0]), parameter_cell(c.chosen[1]),
          mean_cell(c.mpe_m, decimals), interval_cell(c.mpe_m, decimals),
          mean_cell(c.same_runs_mpe_m, decimals),
          c.has_choice ? mean_cell(c.optimism_m, decimals, true) : Cell{MissingCell{}},
          c.has_choice ? difference_interval_cell(c.optimism_m, decimals) : Cell{MissingCell{}},
          mean_cell(c.moe_percent, kMoeDecimals), interval_cell(c.moe_percent, kMoeDecimals)},
         "",
         false});
  }
  table.notes.push_back(halves_note(choices));
  table.notes.push_back(interval_note(any_interval));
  return table;
}

Table rank_table(const SensorStudy& sensor, const MethodRanks& ranks) {
  Table table;
  table.id = fmt::format("friedman-{}", name(sensor.sensor.sensor));
  table.caption = title_of(sensor.sensor.sensor) + ": methods ranked by MPE over layouts";
  table.columns = {{"Method", "", "", ""},
                   {"Parameter", "", "", "The one of least mean MPE."},
                   {"Mean rank", "", "", "1 is the least MPE in each layout."},
                   {"MPE", "m", "", "Mean over layouts."},
                   {"Alike", "", "", "Methods that share a letter do not differ significantly."}};
  if (!ranks.test) return table;
  add_rank_rows(table, ranks);
  table.notes.push_back(test_note(ranks));
  table.notes.push_back(fmt::format(
      "Methods that share a letter do not differ significantly by Nemenyi\u2019s test at {} %: "
      "their mean ranks differ by less than the critical difference, {}. Layouts are the units, "
      "their poses "
      "averaged.",
      format_number(100.0 * ranks.alpha, 0), format_number(ranks.critical_difference, 2)));
  std::vector<std::string> left_out;
  for (const Method method : ranks.left_out) left_out.emplace_back(info(method).label);
  if (!left_out.empty())
    table.notes.push_back(fmt::format("Left out, without a score in some layout: {}.",
                                      listed(left_out, kMostListed)));
  return table;
}

Table ordering_table(const SensorStudy& sensor, std::span<const OrderingClaim> claims) {
  Table table;
  table.id = fmt::format("orderings-{}", name(sensor.sensor.sensor));
  table.caption = title_of(sensor.sensor.sensor) + ": the paper\u2019s orderings";
  table.columns = {{"Less MPE", "", "Claim", ""},
                   {"More MPE", "", "Claim", ""},
                   {"Holds", "", "", "In the mean over runs."},
                   {"Difference", "m", "", "The second method\u2019s MPE less the first\u2019s."},
                   {"95 % interval", "m", "", "Layouts are the units."},
                   {"Layouts", "", "", "Where it holds in the mean over poses."}};
  bool any_interval = false;
  for (const OrderingClaim& claim : claims) {
    any_interval = any_interval || (claim.difference_m && claim.difference_m->half_width);
    const int decimals = claim.difference_m && std::abs(claim.difference_m->mean) < 0.1 ? 4 : 3;
    std::string holds = "not tried";
    if (claim.difference_m)
      holds = fmt::format("{}{}", claim.holds() ? "yes" : "no", claim.is_sure() ? "" : ", unsure");
    table.rows.push_back({{method_cell(claim.less), method_cell(claim.more), TextCell{holds},
                           mean_cell(claim.difference_m, decimals, true),
                           difference_interval_cell(claim.difference_m, decimals),
                           claim.layouts > 0 ? Cell{TextCell{fmt::format(
                                                   "{} of {}", claim.layouts_where, claim.layouts)}}
                                             : Cell{MissingCell{}}},
                          "",
                          false});
  }
  table.notes.push_back(
      "By mean MPE, each method at its best parameter, over the runs that both have a score in. "
      "Unsure: the interval of the difference holds 0, or there is none.");
  table.notes.push_back(interval_note(any_interval));
  return table;
}

}  // namespace mapproof
