#include "core/records/experiments/slam_experiment_json.hpp"

#include <fmt/format.h>

#include "core/json/record_reader.hpp"
#include "core/json/record_writer.hpp"
#include "core/records/experiments/profiles.hpp"

namespace mapproof {
namespace {

std::string ranges_problem(double landmarks, double steps) {
  constexpr double kMost = 1e8;
  if (landmarks * steps <= kMost) return "";
  return fmt::format("{} landmarks at {} steps are more than {:g} ranges", landmarks, steps, kMost);
}

}  // namespace

std::optional<RecordFault> fault_of(const SlamExperiment& experiment) {
  const FactorizationGrid& grid = experiment.factorization;
  std::string problem;
  for (std::size_t i = 0; i < experiment.data.size(); ++i)
    if (experiment.example && experiment.data[i].id == experiment.example->noise.id)
      return {{fmt::format("data/{}/id", i), "is there twice"}};
  if (const auto& convergence = experiment.convergence)
    if (problem = ranges_problem(experiment.world.landmarks, convergence->steps.back());
        !problem.empty())
      return {{"convergence/steps", problem}};
  if (const auto& space = experiment.space)
    if (problem = ranges_problem(space->landmarks, space->steps); !problem.empty())
      return {{"space", problem}};
  if (!grid.landmarks.empty() && !grid.steps.empty())
    if (problem = ranges_problem(grid.landmarks.back(), grid.steps.back()); !problem.empty())
      return {{"factorization", problem}};
  return std::nullopt;
}

std::string slam_experiment_json(const SlamExperiment& experiment) {
  return to_json_text(experiment);
}

SlamExperiment parse_slam_experiment(std::string_view text, const std::string& source,
                                     const std::string& profile) {
  const JsonDocument document =
      parse_with_profile(text, source, "mapproof.slam_experiment", profile);
  return from_json_value<SlamExperiment>(document.cursor());
}

std::string slam_study_json(const SlamExperiment& experiment, const Provenance& provenance) {
  return to_json_text(SlamStudyStart{.experiment = experiment, .provenance = provenance});
}

SlamStudyStart parse_slam_study(std::string_view text, const std::string& source) {
  return from_json_text<SlamStudyStart>(text, source);
}

}  // namespace mapproof
