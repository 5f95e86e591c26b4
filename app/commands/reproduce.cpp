#include <algorithm>
#include <memory>
#include <system_error>
#include <variant>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "app/commands/verbs.hpp"
#include "app/embedded_experiments.hpp"
#include "app/folder_report.hpp"
#include "app/study_run.hpp"
#include "core/base/errors.hpp"
#include "core/records/experiment_json.hpp"
#include "core/records/slam_experiment_json.hpp"
#include "core/records/slam_store.hpp"
#include "core/records/study_store.hpp"

namespace mapproof {
namespace {

namespace fs = std::filesystem;

constexpr const char* kAll = "all";

struct Arguments {
  std::string name;
  std::string out = "out";
  std::string profile = "full";
  int jobs = 1;
  ExperimentChanges changes;
  std::optional<std::string> templates;
  std::optional<std::string> plaza;
};

/// A range-only experiment and the logs of it that are there.
struct SlamOrder {
  SlamExperiment experiment;
  SlamData data;
};

/// One experiment and where its records go.
struct Order {
  fs::path folder;
  std::variant<Experiment, SlamOrder> experiment;
};

/// @param is_alone  Changes that the experiment knows nothing of are then refused.
Order read_order(const std::string& name, const Arguments& arguments, bool is_alone) {
  const ExperimentText file = experiment_text(name, arguments.templates);
  Order order{.folder = is_alone ? fs::path(arguments.out) : fs::path(arguments.out) / name,
              .experiment = {}};
  ExperimentChanges changes = arguments.changes;
  if (is_slam_experiment(file.text, file.source)) {
    if (!is_alone) changes.layouts = changes.poses = std::nullopt;
    SlamOrder slam{.experiment = parse_slam_experiment(file.text, file.source, arguments.profile),
                   .data = {}};
    apply(changes, slam.experiment);
    slam.data = read_slam_data(slam.experiment, arguments.plaza);
    order.experiment = std::move(slam);
    return order;
  }
  Experiment experiment = parse_experiment(file.text, file.source, arguments.profile);
  apply(changes, experiment);
  order.experiment = std::move(experiment);
  return order;
}

/// All that is ordered, read and checked before anything is made.
std::vector<Order> read_orders(const Arguments& arguments) {
  if (arguments.name != kAll) return {read_order(arguments.name, arguments, true)};
  std::vector<Order> orders;
  for (const std::string& name : experiment_names())
    orders.push_back(read_order(name, arguments, false));
  return orders;
}

/// Throws if a folder for several studies holds anything else. @throws IoError.
void check_folder_of_all(const fs::path& folder) {
  std::error_code error;
  if (is_study(folder))
    throw IoError(folder.string(), "holds a study; choose another folder for all of them");
  std::vector<std::string> ours = experiment_names();
  ours.insert(ours.end(), {"figures", "figures-paper", "tables", "report.html"});
  for (fs::directory_iterator entry(folder, error), end; !error && entry != end;
       entry.increment(error)) {
    const std::string name = entry->path().filename().string();
    const bool is_ours = std::ranges::any_of(
        ours, [&](const std::string& known) { return name.starts_with(known); });
    if (!is_ours)
      throw IoError(folder.string(), "is not empty and holds no studies; choose another folder");
  }
}

/// The command that makes the same studies and report again, wherever it was typed.
std::string command_again(const Arguments& arguments, const std::vector<Order>& orders) {
  std::vector<std::string> words = {"mapproof", "reproduce", arguments.name, "--profile",
                                    arguments.profile};
  if (const auto* experiment = std::get_if<Experiment>(&orders.front().experiment)) {
    ExperimentChanges changes = arguments.changes;
    const std::vector<std::string> more = words_of(changes, *experiment);
    // Studies of several experiments have a seed each.
    if (orders.size() == 1 || changes.seed)
      words.insert(words.end(), more.begin(), more.end());
    else
      words.insert(words.end(), more.begin() + 2, more.end());
  } else {
    const std::uint64_t seed = std::get<SlamOrder>(orders.front().experiment).experiment.seed;
    words.insert(words.end(), {"--seed", std::to_string(seed)});
  }
  if (arguments.plaza) words.insert(words.end(), {"--plaza", *arguments.plaza});
  words.insert(words.end(), {"--out", arguments.out});
  return quoted_command(words);
}

/// Makes the records of one study; its numbers as text and as JSON.
std::pair<std::string, nlohmann::ordered_json> make(const Order& order, int jobs,
                                                    const std::string& command,
                                                    const Console& console) {
  if (const auto* experiment = std::get_if<Experiment>(&order.experiment)) {
    make_records(*experiment, order.folder, jobs, command, console);
    const Study study = read_study(order.folder);
    return {study_text(study), study_result(study)};
  }
  const SlamOrder& slam = std::get<SlamOrder>(order.experiment);
  make_slam_records(slam.experiment, slam.data, order.folder, jobs, command, console);
  const SlamStudy study = read_slam_study(order.folder);
  for (const std::string& missing : study.missing) console.warning(missing);
  return {slam_study_text(study), slam_study_result(study)};
}

int reproduce(const Arguments& arguments, const Invocation& invocation) {
  // First of all, so that a template or data that cannot be used cost no study.
  const Templates page = load_templates(arguments.templates);
  const std::vector<Order> orders = read_orders(arguments);
  if (orders.size() > 1) check_folder_of_all(arguments.out);
  const bool uses_data = std::ranges::any_of(orders, [](const Order& order) {
    return std::holds_alternative<SlamOrder>(order.experiment);
  });
  if (arguments.plaza && !uses_data)
    invocation.console.warning("--plaza: the experiment " + arguments.name +
                               " uses no data from outside");
  const std::string command = command_again(arguments, orders);
  std::string text;
  nlohmann::ordered_json object;
  for (const Order& order : orders) {
    auto [lines, result] = make(order, arguments.jobs, command, invocation.console);
    text += lines;
    if (orders.size() == 1)
      object = std::move(result);
    else
      object["studies"].push_back(std::move(result));
  }
  const FolderReport report = read_folder_report(arguments.out, command, "");
  const fs::path path = write_report(report, page, arguments.jobs);
  object["figures"] = report.figures.size();
  object["scenes"] = report.scenes.size();
  object["report"] = path.string();
  invocation.console.result(text + path.string() + "\n", object);
  return kDone;
}

}  // namespace

Action reproduce_verb(CLI::App& app) {
  auto arguments = std::make_shared<Arguments>();
  app.description("Run a paper's experiment and write its figures and report");
  app.footer(
      "Examples:\n"
      "  mapproof reproduce yairi2007\n"
      "  mapproof reproduce yairi2007 --profile quick --out out/quick --jobs 2\n"
      "  mapproof reproduce boots2013 --plaza plaza --out out/boots2013\n"
      "  mapproof reproduce all --plaza plaza --out out\n\n"
      "\"all\" makes each study in a folder of its own below DIR and puts them into one report.\n"
      "The Plaza data are no part of the program: without --plaza the simulated part of boots2013\n"
      "is made, and the report says how to get them.\n"
      "A study that was stopped goes on where it was; a folder that holds another experiment is "
      "refused.\n");
  app.add_option("NAME", arguments->name,
                 fmt::format("Experiment: {}, or all", fmt::join(experiment_names(), ", ")))
      ->required();
  add_out_option(app, arguments->out, "Folder for records, figures and report")
      ->capture_default_str();
  app.add_option("--profile", arguments->profile, "quick or full")->capture_default_str();
  add_jobs_option(app, arguments->jobs);
  add_experiment_options(app, arguments->changes);
  app.add_option("--templates", arguments->templates,
                 "Folder whose templates and experiments replace the embedded ones");
  add_plaza_option(app, arguments->plaza);
  return [arguments](const Invocation& invocation) { return reproduce(*arguments, invocation); };
}

}  // namespace mapproof
