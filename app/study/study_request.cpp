#include "app/study/study_request.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "app/build_facts.hpp"
#include "core/base/errors.hpp"
#include "core/base/files/files.hpp"
#include "core/base/sha256.hpp"
#include "core/records/experiments/profiles.hpp"
#include "core/records/studies/results_study_json.hpp"
#include "core/records/studies/study_folder.hpp"
#include "core/studies/study_kind.hpp"

namespace mapproof {
namespace {

constexpr std::string_view kFull = "full";

/// The profile asked for; "" where it may be missing and is.
std::string profile_of(const StudyOptions& options, const std::vector<std::string>& known) {
  const bool is_there = std::ranges::find(known, options.profile) != known.end();
  const bool may_be_missing = options.profile_if_there || options.profile == kFull;
  return is_there || !may_be_missing ? options.profile : "";
}

}  // namespace

void add_data_options(CLI::App& app, StudyOptions& options) {
  app.add_option("--plaza", options.plaza, "Folder of the Plaza data, for experiments on them")
      ->check(CLI::ExistingDirectory)
      ->group("Experiment");
  app.add_option("--data", options.data,
                 "Folder of data sets, or of one, for experiments made of them (mrclam)")
      ->check(CLI::ExistingDirectory)
      ->group("Experiment");
  app.add_option("--methods", options.methods,
                 "methods.json: mapping methods of others, commands that are compared with ours")
      ->group("Experiment");
}

StudyRequest read_study_request(const ExperimentText& file, const StudyOptions& options,
                                const Disclosure& disclosure) {
  const StudyKind& kind = kind_of_experiment(file.text, file.source);
  PlanOptions how{
      .profile = profile_of(options, profile_names(file.text, file.source, kind.experiment)),
      .changes = options.changes,
      .one_of_several = options.one_of_several,
      .plaza = options.plaza,
      .data = options.data,
      .folder = file.folder,
      .methods = options.methods,
      .disclosed = [disclosure](std::string text) { return disclosure.text(std::move(text)); },
      .disclosed_command =
          [disclosure](std::vector<std::string> words) {
            return disclosure.method_command(std::move(words));
          }};
  const std::string methods = options.methods ? "\n" + read_file(*options.methods) : "";
  StudyRequest request{.digest = sha256_hex(options.profile + "\n" + file.text + methods),
                       .plan = kind.plan(file.text, file.source, how)};
  request.name = request.plan.name;
  return request;
}

StudyRequest given_study_request(const std::filesystem::path& folder) {
  return {.name = read_results_study(folder).name,
          .digest = results_study_digest(folder),
          .given = folder};
}

std::string read_unchanged(const std::filesystem::path& file, const std::function<void()>& read) {
  const auto digest = [&] {
    Sha256 sum;
    sum.add_file(file);
    return sum.hex();
  };
  const std::string before = digest();
  read();
  if (digest() != before) throw IoError(file.string(), kChangedWhileRead);
  return before;
}

std::string results_study_digest(const std::filesystem::path& folder) {
  Sha256 digest;
  for (const std::filesystem::path& file : results_study_files(folder)) {
    digest.add(file.string() + "\n");
    digest.add_file(folder / file);
  }
  return digest.hex();
}

bool needs_data(const ExperimentText& file) {
  const StudyKind& kind = kind_of_experiment(file.text, file.source);
  return kind.needs_data != nullptr && kind.needs_data(file.text, file.source);
}

void check_data_used(std::span<const StudyRequest> requests, const StudyOptions& options) {
  const auto refuse = [&](std::string_view option, std::string_view what) {
    throw InvalidInput(fmt::format("{}: {} {}", option,
                                   requests.size() == 1 ? "the experiment " + requests.front().name
                                                        : "none of the experiments",
                                   what));
  };
  constexpr std::string_view kNoData = "uses no such data";
  const auto uses = [&](bool StudyPlan::*data) {
    return std::ranges::any_of(requests,
                               [&](const StudyRequest& request) { return request.plan.*data; });
  };
  if (options.plaza && !uses(&StudyPlan::uses_plaza)) refuse("--plaza", kNoData);
  if (options.data && !uses(&StudyPlan::uses_data)) refuse("--data", kNoData);
  if (options.methods && !uses(&StudyPlan::uses_methods))
    refuse("--methods", "takes no mapping methods of others");
}

std::vector<std::string> words_of(std::span<const StudyRequest> requests,
                                  const StudyOptions& options) {
  std::vector<std::string> words;
  if (!options.profile.empty() && options.profile != kFull)
    words.insert(words.end(), {"--profile", options.profile});
  // Studies of several experiments have a seed each.
  if (requests.size() == 1 || options.changes.seed)
    words.insert(words.end(), {"--seed", std::to_string(requests.front().plan.seed)});
  const auto has_runs = [](const StudyRequest& request) {
    return request.plan.layouts.has_value();
  };
  if (const auto request = std::ranges::find_if(requests, has_runs); request != requests.end()) {
    const StudyPlan& plan = request->plan;
    if (options.changes.layouts)
      words.insert(words.end(), {"--layouts", std::to_string(*plan.layouts)});
    if (options.changes.poses) words.insert(words.end(), {"--poses", std::to_string(*plan.poses)});
  }
  if (options.plaza) words.insert(words.end(), {"--plaza", *options.plaza});
  if (options.data) words.insert(words.end(), {"--data", *options.data});
  if (options.methods) words.insert(words.end(), {"--methods", *options.methods});
  return words;
}

std::string study_json(const StudyRequest& request) {
  if (!request.texts.empty()) return request.texts.at(kStudyFile);
  return request.given.empty() ? request.plan.start(build_provenance()).text
                               : read_file(request.given / kStudyFile);
}

}  // namespace mapproof
