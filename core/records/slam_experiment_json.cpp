#include "core/records/slam_experiment_json.hpp"

#include "core/json/json_text.hpp"
#include "core/records/profiles.hpp"
#include "core/records/slam_values.hpp"

namespace mapproof {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::string_view kSlamExperimentSchema = "mapproof.slam_experiment";

Json noise_value(const RangeNoiseModel& noise) {
  return {{"id", noise.id},
          {"title", noise.title},
          {"noise_m", noise.noise_m},
          {"share", noise.share},
          {"correlation", noise.correlation},
          {"plain_svd", noise.plain_svd}};
}

Json convergence_value(const ConvergenceOptions& convergence) {
  Json noises = Json::array();
  for (const RangeNoiseModel& noise : convergence.noises) noises.push_back(noise_value(noise));
  return {{"pairs", convergence.pairs},
          {"most_condition", convergence.most_condition},
          {"steps", convergence.steps},
          {"noises", noises}};
}

Json data_value(const std::vector<SlamDataSet>& sets) {
  Json value = Json::array();
  for (const SlamDataSet& set : sets)
    value.push_back({{"id", set.id},
                     {"title", set.title},
                     {"figure", set.figure},
                     {"files", set.files},
                     {"source", set.source},
                     {"published", published_drive_value(set.published)}});
  return value;
}

Json histories_value(const RangeHistoryOptions& histories) {
  Json methods = Json::array();
  for (const Method method : histories.methods) methods.push_back(info(method).name);
  return {{"landmarks", histories.landmarks},
          {"steps", histories.steps},
          {"noise", noise_value(histories.noise)},
          {"neighbours", histories.neighbours},
          {"methods", methods}};
}

Json space_value(const SpaceFlightOptions& space) {
  return {{"landmarks", space.landmarks},
          {"known", space.known},
          {"steps", space.steps},
          {"half_width_m", space.half_width_m},
          {"height_m", space.height_m},
          {"step_m", space.step_m},
          {"turn_sigma_rad", space.turn_sigma_rad},
          {"noise", noise_value(space.noise)}};
}

}  // namespace

Json slam_experiment_value(const SlamExperiment& experiment) {
  const SlamWorldOptions& world = experiment.world;
  Json methods = Json::array();
  for (const SlamMethod method : experiment.methods) methods.push_back(info(method).name);
  Json value = {{"schema", schema_value(kSlamExperimentSchema)},
                {"name", experiment.name},
                {"title", experiment.title},
                {"seed", experiment.seed},
                {"world",
                 {{"landmarks", world.landmarks},
                  {"known", world.known},
                  {"half_width_m", world.half_width_m},
                  {"step_m", world.step_m},
                  {"turn_sigma_rad", world.turn_sigma_rad}}}};
  if (const auto& example = experiment.example)
    value["example"] = {{"figure", example->figure},
                        {"steps", example->steps},
                        {"noise", noise_value(example->noise)}};
  if (experiment.convergence) value["convergence"] = convergence_value(*experiment.convergence);
  value["data"] = data_value(experiment.data);
  value["methods"] = std::move(methods);
  value["random_starts"] = experiment.random_starts;
  if (experiment.histories) value["histories"] = histories_value(*experiment.histories);
  if (experiment.space) value["space"] = space_value(*experiment.space);
  if (!experiment.factorization.steps.empty())
    value["factorization"] = {{"landmarks", experiment.factorization.landmarks},
                              {"steps", experiment.factorization.steps}};
  return value;
}

std::string slam_experiment_json(const SlamExperiment& experiment) {
  return json_text(slam_experiment_value(experiment));
}

SlamExperiment parse_slam_experiment(std::string_view text, const std::string& source,
                                     const std::string& profile) {
  const JsonDocument document = parse_with_profile(text, source, kSlamExperimentSchema, profile);
  return read_slam_experiment(document.cursor());
}

std::vector<std::string> slam_profiles(std::string_view text, const std::string& source) {
  return profile_names(text, source, kSlamExperimentSchema);
}

bool is_slam_experiment(std::string_view text, const std::string& source) {
  const JsonDocument document = parse_json(text, source);
  return schema_of(document.cursor()).name == kSlamExperimentSchema;
}

}  // namespace mapproof
