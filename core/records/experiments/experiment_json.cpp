#include "core/records/experiments/experiment_json.hpp"

#include "core/json/record_json.hpp"
#include "core/records/experiments/experiment_fields.hpp"
#include "core/records/experiments/profiles.hpp"

namespace mapproof {

std::string experiment_json(const Experiment& experiment) { return to_json_text(experiment); }

Experiment parse_experiment(std::string_view text, const std::string& source,
                            const std::string& profile) {
  const JsonDocument document = parse_with_profile(text, source, "mapproof.experiment", profile);
  return from_json_value<Experiment>(document.cursor());
}

}  // namespace mapproof
