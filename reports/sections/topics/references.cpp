#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "core/base/text/number_text.hpp"
#include "core/model/method.hpp"
#include "reports/model/format.hpp"
#include "reports/sections/topics/topic_means.hpp"
#include "reports/sections/topics/topic_text.hpp"

namespace mapproof {
namespace {

std::string references_question(const TopicExperiment& experiment) {
  return fmt::format(
      "{} landmarks are mapped by ISOMAP, which searches the shortest paths from every landmark, "
      "and by Landmark ISOMAP, which searches them from a few reference landmarks alone. Landmark "
      "MVU unfolds the references alone, as SDE unfolds all. How many references does a map need?",
      experiment.world.landmarks);
}

/// The design's method whose id begins so; empty: it has none.
std::string method_of(const TopicStudy& study, const std::string& start) {
  for (const auto& method : study.design.methods)
    if (method.id.starts_with(start + "-K")) return method.id;
  return "";
}

/// The mean error of each exact method, and that of its approximation with the fewest and the most
/// references.
std::vector<std::string> references_conclusions(const TopicStudy& study) {
  std::vector<std::string> sentences;
  const std::pair<const char*, const char*> pairs[] = {{"isomap", "landmark-isomap"},
                                                       {"sde", "landmark-mvu"}};
  for (const auto& [exact_name, approximate_name] : pairs) {
    const std::string exact = method_of(study, exact_name);
    const std::string approximate = method_of(study, approximate_name);
    if (approximate.empty()) continue;
    for (const TopicSetup& setup : study.design.setups) {
      const auto of = [&](double level, const std::string& method, const char* quantity) {
        return topic_mean(study, condition_at(setup, level), method, quantity);
      };
      std::vector<double> levels = levels_of(setup);
      std::erase_if(levels,
                    [&](double level) { return std::isnan(of(level, approximate, "mpe_m")); });
      if (levels.empty()) continue;
      const Method method = *method_named(approximate_name);
      std::string sentence = fmt::format(
          "{}, {}: with {:g} references the mean MPE is {}, with {:g} it is {}", setup.title,
          info(method).label, levels.front(), error_text(of(levels.front(), approximate, "mpe_m")),
          levels.back(), error_text(of(levels.back(), approximate, "mpe_m")));
      if (!exact.empty())
        sentence += fmt::format(
            "; that of {0} is {1}. The maps with {2:g} references differ from those of {0} by "
            "{3:.2g} % of their size",
            info(*info(method).approximates).label, error_text(of(levels.back(), exact, "mpe_m")),
            levels.back(), of(levels.back(), approximate, "gap_percent"));
      sentences.push_back(sentence + ".");
    }
  }
  return sentences;
}

/// Of Landmark ISOMAP in the first setup, with the most references; of landmark MVU without it.
TopicHeadline references_headline(const TopicStudy& study) {
  const TopicSetup& setup = study.design.setups.front();
  const Condition at = conditions_of(setup).back();
  for (const char* name : {"landmark-isomap", "landmark-mvu"}) {
    const std::string approximate = method_of(study, name);
    const Method exact_method = *info(*method_named(name)).approximates;
    const std::string exact = method_of(study, std::string(info(exact_method).name));
    if (approximate.empty() || exact.empty()) continue;
    const double error_m = topic_mean(study, at, approximate, "mpe_m");
    const double exact_m = topic_mean(study, at, exact, "mpe_m");
    if (std::isnan(error_m + exact_m)) continue;
    const auto difference = topic_difference(study, at, approximate, exact, "mpe_m");
    TopicHeadline headline{
        .value = error_text(error_m),
        .label =
            fmt::format("MPE by {}, {}", info(*method_named(name)).label, level_words(setup, at)),
        .detail = fmt::format("{} by {}; the maps differ by {:.2g} % of their size",
                              error_text(exact_m), info(exact_method).label,
                              topic_mean(study, at, approximate, "gap_percent")),
        .quantity = "mpe_m"};
    if (difference)
      judge(headline, *difference,
            verdict_words(*difference) + ", compared with all landmarks as references");
    return headline;
  }
  return {};
}

}  // namespace

const TopicWords kReferencesWords = {
    .topic = "references",
    .question = references_question,
    .compared_with = "the exact method, with all landmarks as references",
    .conclusions = references_conclusions,
    .headline = references_headline};

}  // namespace mapproof
