#include <algorithm>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "reports/sections/topics/topic_means.hpp"
#include "reports/sections/topics/topic_text.hpp"

namespace mapproof {
namespace {

/// The methods of incremental maps, not those computed again.
std::vector<std::string> carried_on(const TopicDesign& design) {
  std::vector<std::string> ids;
  for (const StudiedMethod& method : design.methods)
    if (!method.id.ends_with("-whole")) ids.push_back(method.id);
  return ids;
}

std::string incremental_question(const TopicExperiment& experiment) {
  return fmt::format(
      "Observations arrive one by one, and every {:g} of them the map is made from sums over pairs "
      "that are updated incrementally. How far is it from the map computed again from all "
      "observations so far, and "
      "through how many of them does each go?",
      number_option(experiment, "every"));
}

std::vector<std::string> incremental_conclusions(const TopicStudy& study) {
  std::vector<std::string> sentences;
  const std::vector<std::string> methods = carried_on(study.design);
  if (methods.empty()) return sentences;
  for (const TopicSetup& setup : study.design.setups) {
    const double last = levels_of(setup).back();
    const Condition at = condition_at(setup, last);
    double greatest = 0.0, beyond = 0.0;
    for (const std::string& method : methods) {
      const auto most = [&](const char* quantity, double so_far) {
        for (const double value : topic_values(study, at, method, quantity))
          so_far = std::max(so_far, value);
        return so_far;
      };
      greatest = most("greatest_gap_ppm", greatest);
      beyond = most("beyond_percent", beyond);
    }
    sentences.push_back(fmt::format(
        "{}: up to {:g} observations no incremental map, whatever the method, was further than "
        "{:.2g} ppm of its size from the map computed again{}; it goes through {:g} observations "
        "for "
        "its last update instead of {:g}.",
        setup.title, last, greatest,
        beyond > 0.0
            ? fmt::format("; beyond the stated bound in {:.2g} % of the updates of one run", beyond)
            : "",
        topic_mean(study, at, methods[0], "steps_gone_through"), last));
  }
  return sentences;
}

}  // namespace

const TopicWords kIncrementalWords = {.topic = "incremental",
                                      .question = incremental_question,
                                      .conclusions = incremental_conclusions};

}  // namespace mapproof
