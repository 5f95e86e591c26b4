#include "app/commands.hpp"

#include <algorithm>
#include <list>
#include <memory>
#include <mutex>
#include <utility>

#include <fmt/format.h>

#include "app/external/external_study.hpp"
#include "core/base/errors.hpp"
#include "core/base/files/files.hpp"
#include "core/base/parallel.hpp"
#include "core/external/external_maps.hpp"
#include "core/external/external_method.hpp"
#include "core/external/method_process.hpp"

namespace mapproof {
namespace {

namespace fs = std::filesystem;

struct BenchArguments {
  std::string study;
  std::string methods;
  ExternalOutputs outputs;
};

/// Processes of one method that answer requests of several threads, one each at a time.
class ProcessPool {
 public:
  ProcessPool(const ExternalMethod& method, fs::path folder)
      : method_(method), folder_(std::move(folder)) {}

  ExternalReply map(const ExternalRequest& request) {
    std::list<MethodProcess> mine;
    {
      const std::lock_guard lock(mutex_);
      if (free_.empty())
        mine.emplace_back(method_, folder_);
      else
        mine.splice(mine.begin(), free_, free_.begin());
    }
    ExternalReply reply = mine.front().map(request);
    const std::lock_guard lock(mutex_);
    free_.splice(free_.begin(), mine);
    return reply;
  }

 private:
  const ExternalMethod& method_;
  fs::path folder_;
  std::mutex mutex_;
  std::list<MethodProcess> free_;
};

/// Every map that the methods make of a run.
class RunMapper {
 public:
  RunMapper(const Experiment& experiment, const ExternalMethods& methods, const fs::path& folder)
      : experiment_(experiment), settings_(settings_of(methods)) {
    for (const ExternalMethod& method : methods.methods) pools_.emplace_back(method, folder);
    for (const ExternalSetting& setting : settings_)
      pool_of_.push_back(static_cast<std::size_t>(setting.method - methods.methods.data()));
  }

  std::vector<ExternalMap> maps(const RunId& run) {
    std::vector<ExternalMap> maps;
    observe_run(experiment_, run, [&](const ObservedCheckpoint& checkpoint) {
      for (std::size_t i = 0; i < settings_.size(); ++i) maps.push_back(map(checkpoint, i));
    });
    return maps;
  }

 private:
  ExternalMap map(const ObservedCheckpoint& checkpoint, std::size_t index) {
    const ExternalSetting& setting = settings_[index];
    const ExternalReply reply =
        std::next(pools_.begin(), static_cast<std::ptrdiff_t>(pool_of_[index]))
            ->map({.id = checkpoint.id,
                   .sensor = std::string(name(checkpoint.sensor)),
                   .steps = checkpoint.steps,
                   .landmarks = checkpoint.history.names,
                   .input = external_input(checkpoint, setting.method->input),
                   .parameter = setting.parameter,
                   .seed = checkpoint.seed});
    if (!reply.failure)
      return scored_external_map(experiment_, checkpoint, slug(setting), reply.coordinates);
    std::string why(name(*reply.failure));
    if (!reply.detail.empty()) why += ": " + reply.detail;
    return {.method = slug(setting),
            .run = checkpoint.run,
            .sensor = checkpoint.sensor,
            .steps = checkpoint.steps,
            .id = checkpoint.id,
            .failure = std::move(why)};
  }

  const Experiment& experiment_;
  std::vector<ExternalSetting> settings_;
  std::list<ProcessPool> pools_;
  std::vector<std::size_t> pool_of_;
};

std::string words_of(const ExternalMethods& methods, const fs::path& folder) {
  std::string text;
  for (const ExternalMethod& method : methods.methods) {
    text +=
        fmt::format(" {}{}: a command that gets {}", method.label,
                    method.source.empty() ? "" : " (" + method.source + ")", name(method.input));
    const std::string digest = digest_of(method, folder);
    text += digest.empty() ? "." : fmt::format(", its files have the SHA-256 {}.", digest);
  }
  return text.substr(1);
}

int bench(const BenchArguments& arguments, const Invocation& invocation) {
  check_external_folder(arguments.outputs.out);
  const fs::path file = arguments.methods;
  const ExternalMethods methods = parse_external_methods(read_file(file), file.string());
  const std::string made_of = words_of(methods, file.parent_path());
  const Study study = read_mapping_study(arguments.study);
  if (study.runs.empty()) throw IoError(arguments.study, "has no run yet");
  RunMapper mapper(study.experiment, methods, file.parent_path());
  std::vector<std::vector<ExternalMap>> of_runs(study.runs.size());
  parallel_for(arguments.outputs.jobs, study.runs.size(),
               [&](std::size_t i) { of_runs[i] = mapper.maps(study.runs[i].id); });
  std::vector<ExternalMap> maps;
  for (std::vector<ExternalMap>& of_run : of_runs)
    for (ExternalMap& map : of_run) maps.push_back(std::move(map));
  MethodLabels labels;
  for (const ExternalSetting& setting : settings_of(methods))
    labels.push_back({slug(setting), label(setting)});
  return write_external_study(study, maps, labels, made_of, arguments.outputs, invocation);
}

}  // namespace

Action bench_command(CLI::App& app) {
  auto arguments = std::make_shared<BenchArguments>();
  app.description("Compare mapping methods of others, given as commands, with those of a study");
  app.footer(
      "Examples:\n"
      "  mapproof reproduce yairi2007 --profile quick --out out\n"
      "  mapproof bench out --methods methods.json --out out-bench\n\n"
      "methods.json names the commands. Each gets the observations of every checkpoint of every\n"
      "run, and answers with coordinates (docs/external-methods.md has the protocol). Commands "
      "run\n"
      "only from the file that you name here. A map that a command does not give is lost; the\n"
      "report says why. The exit code is 1 if all are lost.\n");
  app.add_option("STUDY", arguments->study, "Folder of a study of the mapping methods")
      ->required()
      ->check(names_folder());
  app.add_option("--methods", arguments->methods, "methods.json")->required();
  add_external_outputs(app, arguments->outputs);
  group_options(app, {{"Input", {"STUDY", "--methods"}}});
  return [arguments](const Invocation& invocation) { return bench(*arguments, invocation); };
}

}  // namespace mapproof
