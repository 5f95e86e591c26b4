#include "app/commands.hpp"

#include <algorithm>
#include <map>
#include <memory>
#include <set>
#include <system_error>
#include <tuple>
#include <utility>

#include <fmt/format.h>

#include "app/external/external_study.hpp"
#include "core/base/errors.hpp"
#include "core/base/files/files.hpp"
#include "core/base/files/output_folder.hpp"
#include "core/base/not_finite.hpp"
#include "core/experiment/external_input.hpp"
#include "core/json/text_input.hpp"
#include "core/records/maps/map_csv.hpp"
#include "core/records/text_forms.hpp"

namespace mapproof {
namespace {

namespace fs = std::filesystem;

struct ImportArguments {
  std::string study;
  std::string maps;
  ExternalOutputs outputs;
};

bool is_exported(const fs::path& file) {
  return std::ranges::any_of(
      kExternalInputs, [&](ExternalInput input) { return file.stem().string() == name(input); });
}

/// METHOD.csv of one checkpoint.
std::vector<fs::path> maps_in(const fs::path& folder) {
  std::vector<fs::path> files;
  std::error_code error;
  for (fs::directory_iterator entry(folder, error), end; !error && entry != end;
       entry.increment(error))
    if (entry->path().extension() == ".csv" && !is_exported(entry->path()) &&
        !entry->path().filename().string().starts_with('.'))
      files.push_back(entry->path());
  std::ranges::sort(files);
  return files;
}

/// The positions of a file in the rows of the checkpoint; NaN where it has none.
Points positions_of(const fs::path& file, const ObservedCheckpoint& checkpoint) {
  const std::string text = read_file(file);
  const MapRecord map = parse_map_csv(checked_text(text, file.string()), file.string());
  std::map<std::string, Eigen::Index> rows;
  for (std::size_t i = 0; i < checkpoint.history.names.size(); ++i)
    rows[checkpoint.history.names[i]] = static_cast<Eigen::Index>(i);
  Points positions = Points::Constant(std::ssize(rows), 2, kNaN);
  for (std::size_t i = 0; i < map.names.size(); ++i) {
    const auto row = rows.find(map.names[i]);
    if (row == rows.end())
      throw IoError(
          file.string(),
          fmt::format("{} is not a landmark of {}", in_quotes(map.names[i]),
                      checkpoint_id(checkpoint.run, checkpoint.sensor, checkpoint.steps)));
    positions.row(row->second) = map.estimate.row(static_cast<Eigen::Index>(i));
  }
  return positions;
}

std::vector<ExternalMap> maps_of_run(const Experiment& experiment, const RunId& run,
                                     const fs::path& folder, std::set<std::string>& methods) {
  std::vector<ExternalMap> maps;
  observe_run(experiment, run, [&](const ObservedCheckpoint& checkpoint) {
    for (const fs::path& file : maps_in(folder / folder_of(checkpoint))) {
      const std::string method = file.stem().string();
      if (!kMethodId.holds(method))
        throw IoError(file.string(),
                      fmt::format("the name of a method has {}", kMethodId.expected));
      methods.insert(method);
      maps.push_back(
          scored_external_map(experiment, checkpoint, method, positions_of(file, checkpoint)));
    }
  });
  return maps;
}

/// Adds the maps that a method has not given where another map of it is: they are lost.
void add_lost(const Experiment& experiment, const std::vector<Run>& runs,
              const std::set<std::string>& methods, std::vector<ExternalMap>& maps) {
  using Checkpoint = std::tuple<std::string, RunId, Sensor, int>;
  std::set<Checkpoint> there;
  std::set<std::pair<std::string, Sensor>> sensors;
  for (const ExternalMap& map : maps) {
    there.emplace(map.method, map.run, map.sensor, map.steps);
    sensors.emplace(map.method, map.sensor);
  }
  for (const std::string& method : methods)
    for (const Run& run : runs)
      for (const SensorStudy& study : experiment.sensors)
        for (const int steps : study.checkpoints) {
          const Sensor sensor = study.sensor.sensor;
          if (sensors.contains({method, sensor}) &&
              !there.contains({method, run.id, sensor, steps}))
            maps.push_back({.method = method,
                            .run = run.id,
                            .sensor = sensor,
                            .steps = steps,
                            .failure = "there is no file of it"});
        }
}

int import_maps(const ImportArguments& arguments, const Invocation& invocation) {
  check_external_folder(arguments.outputs.out);
  const Study study = read_mapping_study(arguments.study);
  refuse_links_out(arguments.maps);
  std::set<std::string> methods;
  std::vector<ExternalMap> maps;
  for (const Run& run : study.runs)
    for (ExternalMap& map : maps_of_run(study.experiment, run.id, arguments.maps, methods))
      maps.push_back(std::move(map));
  if (maps.empty())
    throw IoError(arguments.maps,
                  "has no map: expected RUN/SENSOR/STEPS/METHOD.csv, as in "
                  "layout-1-pose-1/bearing/2000/tsne.csv");
  add_lost(study.experiment, study.runs, methods, maps);
  MethodLabels labels;
  for (const std::string& method : methods) labels.push_back({method, method});
  return write_external_study(study, maps, labels, arguments.outputs, invocation);
}

}  // namespace

Action import_command(CLI::App& app) {
  auto arguments = std::make_shared<ImportArguments>();
  app.description("Compare maps that others made of exported files with the methods of a study");
  app.footer(
      "Examples:\n"
      "  mapproof export out --out files\n"
      "  mapproof import out files --out out-import\n\n"
      "MAPS/RUN/SENSOR/STEPS/METHOD.csv holds one map: name, x_m, y_m in any frame; a landmark "
      "may\n"
      "be missing. A map that a method gave of some checkpoint and not of another one is lost.\n");
  app.add_option("STUDY", arguments->study, "Folder of a study of the mapping methods")
      ->required()
      ->check(names_folder());
  app.add_option("MAPS", arguments->maps, "Folder of the maps")->required()->check(names_folder());
  add_external_outputs(app, arguments->outputs);
  group_options(app, {{"Input", {"STUDY", "MAPS"}}});
  return [arguments](const Invocation& invocation) { return import_maps(*arguments, invocation); };
}

}  // namespace mapproof
