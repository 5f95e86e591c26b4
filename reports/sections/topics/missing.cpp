#include <algorithm>
#include <cmath>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "core/base/not_finite.hpp"
#include "core/base/text/number_text.hpp"
#include "reports/model/format.hpp"
#include "reports/sections/topics/topic_means.hpp"
#include "reports/sections/topics/topic_text.hpp"

namespace mapproof {
namespace {

/// Series that the topic compares: the strategy chosen, and the two that it chooses from.
constexpr const char* kAdvised = "auto";
constexpr const char* kPairwiseComplete = "pairwise-complete-smacof-knn";
constexpr const char* kPpca = "ppca-smacof-knn";

std::string missing_question(const TopicExperiment& experiment) {
  return fmt::format(
      "Bearings of all landmarks are simulated and a share of them is taken away: at random, those "
      "of the most distant landmarks, or those that wide landmarks hide. How well can the rest be "
      "mapped? PPCA and PCA of {0:g} dimensions or the landmarks' means fill the missing data, or "
      "pairwise-complete distances do without them. Covisible pairs are the {1:g} landmarks that "
      "each is most often observed with. kNN-SMACOF (K = {2:g}) and ISOMAP (K = {3:g}) map the "
      "distances. Maps are aligned to the anchors in least squares.",
      number_option(experiment, "dimensions"), number_option(experiment, "covisible_neighbours"),
      number_option(experiment, "smacof_neighbours"),
      number_option(experiment, "isomap_neighbours"));
}

/// "PPCA, SMACOF 0.057 m; ...": the three best at one level, and the worst.
std::string ranking(const TopicStudy& study, const Condition& at) {
  std::vector<std::pair<double, std::string>> means;
  for (const StudiedMethod& method : study.design.methods) {
    const double mean = topic_mean(study, at, method.id, "mpe_m");
    if (!std::isnan(mean)) means.emplace_back(mean, method.label);
  }
  std::ranges::sort(means);
  constexpr std::size_t kBest = 3;
  std::string words;
  for (std::size_t k = 0; k < means.size(); ++k) {
    const bool last = k + 1 == means.size();
    if (k >= kBest && !last) continue;
    words += fmt::format("{}{} {}",
                         k == 0               ? ""
                         : last && k >= kBest ? "; worst: "
                                              : "; ",
                         means[k].second, error_text(means[k].first));
  }
  return words;
}

/// Mean over parts and levels of one way's MPE less that of the best way there; NaN without any.
/// @param method  Its kNN-SMACOF maps, or the advised ones.
double regret_m(const TopicStudy& study, const std::string& method) {
  double sum = 0.0, count = 0.0;
  for (const TopicPart& part : study.parts)
    for (const TopicOutcome& outcome : part.outcomes) {
      if (outcome.method != method || !std::isfinite(topic_value(outcome, "mpe_m"))) continue;
      double best = topic_value(outcome, "mpe_m");
      for (const TopicOutcome& other : part.outcomes)
        if (other.at == outcome.at && std::isfinite(topic_value(other, "mpe_m")))
          best = std::min(best, topic_value(other, "mpe_m"));
      sum += topic_value(outcome, "mpe_m") - best;
      count += 1.0;
    }
  return count > 0.0 ? sum / count : kNaN;
}

std::string advice_words(const TopicStudy& study) {
  return fmt::format(
      "Choosing the strategy by the pattern of missing data costs {} of MPE over the best "
      "map of each outcome "
      "on average; pairwise-complete distances always cost {}, PPCA always {}.",
      regret_text(regret_m(study, kAdvised)), regret_text(regret_m(study, kPairwiseComplete)),
      regret_text(regret_m(study, kPpca)));
}

std::vector<std::string> missing_conclusions(const TopicStudy& study) {
  std::vector<std::string> sentences;
  if (const double regret = regret_m(study, kAdvised); !std::isnan(regret))
    sentences.push_back(advice_words(study));
  for (const TopicSetup& setup : study.design.setups)
    for (const double level : levels_of(setup)) {
      const Condition at = condition_at(setup, level);
      const std::string words = ranking(study, at);
      if (words.empty() || (level != levels_of(setup).back() && level != 50.0)) continue;
      sentences.push_back(fmt::format("{}, {}, mean MPE: {}{}.", setup.title,
                                      level_words(setup, at), words, few_layouts_words(study)));
    }
  return sentences;
}

/// Compared with whichever fixed strategy has the smaller mean error.
TopicHeadline missing_headline(const TopicStudy& study) {
  const double regret = regret_m(study, kAdvised);
  if (std::isnan(regret)) return {};
  const double pairwise = regret_m(study, kPairwiseComplete);
  const double ppca = regret_m(study, kPpca);
  const auto [value, words] = regret_words(regret);
  TopicHeadline headline{
      .value = value,
      .label = fmt::format("{} the best map: the strategy chosen for missing data", words),
      .detail = fmt::format("always pairwise-complete {}, always PPCA {}", regret_text(pairwise),
                            regret_text(ppca)),
      .quantity = "mpe_m"};
  const bool is_ppca = ppca < pairwise;
  const auto difference = topic_difference(study, all_conditions(study), kAdvised,
                                           is_ppca ? kPpca : kPairwiseComplete, "mpe_m");
  if (difference)
    judge(headline, *difference,
          fmt::format("{}, compared with always {}", verdict_words(*difference),
                      is_ppca ? "PPCA" : "pairwise-complete"));
  return headline;
}

/// What each strategy costs over the best map of an outcome, patterns of missing data beside each
/// other.
ResultsStudy regrets_of(const ResultsStudy& results) {
  constexpr const char* kRegret = "regret_m";
  const std::string pattern = "pattern";
  ResultsStudy study;
  study.name = results.name;
  study.title = results.title;
  study.quantities = {kRegret};
  for (const char* id : {kAdvised, kPairwiseComplete, kPpca})
    if (const auto method = std::ranges::find(results.methods, id, &Label::id);
        method != results.methods.end())
      study.methods.push_back(*method);
  study.factors = results.factors;
  study.factors.push_back({pattern, "pattern of missing data"});
  study.results.quantities.declare(
      study_quantity(kRegret, "MPE above the best map\u2019s", "m", Better::kLower));
  study.results.are_repeats = results.results.are_repeats;
  const auto is_error = [](const Result& row) {
    return row.quantity == "mpe_m" && std::isfinite(row.value);
  };
  std::map<std::pair<Condition, Name>, double> best;
  for (const Result& row : results.results.rows)
    if (is_error(row)) {
      double& least = best.try_emplace({row.at, row.run}, row.value).first->second;
      least = std::min(least, row.value);
    }
  for (const Result& row : results.results.rows) {
    if (!is_error(row) ||
        std::ranges::find(study.methods, row.method.get(), &Label::id) == study.methods.end())
      continue;
    std::vector<Level> levels = row.at.levels;
    levels.push_back({pattern, label_of(results.setups, row.at.setup)});
    Result& regret = study.results.rows.emplace_back(row);
    regret.at = condition({}, std::move(levels));
    regret.quantity = kRegret;
    regret.value = row.value - best.at({row.at, row.run});
  }
  sort_results(study.results);
  complete(study);
  return study;
}

}  // namespace

const TopicWords kMissingWords = {
    .topic = "missing",
    .question = missing_question,
    .compared_with = "the best map of each outcome, and each strategy used always",
    .conclusions = missing_conclusions,
    .headline = missing_headline,
    .evidence = regrets_of};

}  // namespace mapproof
