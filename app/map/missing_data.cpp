#include <algorithm>

#include <fmt/format.h>

#include "app/map/pipeline.hpp"
#include "core/base/text/words.hpp"
#include "core/missing/covisible.hpp"
#include "core/missing/filled.hpp"
#include "core/missing/missing_pattern.hpp"

namespace mapproof {
namespace {

constexpr const char* kCovisible = "covisible";
constexpr const char* kAuto = "auto";
constexpr double kMostWork = 5e10;  ///< Products of entries that judging missing data may take.
constexpr double kFewPairs = 0.1;   ///< Share of unreliable pairs that causes a warning.

Eigen::Index infinite_pairs(const Proximities& proximities) {
  return (!proximities.squared_distances.array().isFinite()).count() / 2;
}

DistanceRule covisible_rule() {
  const auto covisible = [](const ObservationHistory& history, Eigen::Index steps) {
    return covisible_proximities(history, steps, CovisibleOptions());
  };
  const auto noted = [covisible](const ObservationHistory& history, Eigen::Index steps) {
    const CovisibleOptions options;
    NotedProximities result{.proximities = covisible(history, steps), .notes = {}};
    result.notes.remarks.push_back(fmt::format(
        "Distances are measured between each landmark and the {} that share most of its "
        "steps, {} steps or more; other pairs take the shortest path.",
        options.neighbours, options.least_common));
    const Eigen::Index left_out = infinite_pairs(result.proximities);
    if (left_out > 0)
      result.notes.completed = status_of<StatusReason::kNotCovisible>(
          left_out, infinite_pairs(proximities(history, steps)));
    return result;
  };
  return {noted, covisible};
}

/// Whether another strategy than the advised one makes much worse maps: data missing at random
/// spoil covisible pairs, patterns spoil the others; pairwise-complete is only a little worse at
/// random.
bool worth_a_warning(const MissingPattern& pattern, const std::string& strategy) {
  constexpr double kPatterned = 2.0;
  return strategy == kCovisible || pattern.dispersion > kPatterned;
}

/// "entries are missing by distance (40 % missing, ...)": why a strategy is advised.
std::string advice_words(StrategyReason why, const MissingPattern& pattern) {
  const std::string numbers = fmt::format(
      "{:.0f} % missing, steps that pairs share {:.1f} standard deviations from chance, rank "
      "correlation with their distances {:.2f}, {:.1f} % of the pairs with fewer than five steps",
      100.0 * pattern.missing_share, pattern.dispersion, pattern.nearness,
      100.0 * pattern.few_share);
  switch (why) {
    case StrategyReason::kNothingMissing:
      return "nothing is missing";
    case StrategyReason::kOfVisibility:
      return "entries of visibility are not filled in";
    case StrategyReason::kHardlyEver:
      return "many pairs are hardly ever observed together, near ones are (" + numbers + ")";
    case StrategyReason::kByDistance:
      return "entries are missing by distance (" + numbers + ")";
    case StrategyReason::kByAPattern:
      return "entries are missing by a pattern that can be filled in (" + numbers + ")";
    case StrategyReason::kAtRandom:
      return "entries are missing as if at random (" + numbers + ")";
  }
  return "";
}

DistanceRule filling_rule(Filling filling, int dimensions) {
  FillingOptions options;
  options.filling = filling;
  options.ppca.dimensions = options.pca.dimensions = dimensions;
  const auto noted = [options](const ObservationHistory& history, Eigen::Index steps) {
    FilledProximities filled = filled_proximities(history, steps, options);
    NotedProximities result;
    result.notes.statuses = filled.statuses;
    const auto missing = history.values.leftCols(steps).array().isNaN().count();
    if (filled.model.loadings.size() > 0) {
      result.notes.remarks.push_back(fmt::format(
          "Entries filled in by {2} of {1}: {0}. The distances with them differ from the "
          "pairwise-complete ones, where there are any, by {3:.1f} % in the median.",
          missing, counted(filled.model.loadings.cols(), "dimension"),
          options.filling == Filling::kPpca ? "PPCA" : "PCA",
          100.0 * median_disagreement(filled.proximities, proximities(history, steps))));
    }
    result.proximities = std::move(filled.proximities);
    return result;
  };
  const auto alone = [options](const ObservationHistory& history, Eigen::Index steps) {
    return filled_proximities(history, steps, options).proximities;
  };
  return {noted, alone};
}

/// The chosen strategy for missing data.
struct MissingChoice {
  std::string strategy;  ///< One of missing_strategies().
  std::optional<int> dimensions;
};

/// Warns if the pattern of missing data advises another strategy, and chooses one for "auto".
/// Entries that are all there, or too many to be judged in short, are not judged.
/// @param history  Of landmarks that were all observed.
/// @return The choice with a strategy other than "auto".
MissingChoice judged_choice(MissingChoice choice, const HistoryBlocks& history, Eigen::Index steps,
                            MapResult& result) {
  const auto landmarks = static_cast<double>(history.landmarks());
  const double work = landmarks * landmarks * static_cast<double>(steps);
  const bool is_auto = choice.strategy == kAuto;
  if (is_auto) choice.strategy = name(MissingStrategy::kPairwiseComplete);
  if (history.landmarks() < 2 || (!is_auto && work > kMostWork)) return choice;
  const MissingPattern pattern = missing_pattern(history, steps);
  const StrategyAdvice advice = advised_strategy(pattern, history.sensor());
  if (is_auto) {
    choice.strategy = name(advice.strategy);
    if (choice.dimensions && advice.strategy != MissingStrategy::kPpca) choice.dimensions.reset();
    result.remarks.push_back(fmt::format("Missing data: the strategy is {}, because {}.",
                                         choice.strategy, advice_words(advice.why, pattern)));
  } else if (const bool both_fill =
                 advice.strategy == MissingStrategy::kPpca && choice.strategy == "pca";
             choice.strategy != name(advice.strategy) && !both_fill && pattern.dispersion > 0.0 &&
             history.sensor() != Sensor::kVisibility && worth_a_warning(pattern, choice.strategy)) {
    result.warnings.push_back(fmt::format(
        "--missing {} does not suit these missing data best: {}. --missing {} is likely "
        "to give a better map.",
        choice.strategy, advice_words(advice.why, pattern), name(advice.strategy)));
  }
  if (pattern.few_share > kFewPairs)
    result.warnings.push_back(fmt::format(
        "{:.0f} % of the pairs of landmarks have fewer than five steps in common, {:.0f} % none: "
        "their distances are not reliable.",
        100.0 * pattern.few_share, 100.0 * pattern.apart_share));
  return choice;
}

/// The same of a history with landmarks that were never observed, which count for nothing.
MissingChoice judged_of_seen(const MissingChoice& choice, const HistoryBlocks& history,
                             Eigen::Index steps, MapResult& result) {
  return judged_choice(choice, history.only(seen_landmarks(history, steps)), steps, result);
}

/// From observations to proximities as it was chosen; empty: as always.
/// @param choice  Not "auto" (see judged_choice).
DistanceRule distance_rule(const MissingChoice& choice) {
  const std::optional<Filling> filling = filling_named(choice.strategy);
  if (filling == Filling::kPpca || filling == Filling::kPca)
    return filling_rule(*filling, choice.dimensions.value_or(10));
  if (choice.strategy == kCovisible) return covisible_rule();
  return {};
}

MapDraft judge_missing(MapDraft draft, const MapJob& job) {
  if (job.missing != MapJob().missing) hold_array(draft);  // Its rule takes an array.
  MissingChoice choice{job.missing, job.dimensions};
  const Eigen::Index steps = draft.result.record.step;
  if (const auto* packed = std::get_if<PackedSource>(&draft.observed))
    choice = judged_of_seen(choice, packed->history.blocks(), steps, draft.result);
  else if (const auto* source = std::get_if<ObservationSource>(&draft.observed))
    choice = judged_of_seen(choice, source->history, steps, draft.result);
  else
    return draft;
  draft.distances = distance_rule(choice);
  return draft;
}

}  // namespace

const MapStep kMissingData{judge_missing};

}  // namespace mapproof
