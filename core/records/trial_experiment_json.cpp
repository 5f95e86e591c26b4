#include "core/records/trial_experiment_json.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "core/json/text_input.hpp"
#include "core/records/experiment_values.hpp"
#include "core/records/json_values.hpp"
#include "core/records/profiles.hpp"
#include "core/records/trial_sweeps.hpp"

namespace mapproof {
namespace {

constexpr std::string_view kTrialExperimentSchema = "mapproof.trial_experiment";
constexpr double kLargestOption = std::numeric_limits<double>::max();
constexpr std::size_t kMostLevels = 1000;

/// One number, or an array of ascending ones.
std::vector<double> read_option(const JsonCursor& value, const TrialOption& option) {
  const auto read_one = [&](const JsonCursor& item) {
    const double number = item.number(option.minimum, option.maximum);
    if (option.integer && number != std::floor(number)) item.fail("expected an integer");
    return number;
  };
  return option.list ? read_ascending<double>(value, read_one) : std::vector{read_one(value)};
}

std::map<std::string, std::vector<double>> read_options(const std::optional<JsonCursor>& object,
                                                        const std::vector<TrialOption>& known) {
  std::map<std::string, std::vector<double>> options;
  std::vector<std::string_view> keys;
  for (const TrialOption& option : known) {
    keys.push_back(option.name);
    const auto given = object ? object->find(std::string(option.name)) : std::nullopt;
    options[std::string(option.name)] = given ? read_option(*given, option) : option.usual;
  }
  if (object) object->allow_only(keys);
  return options;
}

/// What a study.json holds, whatever the topic: every option as an array.
std::map<std::string, std::vector<double>> read_any_options(const JsonCursor& object) {
  std::map<std::string, std::vector<double>> options;
  for (const auto& [key, value] : object.members())
    for (const JsonCursor& item : value.elements(1, kMostLevels))
      options[key].push_back(item.number(-kLargestOption, kLargestOption));
  return options;
}

std::vector<TrialDataSet> read_data(const JsonCursor& array) {
  std::vector<TrialDataSet> sets;
  for (const JsonCursor& item : array.elements(0, 1000)) {
    item.allow_only({"id", "title", "digest"});
    sets.push_back({.id = item.at("id").text(200),
                    .title = item.at("title").text(1000),
                    .digest = item.at("digest").text(64)});
    if (!is_plain_id(sets.back().id)) item.at("id").fail("expected letters a to z, digits and '-'");
  }
  return sets;
}

/// All but the options and the data.
TrialExperiment read_experiment_frame(const JsonCursor& document) {
  TrialExperiment experiment;
  experiment.name = read_study_name(document.at("name"));
  experiment.title = experiment.name;
  if (const auto title = document.find("title")) experiment.title = title->text(200);
  experiment.topic = document.at("topic").text(100);
  if (const auto seed = document.find("seed")) experiment.seed = seed->unsigned_integer();
  read_if_there(document, "layouts", 1, kMostLayouts, experiment.layouts);
  read_if_there(document, "poses", 1, kMostPoses, experiment.poses);
  read_if_there(document, "steps", 3, kMostSteps, experiment.steps);
  if (const auto world = document.find("world")) experiment.world = read_world_options(*world);
  if (const auto walk = document.find("walk")) experiment.walk = read_walk_options(*walk);
  read_if_there(document, "anchors", 3, 1000, experiment.anchors);
  if (experiment.anchors > experiment.world.landmarks)
    document.find("anchors").value_or(document).fail(
        fmt::format("{} anchors of {} landmarks", experiment.anchors, experiment.world.landmarks));
  const double entries = static_cast<double>(experiment.world.landmarks) * experiment.steps;
  if (entries > kMostEntries)
    document.find("steps").value_or(document).fail(
        fmt::format("{} landmarks at {} steps are more than {:g} entries",
                    experiment.world.landmarks, experiment.steps, kMostEntries));
  return experiment;
}

}  // namespace

TrialExperiment parse_trial_experiment(std::string_view text, const std::string& source,
                                       const InputOfTopic& input_of, const std::string& profile) {
  const JsonDocument document = parse_with_profile(text, source, kTrialExperimentSchema, profile);
  const JsonCursor root = document.cursor();
  TrialExperiment experiment = read_experiment_frame(root);
  const TopicInput input = input_of(experiment.topic);
  if (input.options == nullptr) root.at("topic").fail("no topic " + in_quotes(experiment.topic));
  std::vector<std::string_view> keys = {"schema", "name",  "title", "topic", "seed",    "layouts",
                                        "poses",  "steps", "world", "walk",  "anchors", "options"};
  if (input.sweeps) keys.insert(keys.end(), {"sensors", "sweeps"});
  root.allow_only(keys);
  experiment.options = read_options(root.find("options"), *input.options);
  if (input.sweeps) read_sweeps(root, experiment);
  return experiment;
}

nlohmann::ordered_json trial_experiment_value(const TrialExperiment& experiment) {
  nlohmann::ordered_json value = {{"schema", schema_value(kTrialExperimentSchema)},
                                  {"name", experiment.name},
                                  {"title", experiment.title},
                                  {"topic", experiment.topic},
                                  {"seed", experiment.seed},
                                  {"layouts", experiment.layouts},
                                  {"poses", experiment.poses},
                                  {"steps", experiment.steps},
                                  {"world", world_value(experiment.world)},
                                  {"walk", walk_value(experiment.walk)},
                                  {"anchors", experiment.anchors},
                                  {"options", nlohmann::ordered_json::object()}};
  put_sweeps(value, experiment);
  value["data"] = nlohmann::ordered_json::array();
  for (const auto& [name, numbers] : experiment.options)
    for (const double number : numbers) value["options"][name].push_back(number_value(number));
  for (const TrialDataSet& set : experiment.data)
    value["data"].push_back({{"id", set.id}, {"title", set.title}, {"digest", set.digest}});
  return value;
}

TrialExperiment read_trial_experiment(const JsonCursor& document) {
  expect_schema(document, kTrialExperimentSchema);
  document.allow_only({"schema", "name", "title", "topic", "seed", "layouts", "poses", "steps",
                       "world", "walk", "anchors", "options", "sensors", "sweeps", "data"});
  TrialExperiment experiment = read_experiment_frame(document);
  experiment.options = read_any_options(document.at("options"));
  if (document.find("sweeps")) read_sweeps(document, experiment);
  experiment.data = read_data(document.at("data"));
  return experiment;
}

std::vector<std::string> trial_profiles(std::string_view text, const std::string& source) {
  return profile_names(text, source, kTrialExperimentSchema);
}

bool is_trial_experiment(std::string_view text, const std::string& source) {
  const JsonDocument document = parse_json(text, source);
  return schema_of(document.cursor()).name == kTrialExperimentSchema;
}

}  // namespace mapproof
