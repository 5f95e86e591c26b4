#include <iterator>

#include <fmt/format.h>

#include "core/base/words.hpp"
#include "reports/sections/findings.hpp"
#include "reports/sections/study_report.hpp"
#include "reports/sections/study_tables.hpp"
#include "reports/sections/wording.hpp"

namespace mapproof {
namespace {

void add_half(const SensorStudy& sensor, const HalfChoices& choices, Section& section) {
  if (choices.halves == Halves::kNone) {
    section.blocks.emplace_back(
        plain("The parameter cannot be chosen on one half of the runs and judged on the other: "
              "there are no two halves."));
    return;
  }
  if (const std::string words = optimism_words(choices); !words.empty())
    section.blocks.emplace_back(plain(
        "Choosing the parameter by the very runs that are then reported, as the paper does, is "
        "optimistic: " +
        words));
  section.blocks.emplace_back(half_table(sensor, choices));
}

void add_ranks(const SensorStudy& sensor, const MethodRanks& ranks, Section& section) {
  if (ranks.test)
    section.blocks.emplace_back(rank_table(sensor, ranks));
  else
    section.blocks.emplace_back(
        plain(fmt::format("Methods cannot be ranked by a test: {} scored by {} in common; two of "
                          "each are needed.",
                          counted(std::ssize(ranks.layouts), "layout"),
                          counted(std::ssize(ranks.methods), "method"))));
}

}  // namespace

Section accuracy_section(const Study& study, const SensorStudy& sensor) {
  const std::vector<SettingSummary> all = summarize(study, sensor, last_step(sensor));
  const std::vector<SettingSummary> best = best_of_each_method(all);
  const bool grid = all.size() > best.size();
  Section section;
  section.id = fmt::format("methods-{}", name(sensor.sensor.sensor));
  section.title = title_of(sensor.sensor.sensor) + ": methods";
  section.blocks.emplace_back(plain(fmt::format(
      "Maps after {} observations, aligned to {} by the affine map of {}. Smaller is better.",
      last_step(sensor), counted(study.experiment.anchors, "anchor"),
      label(study.experiment.affine_fit))));
  section.blocks.emplace_back(accuracy_table(sensor, best, grid));
  if (!sensor.published.values.empty())
    section.blocks.emplace_back(paper_parameter_table(sensor, all));
  if (!sensor.published.orderings.empty())
    section.blocks.emplace_back(ordering_table(sensor, ordering_claims(study, sensor)));
  if (grid) add_half(sensor, half_choices(study, sensor), section);
  if (best.size() > 1) add_ranks(sensor, method_ranks(study, sensor), section);
  section.blocks.emplace_back(spread_table(sensor, best));
  if (grid) section.blocks.emplace_back(parameter_table(sensor, all));
  return section;
}

}  // namespace mapproof
