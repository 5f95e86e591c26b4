#include "reports/sections/half_choice.hpp"

#include <algorithm>
#include <iterator>
#include <set>

#include "core/base/not_finite.hpp"
#include "reports/sections/method_summary.hpp"
#include "reports/sections/run_scores.hpp"

namespace mapproof {
namespace {

/// Which half a run is in: 0 or 1.
class Parting {
 public:
  explicit Parting(const Study& study) {
    std::set<int> layouts;
    std::set<int> poses;
    for (const Run& run : study.runs) {
      layouts.insert(run.id.layout);
      poses.insert(run.id.pose);
    }
    if (layouts.size() > 1) {
      halves_ = Halves::kLayouts;
      numbers_.assign(layouts.begin(), layouts.end());
    } else if (poses.size() > 1) {
      halves_ = Halves::kPoses;
      numbers_.assign(poses.begin(), poses.end());
    }
  }

  Halves halves() const { return halves_; }

  std::size_t half_of(const RunId& run) const {
    const int number = halves_ == Halves::kLayouts ? run.layout : run.pose;
    return static_cast<std::size_t>(std::ranges::lower_bound(numbers_, number) - numbers_.begin()) %
           2;
  }

  std::array<std::vector<int>, 2> members() const {
    std::array<std::vector<int>, 2> members;
    for (std::size_t i = 0; i < numbers_.size(); ++i) members[i % 2].push_back(numbers_[i]);
    return members;
  }

 private:
  Halves halves_ = Halves::kNone;
  std::vector<int> numbers_;  ///< Ascending; every other one belongs to the second half.
};

/// The setting of least mean MPE over the runs for which `counts` holds; null if none has a score.
template <typename Counts>
const SettingScores* least(std::span<const SettingScores> settings, Counts counts) {
  const SettingScores* best = nullptr;
  double least_mean = kInfinity;
  for (const SettingScores& setting : settings) {
    RunValues mpe;
    for (const auto& [run, score] : setting.runs)
      if (counts(run)) mpe.add(run, score.mpe_m);
    const auto mean = mpe.mean();
    if (!mean || !(mean->mean < least_mean)) continue;
    best = &setting;
    least_mean = mean->mean;
  }
  return best;
}

/// Each run's score with the setting that the other half chose.
SettingScores judged(const std::array<const SettingScores*, 2>& chosen, const Parting& parting) {
  SettingScores scores;
  for (const std::size_t half : {0U, 1U}) {
    if (chosen[half] == nullptr) continue;
    for (const auto& [run, score] : chosen[half]->runs)
      if (parting.half_of(run) != half) scores.runs.emplace(run, score);
  }
  return scores;
}

HalfChoice choice_of(std::span<const SettingScores> settings, const Parting& parting) {
  HalfChoice choice;
  choice.method = settings.front().setting.method;
  choice.has_choice = settings.size() > 1;
  std::array<const SettingScores*, 2> chosen{};
  for (const std::size_t half : {0U, 1U}) {
    chosen[half] = least(settings, [&](const RunId& run) { return parting.half_of(run) == half; });
    if (chosen[half] != nullptr) choice.chosen[half] = chosen[half]->setting;
  }
  const SettingScores other = judged(chosen, parting);
  const SettingScores* best = least(settings, [](const RunId&) { return true; });
  if (best == nullptr) return choice;
  RunValues mpe, moe, best_mpe;
  for (const auto& [run, score] : other.runs) {
    mpe.add(run, score.mpe_m);
    moe.add(run, score.moe_percent);
    if (const auto same = best->runs.find(run); same != best->runs.end())
      best_mpe.add(run, same->second.mpe_m);
  }
  choice.mpe_m = mpe.mean();
  choice.moe_percent = moe.mean();
  choice.same_runs_mpe_m = best_mpe.mean();
  choice.optimism_m = mpe_differences_m(*best, other).mean();
  return choice;
}

}  // namespace

HalfChoices half_choices(const Study& study, const SensorStudy& sensor) {
  const Parting parting(study);
  HalfChoices choices{parting.halves(), parting.members(), {}};
  if (choices.halves == Halves::kNone) return choices;
  const std::vector<SettingScores> scores = run_scores(study, sensor, last_step(sensor));
  for (const auto& settings : by_method(scores))
    choices.methods.push_back(choice_of(settings, parting));
  return choices;
}

double optimism_percent(const HalfChoice& choice) {
  if (!choice.optimism_m || !choice.same_runs_mpe_m || !(choice.same_runs_mpe_m->mean > 0.0))
    return kNaN;
  return 100.0 * choice.optimism_m->mean / choice.same_runs_mpe_m->mean;
}

}  // namespace mapproof
