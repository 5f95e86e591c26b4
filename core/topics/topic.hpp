#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/model/topic_study.hpp"
#include "core/model/world.hpp"

namespace mapproof {

/// A data set and where it lies.
struct DataSetFolder {
  DataSet set;
  std::filesystem::path folder;
};

/// What a topic is given for one part of its study.
struct TopicTask {
  const TopicExperiment& experiment;
  std::string part;                   ///< Id of the part to make.
  RunId run;                          ///< Of a simulated run.
  const World* world = nullptr;       ///< Null: a topic of data.
  const Path* path = nullptr;         ///< As many positions as the experiment has steps.
  std::vector<Eigen::Index> anchors;  ///< Of the simulated world.
  std::uint64_t seed = 0;             ///< For all that the part draws; derive_seed() from it.
  std::filesystem::path data;         ///< Folder of the data set; empty: simulated.
  bool with_maps = false;             ///< Maps to be shown are requested.
};

/// A question that studies of a topic can ask: what it compares and how one part is made. Its texts
/// are in reports/sections/topics.
/// What its functions return depends on their arguments alone, seconds apart.
struct Topic {
  std::string_view name;  ///< In files: "missing".
  bool of_data = false;   ///< Parts are data sets (data_sets), not simulated runs.
  bool sweeps = false;    ///< Experiments name sensors with methods, and sweeps.
  std::vector<TopicOption> options;
  TopicDesign (*design)(const TopicExperiment& experiment) = nullptr;
  TopicPart (*make)(const TopicTask& context) = nullptr;
  /// Of a topic of data: the sets in a folder, by id; the folder may be one itself.
  /// @throws IoError if there is none.
  std::vector<DataSetFolder> (*data_sets)(const std::filesystem::path& folder) = nullptr;
};

}  // namespace mapproof
