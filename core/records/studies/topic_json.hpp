#pragma once

#include <algorithm>
#include <functional>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "core/model/topic_study.hpp"
#include "core/records/experiments/experiment_json.hpp"
#include "core/records/maps/map_fields.hpp"
#include "core/records/studies/quantity_fields.hpp"
#include "core/records/text_forms.hpp"

namespace mapproof {

// The fields of experiments and studies of one topic (core/json/fields.hpp).

namespace record_rules {

inline constexpr std::size_t kMostOfATopic =
    10'000;  ///< Setups, methods, quantities, levels, maps.
inline constexpr std::size_t kMostSweeps = 100;
inline constexpr std::size_t kMostSweptFactors = 2;
inline constexpr std::size_t kMostFactors = 10;  ///< Of a setup.

}  // namespace record_rules

template <typename Visitor>
void fields(Visitor& v, DataSet& set) {
  v.field("id", set.id, {.max_bytes = 200, .form = &kPlainText});
  v.field("title", set.title, {.max_bytes = 1000});
  v.field("digest", set.digest, {.description = "SHA-256 of its files.", .max_bytes = 64});
}

/// A sweep as files have it: the levels by the names of their factors.
struct SweepRecord {
  Sweep sweep;
};

template <typename Visitor>
void fields(Visitor& v, SweepRecord& record) {
  v.key_count(1, record_rules::kMostSweptFactors);
  std::vector<SweptFactor> factors(swept_factors().begin(), swept_factors().end());
  std::ranges::sort(factors, {}, &SweptFactor::name);
  for (const SweptFactor& factor : factors) {
    const auto known = std::ranges::find(record.sweep, factor.name, &SweptLevels::factor);
    std::vector<double> levels;
    if (known != record.sweep.end()) levels = known->levels;
    FieldRule rule = record_rules::kLevels;
    rule.minimum = factor.minimum();
    rule.maximum = factor.maximum;
    rule.integer = info(factor.factor).integer;
    rule.key = Key::kIfAny;
    v.field(factor.name, levels, rule);
    if constexpr (Visitor::kReads)
      if (!levels.empty()) record.sweep.push_back({std::string(factor.name), std::move(levels)});
  }
}

template <typename Visitor>
void topic_head_fields(Visitor& v, TopicExperiment& experiment) {
  v.file("mapproof.topic_experiment", "A question put to simulated worlds, or to data sets.");
  name_fields(v, experiment);
  v.field(
      "topic", experiment.topic,
      {.description = "The question of the study; it determines the options.", .max_bytes = 100});
  run_fields(v, experiment);
  v.field("steps", experiment.steps,
          record_rules::described("Observations of each run.",
                                  record_rules::of_factor(Factor::kSteps)));
  v.field("world", experiment.world,
          {.description = "The room and its landmarks.", .key = Key::kOptional});
  v.field("walk", experiment.walk, {.description = "How the robot moves.", .key = Key::kOptional});
  v.field("anchors", experiment.anchors,
          record_rules::described(
              "Number of anchors: landmarks with known positions, which the map is aligned to.",
              record_rules::of_factor(Factor::kAnchors)));
}

/// @param rule  Of both keys.
template <typename Visitor>
void sweep_fields(Visitor& v, TopicExperiment& experiment, FieldRule rule) {
  rule.written = !experiment.sweeps.empty();
  rule.description = "Of the topic sweep: as in mapproof.experiment, without checkpoints.";
  const auto visit = [&](auto& sensors) {
    sensors_fields(sensors, experiment.sensors, experiment.steps);
  };
  v.group("sensors", visit, rule);
  rule.description =
      "Of the topic sweep: ascending levels of one factor or two; every combination is tried.";
  rule.min_items = 1;
  rule.max_items = record_rules::kMostSweeps;
  std::vector<SweepRecord> sweeps;
  for (const Sweep& sweep : experiment.sweeps) sweeps.push_back({sweep});
  v.field("sweeps", sweeps, rule);
  if constexpr (Visitor::kReads)
    for (SweepRecord& record : sweeps) experiment.sweeps.push_back(std::move(record.sweep));
}

template <typename Visitor>
void check_topic_study(Visitor& v, const TopicExperiment& experiment) {
  if constexpr (Visitor::kReads)
    if (const auto fault = fault_of(experiment)) v.refuse(fault->pointer, fault->what);
}

/// In a study.json: every option as an array, whatever the topic, and the data sets.
template <typename Visitor>
void fields(Visitor& v, TopicExperiment& experiment) {
  topic_head_fields(v, experiment);
  v.field("options", experiment.options,
          {.whole_as_integers = true, .min_items = 1, .max_items = 1000});
  sweep_fields(v, experiment, {.key = Key::kOptional});
  v.field("data", experiment.data,
          {.description = "The sets that the study is made of.", .max_items = 1000});
  check_topic_study(v, experiment);
}

/// The options of a topic as its experiments may give them.
struct GivenOptions {
  std::span<const TopicOption> known;
  std::map<std::string, std::vector<double>> values;  ///< The usual ones before it is read.
};

template <typename Visitor>
void fields(Visitor& v, GivenOptions& options) {
  for (const TopicOption& option : options.known) {
    std::vector<double>& numbers = options.values.at(std::string(option.name));
    FieldRule rule = {.minimum = option.minimum,
                      .maximum = option.maximum,
                      .integer = option.integer,
                      .key = Key::kOptional};
    if (option.list) {
      rule.ascending = true;
      rule.min_items = 1;
      rule.max_items = 1000;
      v.field(option.name, numbers, rule);
    } else {
      v.field(option.name, numbers.at(0), rule);
    }
  }
}

/// The file of an experiment.
struct TopicExperimentFile {
  TopicExperiment experiment;
  const std::vector<TopicOption>* options = nullptr;  ///< Of its topic; null: of any.
  bool sweeps = false;                                ///< Whether its topic sweeps.
};

template <typename Visitor>
void fields(Visitor& v, TopicExperimentFile& file) {
  topic_head_fields(v, file.experiment);
  if (file.options == nullptr) {
    v.field("options", file.experiment.options,
            {.description = "Numbers, or ascending lists of them.",
             .or_one = true,
             .min_items = 1,
             .max_items = 1000,
             .key = Key::kOptional});
  } else {
    GivenOptions given{.known = *file.options, .values = {}};
    for (const TopicOption& option : given.known)
      given.values[std::string(option.name)] = option.usual;
    v.field("options", given, {.key = Key::kOptional});
    if constexpr (Visitor::kReads) file.experiment.options = std::move(given.values);
  }
  sweep_fields(v, file.experiment, {.when = file.sweeps});
  check_topic_study(v, file.experiment);
}

template <typename Visitor>
void fields(Visitor& v, SetupFactor& factor) {
  v.field("id", factor.id,
          {.description = "A column of results.csv.", .not_empty = true, .max_bytes = 100});
  v.field("label", factor.label, {.max_bytes = 200});
  v.field("unit", factor.unit, {.description = "Empty: none.", .max_bytes = 100});
  v.field("levels", factor.levels,
          {.whole_as_integers = true, .min_items = 1, .max_items = record_rules::kMostOfATopic});
}

template <typename Visitor>
void fields(Visitor& v, TopicSetup& setup) {
  v.field("id", setup.id, record_rules::kId);
  v.field("title", setup.title, {.max_bytes = 1000});
  v.field("factors", setup.factors,
          {.description = "What its conditions differ in: every combination of the levels. Empty: "
                          "there is one condition.",
           .max_items = record_rules::kMostFactors});
  check_ids(v, "factors", setup.factors);
}

template <typename Visitor>
void fields(Visitor& v, StudiedMethod& method) {
  v.field("id", method.id, record_rules::kMethod);
  v.field("label", method.label, {.max_bytes = 200});
}

template <typename Visitor>
void fields(Visitor& v, TopicDesign& design) {
  constexpr FieldRule kSome = {.min_items = 1, .max_items = record_rules::kMostOfATopic};
  v.field("setups", design.setups, kSome);
  v.field("methods", design.methods, kSome);
  v.field("quantities", design.quantities, kSome);
  check_ids(v, "setups", design.setups);
  check_ids(v, "methods", design.methods);
  check_ids(v, "quantities", design.quantities);
}

/// The head of a study: study.json.
template <typename Visitor>
void fields(Visitor& v, TopicStudy& study) {
  v.file("mapproof.topic_study",
         "study.json of a study of one topic: what was asked for, what it compares, and what made "
         "it.");
  v.field("experiment", study.experiment);
  v.field("design", study.design);
  v.field("provenance", study.provenance);
}

/// What was tried under which condition.
template <typename Visitor>
void tried_fields(Visitor& v, Condition& at, std::string& method) {
  std::string setup = at.setup;
  v.field("setup", setup);
  v.field("method", method);
  std::map<std::string, double> levels;
  for (const Level& level : at.levels) levels[level.factor] = std::get<double>(level.value);
  v.field("levels", levels,
          {.description = "By factor.",
           .whole_as_integers = true,
           .max_keys = record_rules::kMostFactors});
  if constexpr (Visitor::kReads) {
    std::vector<Level> all;
    for (const auto& [factor, level] : levels) all.push_back({factor, level});
    at = condition(setup, std::move(all));
  }
}

template <typename Visitor>
void fields(Visitor& v, TopicOutcome& outcome) {
  using namespace record_rules;
  tried_fields(v, outcome.at, outcome.method);
  v.field("values", outcome.values,
          {.description = "By quantity of the design. One that does not apply is not there; null: "
                          "nothing came out.",
           .nullable = true,
           .whole_as_integers = true});
  FieldRule statuses = kStatuses;
  statuses.key = Key::kIfAny;
  v.field("statuses", outcome.statuses, statuses);
}

template <typename Visitor>
void fields(Visitor& v, MeasuredPair& pair) {
  v.field("first", pair.first, {.minimum = 0, .maximum = kMostLandmarks - 1});
  v.field("second", pair.second, {.minimum = 0, .maximum = kMostLandmarks - 1});
  if (pair.first >= pair.second) v.refuse("second", "expected a row after the first");
  v.field("distance_m", pair.distance_m, {.minimum = 0.0, .maximum = kFarthest_m});
  v.field("precision", pair.precision, {.description = "1 / variance, 1/m^2.", .minimum = 0.0});
  v.field("scans", pair.scans, record_rules::kCount);
}

template <typename Visitor>
void fields(Visitor& v, TopicMap& map) {
  using namespace record_rules;
  v.field("id", map.id, kMethod);
  tried_fields(v, map.at, map.method);
  v.field("map", map.map);
  v.field("pairs", map.pairs);
  v.field("uncertainty", map.uncertainty,
          {.description = "The ellipses of its landmarks; null: none."});
  const std::size_t landmarks = map.map.names.size();
  for (std::size_t i = 0; i < map.pairs.size(); ++i)
    check_at_most(v, fmt::format("pairs/{}/second", i), map.pairs[i].second, Eigen::Index{0},
                  std::ssize(map.map.names) - 1);
  if (map.pairs.size() > landmarks * landmarks)
    v.refuse("pairs", fmt::format("expected at most {} elements, got {}", landmarks * landmarks,
                                  map.pairs.size()));
  if (map.uncertainty && map.uncertainty->covariances.size() != landmarks)
    v.refuse("uncertainty/covariances", "expected one per landmark");
}

/// parts/ID.json.
struct TopicPartFile {
  TopicPart part;
  std::string digest;                   ///< Of the data set; empty: simulated.
  const TopicDesign* design = nullptr;  ///< That outcomes belong to; null: not known.
};

/// What is wrong with a outcome, or a map, as one of the design.
std::optional<RecordFault> fault_of(const TopicOutcome& outcome, const TopicDesign& design);
std::optional<RecordFault> fault_of(const TopicMap& map, const TopicDesign& design);

template <typename Visitor, typename Item>
void check_all(Visitor& v, std::string_view key, const std::vector<Item>& items,
               const TopicDesign& design) {
  for (std::size_t i = 0; i < items.size(); ++i)
    if (const auto fault = fault_of(items[i], design))
      v.refuse(fmt::format("{}/{}/{}", key, i, fault->pointer), fault->what);
}

template <typename Visitor>
void fields(Visitor& v, TopicPartFile& file) {
  v.file("mapproof.topic_part",
         "parts/ID.json of a study of one topic: one simulated run, or one data set.");
  TopicPart& part = file.part;
  v.field("id", part.id, {.max_bytes = 200, .form = &kPlainText});
  v.field("run", part.run);
  v.field("digest", file.digest,
          {.description = "Of the data set; empty: simulated.", .max_bytes = 64});
  v.field("outcomes", part.outcomes, {.max_items = record_rules::kMostRecords});
  v.field("maps", part.maps, {.max_items = record_rules::kMostOfATopic});
  check_ids(v, "maps", part.maps);
  if constexpr (Visitor::kReads)
    if (file.design != nullptr) {
      check_all(v, "outcomes", part.outcomes, *file.design);
      check_all(v, "maps", part.maps, *file.design);
    }
}

/// What an experiment file may give to a topic.
struct TopicInput {
  const std::vector<TopicOption>* options = nullptr;  ///< Null: there is no such topic.
  bool sweeps = false;                                ///< Sensors with methods, and sweeps.
};

/// Of a topic by its name.
using InputOfTopic = std::function<TopicInput(std::string_view topic)>;

/// An experiment of a topic from the text of its file, mapproof.topic_experiment
/// (docs/file-formats.md), every bound checked, options that it leaves out at their usual values.
/// @param source, profile  As parse_experiment().
/// @throws IoError with the location if the text is no such experiment or lacks that profile.
TopicExperiment parse_topic_experiment(std::string_view text, const std::string& source,
                                       const InputOfTopic& input_of,
                                       const std::string& profile = "");

/// The files of the study of a topic (docs/file-formats.md). All parsers throw IoError with the
/// location.

/// study.json (mapproof.topic_study): experiment, design and provenance; parts are not
/// in it.
std::string topic_study_json(const TopicStudy& study);
TopicStudy parse_topic_study(std::string_view text, const std::string& source);

/// parts/ID.json (mapproof.topic_part), without its seconds.
/// @param digest  Of the data set that it was made of; empty: simulated.
std::string topic_part_json(const TopicPart& part, const std::string& digest);

/// A part, and the digest of its data.
struct ReadTopicPart {
  TopicPart part;
  std::string digest;
};

/// @param design  Every outcome's setup, method, level and number of values is checked against it;
///                null: a file alone, that nothing is known about.
ReadTopicPart parse_topic_part(std::string_view text, const std::string& source,
                               const TopicDesign* design);

}  // namespace mapproof
