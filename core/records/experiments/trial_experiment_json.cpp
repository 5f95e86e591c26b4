#include "core/records/experiments/trial_experiment_json.hpp"

#include "core/json/record_json.hpp"
#include "core/json/text_input.hpp"
#include "core/records/experiments/profiles.hpp"
#include "core/records/studies/trial_fields.hpp"

namespace mapproof {

TrialExperiment parse_trial_experiment(std::string_view text, const std::string& source,
                                       const InputOfTopic& input_of, const std::string& profile) {
  const JsonDocument document =
      parse_with_profile(text, source, "mapproof.trial_experiment", profile);
  const JsonCursor root = document.cursor();
  const std::string topic = root.at("topic").text(100);
  const TopicInput input = input_of(topic);
  if (input.options == nullptr) root.at("topic").fail("no topic " + in_quotes(topic));
  TrialExperimentFile file{.experiment = {}, .options = input.options, .sweeps = input.sweeps};
  record_json::read_record(root, file);
  return std::move(file.experiment);
}

}  // namespace mapproof
