#include "reports/sections/method_ranks.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <utility>

#include "core/statistics/nemenyi.hpp"
#include "reports/sections/method_summary.hpp"
#include "reports/sections/run_scores.hpp"

namespace mapproof {
namespace {

/// The scores of each method at the parameter of least mean MPE, as best_of_each_method() chooses.
std::vector<SettingScores> best_scores(const Study& study, const SensorStudy& sensor) {
  const auto best = best_of_each_method(summarize(study, sensor, last_step(sensor)));
  std::vector<SettingScores> scores = run_scores(study, sensor, last_step(sensor));
  std::erase_if(scores, [&](const SettingScores& candidate) {
    return std::ranges::none_of(
        best, [&](const SettingSummary& s) { return s.setting == candidate.setting; });
  });
  return scores;
}

bool has_layout(const SettingScores& scores, int layout) {
  return std::ranges::any_of(scores.runs,
                             [&](const auto& run) { return run.first.layout == layout; });
}

/// Mean MPE of each method over the poses of one layout that all have; empty if there is none.
std::optional<Eigen::RowVectorXd> layout_means(const std::vector<SettingScores>& methods,
                                               int layout) {
  Eigen::RowVectorXd sums = Eigen::RowVectorXd::Zero(static_cast<Eigen::Index>(methods.size()));
  int poses = 0;
  for (const auto& [run, score] : methods.front().runs) {
    if (run.layout != layout) continue;
    if (!std::ranges::all_of(methods, [&](const auto& m) { return m.runs.contains(run); }))
      continue;
    ++poses;
    for (std::size_t i = 0; i < methods.size(); ++i)
      sums(static_cast<Eigen::Index>(i)) += methods[i].runs.at(run).mpe_m;
  }
  if (poses == 0 || !sums.allFinite()) return std::nullopt;
  return sums / poses;
}

OrderingClaim claim_of(Method less, Method more, const std::vector<SettingScores>& scores) {
  OrderingClaim claim{.less = less, .more = more, .difference_m = {}};
  const auto find = [&](Method method) {
    return std::ranges::find(scores, method, [](const auto& s) { return s.setting.method; });
  };
  const auto a = find(less);
  const auto b = find(more);
  if (a == scores.end() || b == scores.end()) return claim;
  const RunValues differences = mpe_differences_m(*a, *b);
  claim.difference_m = differences.mean();
  std::map<int, double> sums;
  for (std::size_t i = 0; i < differences.values.size(); ++i)
    sums[differences.runs[i].layout] += differences.values[i];
  claim.layouts = static_cast<int>(sums.size());
  claim.layouts_where = static_cast<int>(
      std::ranges::count_if(sums, [](const auto& layout) { return layout.second > 0.0; }));
  return claim;
}

}  // namespace

MethodRanks method_ranks(const Study& study, const SensorStudy& sensor, double alpha) {
  MethodRanks ranks;
  ranks.alpha = alpha;
  std::set<int> layouts;
  for (const Run& run : study.runs) layouts.insert(run.id.layout);
  std::vector<SettingScores> compared;
  for (SettingScores& scores : best_scores(study, sensor)) {
    if (std::ranges::all_of(layouts, [&](int layout) { return has_layout(scores, layout); }))
      compared.push_back(std::move(scores));
    else
      ranks.left_out.push_back(scores.setting.method);
  }
  if (compared.empty() || layouts.empty()) return ranks;
  for (const SettingScores& scores : compared) ranks.methods.push_back(scores.setting);
  std::vector<Eigen::RowVectorXd> rows;
  for (const int layout : layouts)
    if (auto means = layout_means(compared, layout)) {
      ranks.layouts.push_back(layout);
      rows.push_back(*std::move(means));
    }
  ranks.mpe_m.resize(std::ssize(rows), std::ssize(compared));
  for (Eigen::Index i = 0; i < ranks.mpe_m.rows(); ++i)
    ranks.mpe_m.row(i) = rows[static_cast<std::size_t>(i)];
  if (rows.size() < 2 || compared.size() < 2) return ranks;
  ranks.test = friedman(ranks.mpe_m);
  ranks.critical_difference =
      nemenyi_critical_difference(ranks.test->methods, ranks.test->units, alpha);
  ranks.alike = alike_groups(ranks.test->mean_ranks, ranks.critical_difference);
  return ranks;
}

SensorComparison compare_methods(const Study& study, const SensorStudy& sensor) {
  SensorComparison comparison;
  std::vector<MethodRuns> methods;
  for (const SettingScores& scores : best_scores(study, sensor)) {
    if (!scores.runs.empty())
      methods.push_back({comparison.settings.size(), errors_of(scores, &Score::mpe_m).by_run()});
    comparison.settings.push_back(scores.setting);
  }
  comparison.paired = compare_runs(std::move(methods), layouts_by_run(study), true);
  return comparison;
}

std::string disagreement_of(const SensorComparison& comparison) {
  if (!comparison.paired) return "";
  return disagreement_of(
      *comparison.paired, [&](std::size_t method) { return label(comparison.settings[method]); },
      "layout");
}

bool OrderingClaim::is_significant() const {
  return difference_m && difference_m->half_width &&
         std::abs(difference_m->mean) > *difference_m->half_width;
}

std::vector<OrderingClaim> ordering_claims(const Study& study, const SensorStudy& sensor) {
  const auto& orderings = sensor.published.orderings;
  if (orderings.empty()) return {};
  const std::vector<SettingScores> scores = best_scores(study, sensor);
  std::vector<OrderingClaim> claims;
  std::set<std::pair<Method, Method>> seen;
  for (const std::vector<Method>& ordering : orderings)
    for (std::size_t i = 1; i < ordering.size(); ++i)
      if (seen.emplace(ordering[i - 1], ordering[i]).second)
        claims.push_back(claim_of(ordering[i - 1], ordering[i], scores));
  return claims;
}

}  // namespace mapproof
