#include <string>
#include <vector>

#include <fmt/format.h>

#include "reports/model/format.hpp"
#include "reports/sections/topics/topic_means.hpp"
#include "reports/sections/topics/topic_text.hpp"

namespace mapproof {
namespace {

std::string references_question(const TopicExperiment& experiment) {
  return fmt::format(
      "{} landmarks are mapped by ISOMAP, which searches the shortest paths from every landmark, "
      "and by Landmark ISOMAP, which searches them from a few reference landmarks alone. How many "
      "references does a map need?",
      experiment.world.landmarks);
}

/// The mean error of ISOMAP, and that with the fewest and the most references.
std::vector<std::string> references_conclusions(const TopicStudy& study) {
  std::vector<std::string> sentences;
  const std::string& exact = study.design.methods.at(0).id;
  const std::string& approximate = study.design.methods.at(1).id;
  for (const TopicSetup& setup : study.design.setups) {
    const std::vector<double> levels = levels_of(setup);
    const auto of = [&](double level, const std::string& method, const char* quantity) {
      return topic_mean(study, condition_at(setup, level), method, quantity);
    };
    sentences.push_back(fmt::format(
        "{}: with {:g} references the mean MPE is {}, with {:g} it is {}; that of ISOMAP is {}. "
        "The "
        "maps with {:g} references differ from those of ISOMAP by {:.2g} % of their size.",
        setup.title, levels.front(), page_metres(of(levels.front(), approximate, "mpe_m")),
        levels.back(), page_metres(of(levels.back(), approximate, "mpe_m")),
        page_metres(of(levels.back(), exact, "mpe_m")), levels.back(),
        of(levels.back(), approximate, "gap_percent")));
  }
  return sentences;
}

}  // namespace

const TopicWords kReferencesWords = {
    .topic = "references", .question = references_question, .conclusions = references_conclusions};

}  // namespace mapproof
