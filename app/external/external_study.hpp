#pragma once

#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "app/command_line.hpp"
#include "core/experiment/run.hpp"
#include "core/model/map_record.hpp"
#include "core/model/study.hpp"
#include "core/results/results_study.hpp"
#include "reports/html/templates.hpp"

namespace mapproof {

/// A study of the mapping methods, with its records. @throws IoError if the folder holds another
/// kind of study.
Study read_mapping_study(const std::filesystem::path& folder);

/// What is exported of a checkpoint.
inline constexpr std::array kExternalInputs = {ExternalInput::kDistances, ExternalInput::kFeatures,
                                               ExternalInput::kHistory};

/// Where its files are below a folder of exported files: RUN/SENSOR/STEPS.
std::filesystem::path folder_of(const ObservedCheckpoint& checkpoint);

/// One map of somebody else, aligned and scored as the study's own are.
struct ExternalMap {
  std::string method;
  RunId run;
  Sensor sensor = Sensor::kVisibility;
  int steps = 0;
  std::optional<MapRecord> map = {};  ///< Empty if there is none.
  std::string failure = {};           ///< Why, one line.
};

/// Aligns coordinates to the anchors and scores them against the ground truth.
/// @param coordinates  M x 2, any frame; NaN rows: no position.
ExternalMap scored_external_map(const Experiment& experiment, const ObservedCheckpoint& checkpoint,
                                const std::string& method, const Points& coordinates);

/// The methods of others, in their order.
using MethodLabels = std::vector<Label>;

/// Where the comparison of a study's methods with others goes.
struct ExternalOutputs {
  std::string out;
  std::string name;  ///< Of the new study; empty: that of the study and "-external".
  bool all = false;  ///< Every parameter of the study's own methods, not the best of each.
  std::optional<std::string> templates;
  int jobs = 1;
};

/// @throws IoError unless the folder is new, empty, or holds a study of results.
void check_external_folder(const std::filesystem::path& folder);

/// Writes a study of results with the rows of the study's own methods and those of others, its
/// report, and the result of the command.
/// @return The exit code: kNo if every map of others is lost.
int write_external_study(const Study& study, const std::vector<ExternalMap>& maps,
                         const MethodLabels& methods, const ExternalOutputs& outputs,
                         const Invocation& invocation);

/// Adds --out, --name, --all, --templates and --jobs.
void add_external_outputs(CLI::App& app, ExternalOutputs& outputs);

}  // namespace mapproof
