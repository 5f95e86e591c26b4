#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/model/trial_study.hpp"
#include "core/model/world.hpp"

namespace mapproof {

/// An option of a topic, as an experiment file may give it.
struct TopicOption {
  std::string_view name;      ///< "shares_missing".
  std::vector<double> usual;  ///< One number, or ascending ones of a list.
  double minimum = 0.0;       ///< Inclusive.
  double maximum = 0.0;       ///< Inclusive.
  bool integer = false;
  bool list = false;
};

/// What a topic is given for one part of its study.
struct TrialContext {
  const TrialExperiment& experiment;
  std::string part;                   ///< Id of the part to make.
  RunId run;                          ///< Of a simulated run.
  const World* world = nullptr;       ///< Null: a topic of data.
  const Path* path = nullptr;         ///< As many positions as the experiment has steps.
  std::vector<Eigen::Index> anchors;  ///< Of the simulated world.
  std::uint64_t seed = 0;             ///< For all that the part draws; derive_seed() from it.
  std::filesystem::path data;         ///< Folder of the data set; empty: simulated.
  bool with_maps = false;             ///< Maps to be shown are asked for.
};

/// A question that studies of trials can put: what it compares and how one part is made.
/// All functions are pure: what they return depends on their arguments alone.
struct Topic {
  std::string_view name;  ///< In files: "missing".
  bool of_data = false;   ///< Parts are data sets, not simulated runs.
  std::vector<TopicOption> options;
  TrialDesign (*design)(const TrialExperiment& experiment) = nullptr;
  TrialPart (*make)(const TrialContext& context) = nullptr;
  std::vector<std::string> (*conclude)(const TrialStudy& study) = nullptr;
};

/// All topics, in the order of their studies. A new one is added to core/trials/topics.cpp.
std::span<const Topic* const> all_topics();

/// The topic of that name; null if there is none.
const Topic* topic_named(std::string_view name);

/// An experiment's option. @throws InvalidInput if the experiment does not have it.
double number_option(const TrialExperiment& experiment, const std::string& name);
const std::vector<double>& list_option(const TrialExperiment& experiment, const std::string& name);

}  // namespace mapproof
