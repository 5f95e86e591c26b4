#include "core/records/studies/topic_json.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "core/json/json_document.hpp"
#include "core/json/record_reader.hpp"
#include "core/json/record_writer.hpp"
#include "core/json/text_input.hpp"
#include "core/records/experiments/profiles.hpp"

namespace mapproof {
namespace {

std::optional<RecordFault> fault_of(const Condition& at, const std::string& method,
                                    const TopicDesign& design) {
  const auto setup = std::ranges::find(design.setups, at.setup.get(), &TopicSetup::id);
  if (setup == design.setups.end()) return {{"setup", "the study has no such setup"}};
  for (const SetupFactor& factor : setup->factors) {
    const auto found = std::ranges::find(at.levels, factor.id, &Level::factor);
    if (found == at.levels.end()) return {{"levels", "lacks the factor " + in_quotes(factor.id)}};
    if (std::ranges::find(factor.levels, std::get<double>(found->value)) == factor.levels.end())
      return {{"levels/" + factor.id, "the setup has no such level"}};
  }
  if (at.levels.size() > setup->factors.size())
    return {{"levels", "has a factor that the setup does not have"}};
  if (std::ranges::find(design.methods, method, &StudiedMethod::id) == design.methods.end())
    return {{"method", "the study has no such method"}};
  return std::nullopt;
}

}  // namespace

TopicExperiment parse_topic_experiment(std::string_view text, const std::string& source,
                                       const InputOfTopic& input_of, const std::string& profile) {
  const JsonDocument document =
      parse_with_profile(text, source, "mapproof.topic_experiment", profile);
  const JsonCursor root = document.cursor();
  const std::string topic = root.at("topic").text(100);
  const TopicInput input = input_of(topic);
  if (input.options == nullptr) root.at("topic").fail("no topic " + in_quotes(topic));
  TopicExperimentFile file{.experiment = {}, .options = input.options, .sweeps = input.sweeps};
  record_json::read_record(root, file);
  return std::move(file.experiment);
}

std::optional<RecordFault> fault_of(const TopicMap& map, const TopicDesign& design) {
  return fault_of(map.at, map.method, design);
}

std::optional<RecordFault> fault_of(const TopicOutcome& outcome, const TopicDesign& design) {
  if (auto fault = fault_of(outcome.at, outcome.method, design)) return fault;
  for (const auto& [quantity, value] : outcome.values)
    if (std::ranges::find(design.quantities, quantity, &Quantity::id) == design.quantities.end())
      return {{"values/" + quantity, "the study has no such quantity"}};
  return std::nullopt;
}

std::string topic_study_json(const TopicStudy& study) { return to_json_text(study); }

TopicStudy parse_topic_study(std::string_view text, const std::string& source) {
  return from_json_text<TopicStudy>(text, source);
}

std::string topic_part_json(const TopicPart& part, const std::string& digest) {
  return to_json_text(TopicPartFile{.part = part, .digest = digest});
}

ReadTopicPart parse_topic_part(std::string_view text, const std::string& source,
                               const TopicDesign* design) {
  TopicPartFile file{.part = {}, .digest = {}, .design = design};
  const JsonDocument document = parse_json(text, source);
  record_json::read_record(document.cursor(), file);
  return {.part = std::move(file.part), .digest = std::move(file.digest)};
}

}  // namespace mapproof
