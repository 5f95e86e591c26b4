#include <memory>
#include <system_error>
#include <utility>

#include <fmt/format.h>

#include "core/base/errors.hpp"
#include "core/base/files/files.hpp"
#include "core/experiment/run.hpp"
#include "core/external/method_process.hpp"
#include "core/records/experiments/experiment_json.hpp"
#include "core/records/experiments/external_methods.hpp"
#include "core/records/experiments/profiles.hpp"
#include "core/records/studies/results_of.hpp"
#include "core/records/studies/run_json.hpp"
#include "core/records/studies/study_folder.hpp"
#include "core/records/studies/study_store.hpp"
#include "core/studies/experiment_changes.hpp"
#include "core/studies/study_kind.hpp"

namespace mapproof {
namespace {

namespace fs = std::filesystem;

/// The experiment with the methods of others that the person named, ready to be started.
/// @throws IoError.
Experiment ordered_experiment(std::string_view text, const std::string& source,
                              const PlanOptions& options) {
  Experiment experiment = parse_experiment(text, source, options.profile);
  for (ExternalMethod& method : experiment.external_methods) method.folder = options.folder;
  if (options.methods) {
    const std::string file = options.methods->string();
    add_external_methods(experiment, parse_external_methods(read_file(file), file));
    if (const auto fault = fault_of(experiment)) throw IoError(file, fault->what);
  }
  apply(options.changes, experiment);
  return experiment;
}

/// @throws IoError if a file of a method cannot be read.
std::vector<MethodFiles> files_of_methods(const Experiment& experiment) {
  std::vector<MethodFiles> files;
  for (const ExternalMethod& method : experiment.external_methods)
    if (std::string digest = digest_of(method); !digest.empty())
      files.push_back({.method = method.name, .sha256 = std::move(digest)});
  return files;
}

StudyPlan plan_mapping(std::string_view text, const std::string& source,
                       const PlanOptions& options) {
  Experiment experiment = ordered_experiment(text, source, options);
  const std::vector<MethodFiles> method_files = files_of_methods(experiment);
  const auto others =
      std::make_shared<MethodProcesses>(experiment.external_methods, options.disclosed);
  // The processes have the commands as they are; the records have them as they may be shown.
  if (options.disclosed_command)
    for (ExternalMethod& method : experiment.external_methods)
      method.command = options.disclosed_command(method.command);
  const auto start = [=](Provenance made_by) {
    made_by.method_files = method_files;
    return study_start(experiment, made_by);
  };
  StudyPlan plan{.name = experiment.name,
                 .seed = experiment.seed,
                 .layouts = experiment.layouts,
                 .poses = experiment.poses,
                 .uses_methods = true,
                 .start = start,
                 .noun = "runs"};
  for (const RunId& id : runs_of(experiment))
    plan.tasks.push_back({slug(id), [=](const fs::path& folder) { return holds_run(folder, id); },
                          [=] { return part_of(simulate_run(experiment, id, others.get())); }});
  return plan;
}

Run read_run(const fs::path& file, const RunId& id) {
  Run run = parse_run(read_file(file), file.string());
  if (run.id != id) throw IoError(file.string(), "/run", "states that it is " + slug(run.id));
  return run;
}

void add_world(StudyContents& contents, const Run& run) {
  const std::string id = slug(run.id);
  contents.runs.set(id, fmt::format("layout-{}", run.id.layout));
  contents.worlds[id].points = run.world.landmarks_m;
  for (const Eigen::Index anchor : run.anchors) contents.anchors[id] += fmt::format(" {}", anchor);
}

void read_mapping(const fs::path& folder, const std::string& text, const ContentsAsked& asked,
                  StudyContents& contents) {
  const StudyFiles files{folder};
  Study study = parse_study(text, files.study().string());
  contents.provenance = study.provenance;
  for (const RunId& id : files.listed_runs()) {
    contents.runs.set(slug(id), "");
    try_file(contents, folder, files.run(id), asked, [&] {
      if (!asked.keeps_on && !contains(study.experiment, id))
        throw IoError(files.run(id).string(), "is not a run of the experiment");
      study.runs.push_back(read_run(files.run(id), id));
      add_world(contents, study.runs.back());
    });
    std::error_code error;
    if (asked.maps && fs::exists(files.map(id), error) && asked.maps(files.map(id)))
      try_file(contents, folder, files.map(id), asked, [&] {
        for (const MapRecord& map : parse_maps(read_file(files.map(id)), files.map(id)).maps)
          contents.points[map.id] = placed(map);
      });
  }
  contents.results = results_of(study);
  for (const ExternalMethod& method : study.experiment.external_methods)
    for (const MethodSetting& setting : settings_of({{method_of(method), method.values}}))
      contents.labels.add_method(slug(setting), label(setting));
  if (asked.seconds) contents.seconds = seconds_of(read_timings(folder));
}

/// That the runs belong to the experiment and have their maps.
std::vector<std::string> check_mapping(const fs::path& folder) {
  for (const Run& run : read_study(folder).runs) {
    const std::size_t maps = read_maps(folder, run.id).size();
    if (maps > run.records.size())
      throw IoError(StudyFiles{folder}.map(run.id).string(), "/maps",
                    fmt::format("{} maps for {} records", maps, run.records.size()));
    read_details(folder, run.id);
  }
  return {};
}

void check_experiment_file(std::string_view text, const std::string& source) {
  parse_experiment(text, source);
  for (const std::string& profile : profile_names(text, source, kMappingStudies.experiment))
    parse_experiment(text, source, profile);
}

}  // namespace

const StudyKind kMappingStudies = {
    .study = "mapproof.study",
    .title = "a study of the mapping methods",
    .experiment = "mapproof.experiment",
    .files = {{"mapproof.study", [](auto text, auto& source) { parse_study(text, source); }},
              {"mapproof.experiment", check_experiment_file},
              {"mapproof.run", [](auto text, auto& source) { parse_run(text, source); }},
              {"mapproof.maps", [](auto text, auto& source) { parse_maps(text, source); }},
              {"mapproof.details", [](auto text, auto& source) { parse_details(text, source); }}},
    .records = StudyFiles{}.records(),
    .plan = plan_mapping,
    .start =
        [](auto text, auto& source) {
          const Study study = parse_study(text, source);
          return study_start(study.experiment, study.provenance);
        },
    .read = read_mapping,
    .check = check_mapping,
};

}  // namespace mapproof
