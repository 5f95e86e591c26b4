#include "app/commands.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <memory>
#include <optional>
#include <utility>

#include <fmt/format.h>

#include "app/build_facts.hpp"
#include "app/console.hpp"
#include "app/failures.hpp"
#include "app/input_streams.hpp"
#include "app/map/incremental.hpp"
#include "app/map/map_folder.hpp"
#include "app/option_pairs.hpp"
#include "app/result_json.hpp"
#include "app/slam/range_map.hpp"
#include "app/slam/slam_json.hpp"
#include "app/study/folder_report.hpp"
#include "app/understood.hpp"
#include "core/base/errors.hpp"
#include "core/base/files/byte_source.hpp"
#include "core/base/files/files.hpp"
#include "core/base/files/output_folder.hpp"
#include "core/base/text/words.hpp"
#include "core/records/observations/trajectories.hpp"
#include "core/records/ranges/range_companions.hpp"
#include "core/records/ranges/range_log_g2o.hpp"
#include "core/records/ranges/range_logs.hpp"
#include "core/records/studies/slam_store.hpp"
#include "render/figures/status_text.hpp"
#include "reports/sections/fit_text.hpp"

namespace mapproof {
namespace {

namespace fs = std::filesystem;

struct SlamArguments {
  std::string data;
  std::string out;
  std::string known;
  std::optional<std::string> templates;
  RangeLogOptions log;
  std::vector<std::string>
      ground_truths;         ///< As typed; sort_ground_truths() tells path and landmarks apart.
  std::string ground_truth;  ///< The true path.
  std::string true_landmarks;
  std::string odometry;
  LogFitOptions fit;
  bool repair = false;
  bool incremental = false;
  std::string every = "1s";
  std::vector<std::string> columns;
  int jobs = 1;
};

using Arguments = const SlamArguments&;

/// The options that do not go with every other.
const std::vector<ListedOption<SlamArguments>> kOptions = {
    {"--odometry", [](Arguments given) { return !given.odometry.empty(); }},
    {"--ground-truth of a path", [](Arguments given) { return !given.ground_truth.empty(); }},
    {"--name", [](Arguments given) { return !given.log.name.empty(); }},
    {"--range-sigma", [](Arguments given) { return given.fit.noise.range_m > 0.0; }},
    {"--odometry-sigma", [](Arguments given) { return given.fit.noise.way_m > 0.0; }},
    {"--heading-sigma", [](Arguments given) { return given.fit.noise.heading_per_metre > 0.0; }},
    {"--odometry-scale-sigma",
     [](Arguments given) {
       return given.fit.odometry_scale_sigma != LogFitOptions().odometry_scale_sigma;
     }},
    {"--repair", [](Arguments given) { return given.repair; }},
    {"--incremental", [](Arguments given) { return given.incremental; }},
    {"--every", [](Arguments given) { return given.every != SlamArguments().every; }},
};

constexpr std::string_view kRangesAlone =
    "an incremental map is one of landmarks from ranges alone; map the whole log instead";

constexpr OptionPair kApart[] = {
    {"--odometry", "--incremental", kRangesAlone},
    {"--ground-truth of a path", "--incremental", kRangesAlone},
    {"--name", "--incremental", "an incremental map is named after the file that it is read from"},
    {"--range-sigma", "--incremental",
     "an incremental map does not depend on the noise of the ranges"},
    {"--odometry-sigma", "--incremental", kRangesAlone},
    {"--heading-sigma", "--incremental", kRangesAlone},
    {"--odometry-scale-sigma", "--incremental", kRangesAlone},
    {"--repair", "--incremental",
     "whether the data fit an incremental map is not tested; map the whole log instead"},
};

constexpr OptionPair kNeeded[] = {
    {"--every", "--incremental",
     "it is the interval of the updates of --incremental; add --incremental"},
};

const OptionTable<SlamArguments> kOptionTable{kOptions, kApart, kNeeded};

/// @throws InvalidInput for options that do not go together.
void require_compatible(const SlamArguments& arguments) {
  const std::string refusal =
      kOptionTable.refusal(arguments, [](const OptionPair& pair) { return std::string(pair.why); });
  if (!refusal.empty()) throw InvalidInput(refusal);
}

/// Puts each file of --ground-truth where it belongs. @throws InvalidInput for two of a kind.
void sort_ground_truths(SlamArguments& arguments) {
  for (const std::string& typed : arguments.ground_truths) {
    const std::string file = made_file(typed);
    ByteSource source(file);
    const bool is_landmarks = holds_landmarks(source, arguments.log.columns);
    std::string& place = is_landmarks ? arguments.true_landmarks : arguments.ground_truth;
    if (!place.empty())
      throw InvalidInput(fmt::format("--ground-truth: {} and {} are both {}", printable(place),
                                     printable(typed), is_landmarks ? "landmarks" : "paths"));
    place = file;
  }
}

/// A study of this one log.
SlamStudy study_of(const SlamRun& run) {
  SlamStudy study;
  study.experiment.name = "own";
  study.experiment.title = "Range-only map of " + run.log.name;
  study.provenance = build_provenance();
  study.runs = {run};
  study.runs[0].upgrade.reset();  // Its scene would make a person wait for VTK.
  return study;
}

/// The log with its map as g2o, for other programs; empty where there is no model of the noise.
std::optional<std::string> graph_of(const SlamRun& run, const SlamRecord& best) {
  if (!run.fit || run.log.odometry.empty()) return std::nullopt;
  const auto number = [&](std::string_view quantity) {
    const FitNumber* found = run.fit->number(quantity);
    return found == nullptr ? 0.0 : found->value;
  };
  double way_m = 0.0;
  for (const Motion& motion : run.log.odometry)
    way_m += std::hypot(motion.distance_m, motion.sideways_m);
  const double root = std::sqrt(way_m / static_cast<double>(run.log.odometry.size()));
  const double forward_m = std::max(number("fit_forward_sigma_m") * root, 1e-9);
  const double heading_change_rad = std::max(number("fit_heading_sigma_rad") * root, 1e-9);
  if (!(number("fit_range_sigma_m") > 0.0) ||
      best.estimate.path.size() != std::ssize(run.log.odometry) + 1 ||
      best.estimate.path.heading_rad.size() == 0)
    return std::nullopt;
  return range_log_g2o(run.log, best.estimate, {forward_m, forward_m, heading_change_rad},
                       number("fit_range_sigma_m"));
}

void write_outputs(const SlamArguments& arguments, const SlamRunResult& result,
                   const Templates& page, const Invocation& invocation) {
  const SlamRun& run = result.run;
  const SlamFolder folder(arguments.out, run);
  const OutputFolder out(folder.path());
  // The file that marks the folder comes first: a killed command can then be repeated.
  out.write(kSlamFile, slam_run_json(run));
  write_paths(run, out, "paths");
  if (const SlamRecord* best = best_record(run)) {
    out.write("landmarks.csv", landmarks_csv(run.log.landmarks, best->estimate.landmarks_m));
    out.write("path.csv", trajectory_csv(best->estimate.path));
    out.write("path.tum", trajectory_tum(best->estimate.path));
    if (const std::optional<std::string> graph = graph_of(run, *best)) out.write("log.g2o", *graph);
  }
  write_report(
      slam_folder_report(folder.path(), study_of(run),
                         {.methods = result.timings, .factorization = {}}, {}, invocation.command),
      {.page = page,
       .jobs = arguments.jobs,
       .disclosure = invocation.disclosure,
       .progress = count_progress(invocation.console, "drawing")},
      folder.lock());
}

nlohmann::ordered_json slam_result(const SlamRun& run, const fs::path& out) {
  const SlamRecord* best = best_record(run);
  nlohmann::ordered_json object{
      {"name", run.log.name},
      {"method", best == nullptr ? nlohmann::ordered_json(nullptr)
                                 : nlohmann::ordered_json(info(best->method).name)},
      {"window_s",
       run.windows ? number_or_null(run.windows->chosen_s) : nlohmann::ordered_json(nullptr)},
      {"fit", run.fit ? fit_json(*run.fit) : nlohmann::ordered_json(nullptr)},
      {"landmarks", nlohmann::ordered_json::array()},
      {"methods", nlohmann::ordered_json::array()},
      {"remarks", run.log.remarks},
      {"slam", (out / kSlamFile).string()},
      {"report", (out / "report.html").string()}};
  for (Eigen::Index n = 0; best != nullptr && n < best->estimate.landmarks_m.rows(); ++n)
    object["landmarks"].push_back({{"name", run.log.landmarks[static_cast<std::size_t>(n)]},
                                   {"x_m", number_or_null(best->estimate.landmarks_m(n, 0))},
                                   {"y_m", number_or_null(best->estimate.landmarks_m(n, 1))}});
  for (const SlamRecord& record : run.records) {
    nlohmann::ordered_json method{{"method", info(record.method).name},
                                  {"poses", record.estimate.path.size()}};
    put_slam_errors(method, record);
    object["methods"].push_back(std::move(method));
  }
  return object;
}

std::string slam_text(const SlamRun& run, const fs::path& out) {
  std::string text;
  if (run.fit) {
    text += verdict_text(*run.fit) + "\n";
    for (const FitCause& cause : run.fit->causes) text += "  " + cause_text(cause) + "\n";
    if (const std::string parts = parts_text(*run.fit); !parts.empty()) text += "  " + parts + "\n";
  }
  for (const SlamRecord& record : run.records) text += slam_record_text(record) + "\n";
  const SlamRecord* best = best_record(run);
  text += best == nullptr
              ? std::string("No method gave a map.\n")
              : fmt::format("Path and landmarks of the result: {}.\n", info(best->method).label);
  return text + (out / "report.html").string() + "\n";
}

/// Shows the result, and, last, if and why there is no map. @return The command's exit code.
int report_slam(const SlamArguments& arguments, const SlamRun& run, const Invocation& invocation) {
  invocation.console.result(slam_text(run, arguments.out), slam_result(run, arguments.out));
  if (best_record(run) != nullptr) return kDone;
  std::vector<Status> statuses;
  for (const SlamRecord& record : run.records)
    std::ranges::copy(record.estimate.statuses, std::back_inserter(statuses));
  return report_no_map(arguments.data, statuses);
}

int incremental_slam(const SlamArguments& arguments, const Templates& page,
                     const Invocation& invocation) {
  MapJob job;
  job.path = arguments.data;
  job.sensor = name(Sensor::kRange);
  job.table.columns = arguments.columns;
  job.columns = column_names(arguments.columns);
  job.anchors = arguments.known;
  job.known_anchors = read_points(arguments.known, job.columns);
  job.known_ground_truth = read_points(arguments.true_landmarks, job.columns);
  job.fit = "rigid";
  job.incremental = true;
  job.every = arguments.every;
  return write_incremental(job, incremental_ranges,
                           {.out = arguments.out,
                            .observations = arguments.data,
                            .command = invocation.command,
                            .page = page,
                            .disclosure = invocation.disclosure},
                           invocation);
}

int map_ranges(SlamArguments arguments, const Invocation& invocation) {
  const Templates page = load_templates(arguments.templates);
  std::vector<std::string> inputs = {arguments.data, arguments.known, arguments.odometry};
  inputs.insert(inputs.end(), arguments.ground_truths.begin(), arguments.ground_truths.end());
  refuse_shared_streams(inputs);
  arguments.log.columns = column_names(arguments.columns, kRangeLogRoles);
  sort_ground_truths(arguments);
  require_compatible(arguments);
  if (arguments.incremental) return incremental_slam(arguments, page, invocation);
  check_result_folder(arguments.out, kSlamFile, "range-only map");
  std::optional<NamedPointsFile> anchors = read_points(arguments.known, arguments.log.columns);
  arguments.log.odometry_file = arguments.odometry;
  arguments.log.ground_truth_file = arguments.ground_truth;
  arguments.log.landmarks_file = arguments.true_landmarks;
  std::optional<ProgressLine> working(std::in_place, invocation.console, "reading");
  RangeLog log = read_range_log(arguments.data, arguments.log);
  std::optional<KnownLandmarks> known;
  if (anchors) {
    known = known_landmarks_of(log, *anchors);
    if (!anchors->points.heights.empty()) log.remarks.push_back(anchors->points.heights);
  }
  invocation.console.info(understood_line(log));
  working.emplace(invocation.console, "mapping");
  const SlamRunResult result = range_map(std::move(log), known, arguments.fit, arguments.repair);
  working.reset();
  for (const std::string& remark : result.run.log.remarks) invocation.console.info(remark);
  for (const SlamRecord& record : result.run.records)
    for (const Status& status : record.estimate.statuses)
      invocation.console.warning(fmt::format("{}: {}: {}", info(record.method).name,
                                             name(status.code), status_text(status)));
  write_outputs(arguments, result, page, invocation);
  return report_slam(arguments, result.run, invocation);
}

void add_input_options(CLI::App& app, SlamArguments& arguments) {
  app.add_option("DATA", arguments.data, "File or folder")->required();
  add_out_option(app, arguments.out, "Folder for map, paths, figures and report")->required();
  app.add_option("--anchors", arguments.known,
                 "Known positions of landmarks, which the methods use: CSV with name, x [m], y [m]")
      ->type_name("FILE");
  app.add_option("--ground-truth,--truth", arguments.ground_truths,
                 "Ground truth, to compute errors only: the true path (CSV with t, x, y, heading; "
                 "TUM; or g2o), true positions of landmarks (CSV with name, x [m], y [m]), or "
                 "both, each by an option of its own")
      ->allow_extra_args(false)
      ->type_name("FILE");
  app.add_option("--odometry", arguments.odometry,
                 "Odometry, instead of that in DATA: CSV with t, ddist, dheading");
  app.get_option("--odometry")->type_name("FILE");
  app.add_option(
         "--columns", arguments.columns,
         "Headers or numbers of the columns of tables, as in time=Zeit,landmark=Bake,"
         "range=3; also nanoseconds, robot; of odometry distance, heading_change, sideways; "
         "of the ground truth x, y, heading")
      ->type_name("NAME=COLUMN")
      ->allow_extra_args(false)
      ->delimiter(',');
}

void add_fit_options(CLI::App& app, SlamArguments& arguments) {
  app.add_option("--range-sigma", arguments.fit.noise.range_m,
                 "Standard deviation of a range [m]; without: estimated")
      ->check(above_zero());
  app.add_option("--odometry-sigma", arguments.fit.noise.way_m,
                 "Standard deviation of odometry after 1 m, which grows with the root of the way "
                 "[m]; without: estimated")
      ->check(above_zero());
  app.add_option("--heading-sigma", arguments.fit.noise.heading_per_metre,
                 "Standard deviation of its heading after 1 m [rad]; without: estimated")
      ->check(above_zero());
  app.add_option("--odometry-scale-sigma", arguments.fit.odometry_scale_sigma,
                 "Standard deviation of the scale of odometry, a share, in the ellipses where "
                 "ranges and odometry disagree on the scale")
      ->check(number_in(0.0, 0.5))
      ->capture_default_str();
  app.add_flag("--repair", arguments.repair,
               "If the data do not fit the map and the cause can be modelled: also make the map "
               "that allows for it, and take it as the result if it predicts held-out ranges as "
               "well or better");
}

}  // namespace

Action slam_command(CLI::App& app) {
  auto arguments = std::make_shared<SlamArguments>();
  app.description("Map landmarks and path from your own log of ranges and odometry");
  app.footer(
      "Examples:\n"
      "  mapproof slam plaza/plaza1 --out out/plaza1\n"
      "  mapproof slam Plaza1_.mat --name \"Plaza 1\" --out out/plaza1\n"
      "  range_sensor | mapproof slam - --incremental --every 5s --out out/live\n"
      "  mapproof slam run7_TD.txt --anchors beacons.csv --ground-truth gps.csv --out "
      "out/run7\n\n"
      "DATA is one of\n"
      "  a folder with ranges.csv, and perhaps odometry.csv, groundtruth.csv, landmarks.csv\n"
      "  NAME.mat of the Plaza sets; NAME_DR.txt with NAME_TD.txt; NAME.pyfg; NAME.g2o\n"
      "  a CSV file of ranges, a pipe or standard input (-); odometry comes by --odometry\n"
      "It may be compressed by gzip or xz. Ranges are single distances to named landmarks, at any\n"
      "times. The window that brings them to common times is chosen by prediction error. Errors "
      "are\n"
      "reported only with ground truth. Without odometry the map may be reflected.\n"
      "The exit code is 1 if there is no map; the last line and the report state why.\n");
  add_input_options(app, *arguments);
  add_fit_options(app, *arguments);
  app.add_flag(
      "--incremental", arguments->incremental,
      "Read long CSV of ranges that are taken together (step, landmark, range [m]) while the file "
      "grows (-: standard input), and update map and figure until it ends, or until SIGINT or "
      "SIGTERM. Maps landmarks only, in constant memory. " +
          kOptionTable.not_with("--incremental"));
  app.add_option("--every", arguments->every,
                 "With --incremental: update after so many steps (100) or seconds (2s)")
      ->capture_default_str();
  app.add_option("--name", arguments->log.name, "Name of the log, for titles");
  app.add_option("--templates", arguments->templates,
                 "Folder whose templates replace the embedded ones")
      ->check(names_folder());
  add_jobs_option(app, arguments->jobs);
  group_options(app, {{"Input", {"DATA", "--odometry", "--columns", "--name"}},
                      {"Known positions", {"--anchors", "--ground-truth"}},
                      {"Fit",
                       {"--range-sigma", "--odometry-sigma", "--heading-sigma",
                        "--odometry-scale-sigma", "--repair"}},
                      {"Files that grow", {"--incremental", "--every"}},
                      {"Output", {"--templates"}}});
  return [arguments](const Invocation& invocation) { return map_ranges(*arguments, invocation); };
}

}  // namespace mapproof
