#include "core/model/slam/slam_experiment.hpp"

#include <fmt/format.h>

namespace mapproof {

std::string missing_sentence(const SlamDataSet& data) {
  return data.title + " is missing. " + data.source;
}

std::vector<std::pair<std::string, std::string>> facts_of(const SlamExperiment& experiment) {
  const SlamWorldOptions& world = experiment.world;
  std::vector<std::pair<std::string, std::string>> facts = {
      {"Simulated area", fmt::format("{0:g} m \u00D7 {0:g} m", 2.0 * world.half_width_m)},
      {"Simulated landmarks", fmt::format("{}, {} of them known", world.landmarks, world.known)},
      {"Simulated walk",
       fmt::format("steps of {:g} m, the heading changes by {:g} rad (1 \u03C3) per step",
                   world.step_m, world.heading_change_sigma_rad)}};
  if (const auto& example = experiment.example)
    facts.emplace_back("Example",
                       fmt::format("{} steps, {}", example->steps, example->noise.title));
  if (const auto& convergence = experiment.convergence)
    facts.emplace_back(
        "Convergence",
        fmt::format("{} pairs of world and path, up to {} steps; worlds whose known landmarks lie "
                    "nearly on a line or circle (condition number above {:g}) are drawn again",
                    convergence->pairs, convergence->steps.back(), convergence->most_condition));
  if (const auto& histories = experiment.histories)
    facts.emplace_back(
        "Mapping methods on ranges",
        fmt::format("{} landmarks, {} steps, {}, K = {}", histories->landmarks, histories->steps,
                    histories->noise.title, histories->neighbours));
  if (const auto& space = experiment.space)
    facts.emplace_back(
        "Flight in space",
        fmt::format("{0:g} m \u00D7 {0:g} m \u00D7 {1:g} m, {2} landmarks, {3} of them known, {4} "
                    "steps of {5:g} m, {6}",
                    2.0 * space->half_width_m, space->height_m, space->landmarks, space->known,
                    space->steps, space->step_m, space->noise.title));
  return facts;
}

}  // namespace mapproof
