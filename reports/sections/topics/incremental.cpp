#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "core/base/text/number_text.hpp"
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

/// The greatest value of a quantity over the methods and all parts.
double greatest_of(const TopicStudy& study, const Condition& at,
                   const std::vector<std::string>& methods, const char* quantity) {
  double greatest = 0.0;
  for (const std::string& method : methods)
    for (const double value : topic_values(study, at, method, quantity))
      greatest = std::max(greatest, value);
  return greatest;
}

constexpr double kNothing_ppm = 1e-3;

std::string gap_words(double gap_ppm) {
  return gap_ppm < kNothing_ppm ? "0.001 ppm" : significant(gap_ppm, 2) + " ppm";
}

std::vector<std::string> incremental_conclusions(const TopicStudy& study) {
  std::vector<std::string> sentences;
  const std::vector<std::string> methods = carried_on(study.design);
  if (methods.empty()) return sentences;
  for (const TopicSetup& setup : study.design.setups) {
    const double last = levels_of(setup).back();
    const Condition at = condition_at(setup, last);
    const double greatest = greatest_of(study, at, methods, "greatest_gap_ppm");
    const double beyond = greatest_of(study, at, methods, "beyond_percent");
    sentences.push_back(fmt::format(
        "{}: up to {:g} observations no incremental map, whatever the method, was further than "
        "{} of its size from the map computed again{}; it goes through {:g} observations for its "
        "last update instead of {:g}.",
        setup.title, last, gap_words(greatest),
        beyond > 0.0
            ? fmt::format("; beyond the stated bound in {:.2g} % of the updates of one run", beyond)
            : "",
        topic_mean(study, at, methods[0], "steps_gone_through"), last));
  }
  return sentences;
}

TopicHeadline incremental_headline(const TopicStudy& study) {
  const std::vector<std::string> methods = carried_on(study.design);
  if (methods.empty()) return {};
  double greatest = 0.0;
  for (const TopicSetup& setup : study.design.setups)
    greatest = std::max(greatest, greatest_of(study, condition_at(setup, levels_of(setup).back()),
                                              methods, "greatest_gap_ppm"));
  const TopicSetup& first = study.design.setups.front();
  const double last = levels_of(first).back();
  const double through =
      topic_mean(study, condition_at(first, last), methods[0], "steps_gone_through");
  if (std::isnan(through)) return {};
  constexpr double kSame_ppm = 1.0;
  return {fmt::format("{:g} of {:g}", through, last),
          "observations used by an update of a map",
          gap_words(greatest) + " at most from the map computed again",
          greatest < kSame_ppm ? "the same map, for less work" : "not the same map",
          greatest >= kSame_ppm,
          "steps_gone_through"};
}

}  // namespace

const TopicWords kIncrementalWords = {
    .topic = "incremental",
    .question = incremental_question,
    .compared_with = "the map computed again from all observations",
    .conclusions = incremental_conclusions,
    .headline = incremental_headline};

}  // namespace mapproof
