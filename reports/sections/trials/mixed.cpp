#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "core/base/not_finite.hpp"
#include "reports/sections/trials/topic_text.hpp"
#include "reports/sections/trials/trial_means.hpp"

namespace mapproof {
namespace {

constexpr const char* kSingles[] = {"visibility",       "bearing",       "range",
                                    "visibility-order", "bearing-order", "range-order"};
constexpr const char* kMixes[] = {"equal", "reliable", "joint"};

std::string mixed_question(const TrialExperiment&) {
  return fmt::format(
      "Is one map of several sensors better than that of the best of them? Singly, visibility is "
      "mapped by {}, bearing and range by {}. Together, by the mean of their distances, with equal "
      "weights or with weights by how far both halves of the steps agree; or jointly, each "
      "sensor's distances trusted in their order alone. The joint map's way is tried on each "
      "sensor alone, too.",
      label({Method::kIsomap, 6.0}), label({Method::kSmacofKnn, 8.0}));
}

/// The series of least mean MPE among some, and that mean; null if none has one.
struct BestSeries {
  const TrialSeries* series = nullptr;
  double mean_m = HUGE_VAL;
};

template <typename Names>
BestSeries best_series(const TrialStudy& study, const Condition& at, const Names& names) {
  BestSeries best;
  for (const TrialSeries& series : study.design.series) {
    if (std::ranges::find(names, series.id) == std::end(names)) continue;
    const double mean = trial_mean(study, at, series.id, "mpe_m");
    if (mean < best.mean_m) best = {&series, mean};
  }
  return best;
}

/// "at noise of bearings 20° joint map has a mean MPE of 0.012 m, range alone 0.013 m (better)".
std::string mixed_words_at(const TrialStudy& study, const TrialSetup& setup, const Condition& at) {
  const BestSeries single = best_series(study, at, kSingles);
  const BestSeries mix = best_series(study, at, kMixes);
  if (single.series == nullptr || mix.series == nullptr) return "";
  const auto difference = trial_difference(study, at, mix.series->id, single.series->id, "mpe_m");
  return fmt::format("at {}, {} has a mean MPE of {:.3f} m and {} one of {:.3f} m ({})",
                     level_words(setup, at), mix.series->label, mix.mean_m, single.series->label,
                     single.mean_m, difference ? verdict_words(*difference) : "no run has both");
}

/// What it costs to take the map that keeps most neighbourhoods: its MPE less that of the best map,
/// and the joint map's less that, means over the parts.
std::string choice_words(const TrialStudy& study, const TrialSetup& setup) {
  double picked = 0.0, joint = 0.0, count = 0.0;
  for (const TrialPart& part : study.parts)
    for (const Condition& at : conditions_of(setup)) {
      const Trial* pick = nullptr;
      double best_m = HUGE_VAL, joint_m = kNaN;
      for (const Trial& trial : part.trials) {
        if (trial.at != at || !std::isfinite(trial_value(trial, "mpe_m"))) continue;
        if (pick == nullptr || trial_value(trial, "continuity") > trial_value(*pick, "continuity"))
          pick = &trial;
        best_m = std::min(best_m, trial_value(trial, "mpe_m"));
        if (trial.series == "joint") joint_m = trial_value(trial, "mpe_m");
      }
      if (pick == nullptr || std::isnan(joint_m)) continue;
      picked += trial_value(*pick, "mpe_m") - best_m, joint += joint_m - best_m, count += 1.0;
    }
  if (count == 0.0) return "";
  return fmt::format(
      "{}: the map that keeps most neighbourhoods of all sensors has an MPE {:.3f} m above the "
      "best map's, the joint map one of {:.3f} m above it.",
      setup.title, picked / count, joint / count);
}

std::vector<std::string> mixed_conclusions(const TrialStudy& study) {
  std::vector<std::string> sentences;
  for (const TrialSetup& setup : study.design.setups) {
    const std::vector<Condition> conditions = conditions_of(setup);
    std::vector<std::string> ends = {mixed_words_at(study, setup, conditions.front())};
    if (conditions.size() > 1) ends.push_back(mixed_words_at(study, setup, conditions.back()));
    std::erase(ends, "");
    if (!ends.empty())
      sentences.push_back(
          fmt::format("{}: the best map of both sensors compared with the best of one sensor: {}.",
                      setup.title, fmt::join(ends, "; ")));
  }
  for (const TrialSetup& setup : study.design.setups)
    if (std::string words = choice_words(study, setup); !words.empty())
      sentences.push_back(std::move(words));
  return sentences;
}

}  // namespace

const TopicWords kMixedWords = {
    .topic = "mixed", .question = mixed_question, .conclusions = mixed_conclusions};

}  // namespace mapproof
