#include "app/commands.hpp"

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <ctime>
#include <map>
#include <memory>
#include <utility>

#include <fmt/chrono.h>
#include <fmt/format.h>

#include "app/evaluate/estimates.hpp"
#include "app/map/map_folder.hpp"
#include "app/result_json.hpp"
#include "app/study/folder_report.hpp"
#include "core/base/errors.hpp"
#include "core/base/files/files.hpp"
#include "core/base/files/output_folder.hpp"
#include "core/base/not_finite.hpp"
#include "core/base/text/csv.hpp"
#include "core/base/text/error_text.hpp"
#include "core/base/text/number_text.hpp"
#include "core/base/text/words.hpp"
#include "core/evaluate/evaluation_rows.hpp"
#include "core/records/evaluations/pose_errors_csv.hpp"
#include "core/records/studies/results_study_json.hpp"
#include "core/records/studies/results_table.hpp"
#include "core/records/studies/study_folder.hpp"
#include "core/records/studies/timings_jsonl.hpp"

namespace mapproof {
namespace {

namespace fs = std::filesystem;

struct EvaluateArguments {
  std::vector<std::string> ground_truths;
  std::vector<std::string> estimates;
  std::string out;
  std::string name = "evaluation";
  std::string title;
  std::string alignment = "rigid";
  double offset_s = 0.0;
  double largest_gap_s = 0.01;
  std::vector<std::string> spacings;
  bool all_pairs = false;
  std::string plane;  ///< Empty: errors are in space.
  std::string landmarks = "id";
  std::optional<double> gate_m;
  std::optional<std::string> templates;
  int jobs = 1;
};

/// "10m", "5s", "100f". @throws InvalidInput.
PairSpacing spacing_of(const std::string& text) {
  constexpr std::array kUnits = {std::pair('m', PairUnit::kMetres),
                                 std::pair('s', PairUnit::kSeconds),
                                 std::pair('f', PairUnit::kPoses)};
  for (const auto& [letter, unit] : kUnits)
    if (text.size() > 1 && text.back() == letter) {
      const std::string digits = text.substr(0, text.size() - 1);
      std::size_t used = 0;
      double length = kNaN;
      try {
        length = std::stod(digits, &used);
      } catch (const std::exception&) {
        used = 0;
      }
      const bool is_whole = unit != PairUnit::kPoses || length == std::floor(length);
      if (used == digits.size() && length > 0.0 && std::isfinite(length) && is_whole)
        return {.length = length, .unit = unit};
    }
  throw InvalidInput(fmt::format(
      "--relative: \"{}\": expected a length with its unit above 0: 10m, 5s or 100f (poses, whole)",
      printable(text)));
}

std::vector<PairSpacing> spacings_of(const EvaluateArguments& arguments,
                                     const std::vector<EvaluatedFile>& ground_truths) {
  std::vector<PairSpacing> spacings;
  for (const std::string& text : arguments.spacings) spacings.push_back(spacing_of(text));
  if (!spacings.empty()) {
    std::ranges::sort(spacings);
    const auto repeated = std::ranges::unique(spacings);
    spacings.erase(repeated.begin(), repeated.end());
    return spacings;
  }
  double shortest_m = HUGE_VAL;
  for (const EvaluatedFile& file : ground_truths)
    if (file.path) shortest_m = std::min(shortest_m, path_length(file.path->positions_m));
  if (shortest_m > 0.0 && std::isfinite(shortest_m)) return usual_spacings(shortest_m);
  return {};
}

/// Compares one estimate; what cannot be compared is warned of and lost.
class Comparison {
 public:
  Comparison(const EvaluateArguments& arguments, const std::vector<PairSpacing>& spacings,
             const Invocation& invocation)
      : arguments_(arguments), invocation_(invocation) {
    paths_ = {
        .association = {.offset_s = arguments.offset_s, .largest_gap_s = arguments.largest_gap_s},
        .alignment = *frame_alignment_named(arguments.alignment),
        .spacings = spacings,
        .pairs = arguments.all_pairs ? PairChoice::kAll : PairChoice::kConsecutive,
        .plane = plane_named(arguments.plane)};
  }

  EvaluatedRun run(const EstimateFile& estimate, const EvaluatedFile& ground_truth,
                   const fs::path& ground_truth_file) const {
    EvaluatedRun run = estimate.run;
    run.has_path = ground_truth.path.has_value();
    run.has_landmarks = ground_truth.landmarks.has_value();
    if (estimate.file.empty()) {
      warn(run.method, fmt::format("has no file of {}: lost", run.run));
      return run;
    }
    const EvaluatedFile file = read_evaluated_file(estimate.file);
    const bool shares = (file.path && run.has_path) || (file.landmarks && run.has_landmarks);
    if (!shares)
      throw IoError(
          estimate.file.string(),
          fmt::format("has neither a path nor landmarks that {} has", ground_truth_file.string()));
    run.has_path = run.has_path && file.path;
    run.has_landmarks = run.has_landmarks && file.landmarks;
    if (run.has_path) compare_paths(estimate, *ground_truth.path, *file.path, run);
    if (run.has_landmarks)
      compare_landmarks(estimate, *ground_truth.landmarks, *file.landmarks, run);
    return run;
  }

 private:
  void warn(const std::string& about, const std::string& what) const {
    invocation_.console.warning(about + ": " + what);
  }

  void compare_paths(const EstimateFile& estimate, const SpacePath& ground_truth,
                     const SpacePath& path, EvaluatedRun& run) const {
    try {
      run.path = evaluate_path(ground_truth, path, paths_);
    } catch (const InvalidInput& problem) {
      warn(estimate.file.string(), std::string(problem.what()) + ": lost");
      return;
    }
    if (run.path->associated_percent < kFewAssociated_percent)
      warn(estimate.file.string(),
           fmt::format("only {:.3g} % of the poses are associated; --largest-gap and --offset "
                       "decide",
                       run.path->associated_percent));
    if (run.path->poses.error_deg.size() == 0)
      invocation_.console.info(estimate.file.string() +
                               ": no relative errors: orientations are missing");
  }

  void compare_landmarks(const EstimateFile& estimate, const LandmarkPositions& ground_truth,
                         const LandmarkPositions& map, EvaluatedRun& run) const {
    LandmarkEvaluationOptions options{.association = arguments_.landmarks == "nearest"
                                                         ? LandmarkAssociation::kNearest
                                                         : LandmarkAssociation::kId,
                                      .alignment = paths_.alignment,
                                      .known = {},
                                      .gate_m = arguments_.gate_m};
    if (run.path) options.known = run.path->alignment;
    try {
      run.landmarks = evaluate_landmarks(ground_truth, map, options);
    } catch (const InvalidInput& problem) {
      const bool may_be_unnamed = options.association == LandmarkAssociation::kId;
      warn(estimate.file.string(),
           std::string(problem.what()) + ": lost" +
               (may_be_unnamed ? " (--landmarks nearest compares maps without common IDs)" : ""));
    }
  }

  const EvaluateArguments& arguments_;
  const Invocation& invocation_;
  PathEvaluationOptions paths_;
};

/// "the ground truth groundtruth.tum; each estimate is aligned by …".
std::string compared_words(const EvaluateArguments& arguments,
                           const std::vector<fs::path>& ground_truths) {
  constexpr std::array kWords = {
      std::pair("none", "as it came"),
      std::pair("rigid", "aligned by rotation and translation of least squares"),
      std::pair("similarity", "aligned by rotation, translation and scale of least squares"),
      std::pair("first-pose", "aligned by its first associated pose")};
  const std::string files =
      ground_truths.size() == 1
          ? "the ground truth " + ground_truths.front().filename().string()
          : fmt::format("the ground truth of each of {} sequences", ground_truths.size());
  return fmt::format("{}; each estimate is {}", files,
                     std::ranges::find(kWords, arguments.alignment, [](const auto& words) {
                       return std::string_view(words.first);
                     })->second);
}

std::string question_of(const EvaluateArguments& arguments, const std::vector<EvaluatedRun>& runs) {
  std::string text = "Errors against the ground truth.";
  if (std::ranges::any_of(runs, &EvaluatedRun::has_path))
    text += fmt::format(
        " Poses are associated with the nearest in time within {:g} s{}. ATE: the distance between "
        "associated positions{}. RPE: the translation that the motions between two poses differ "
        "by; {}. Drift: RPE in percent of the way.",
        arguments.largest_gap_s,
        arguments.offset_s == 0.0
            ? ""
            : fmt::format(", {:g} s added to times of estimates", arguments.offset_s),
        arguments.plane.empty() ? "" : ", in the plane " + arguments.plane + " alone",
        arguments.all_pairs ? "every pose begins a pair, if another one along the estimate is that "
                              "far away within 10 %"
                            : "pairs of poses follow each other along the estimate");
  if (std::ranges::any_of(runs, &EvaluatedRun::has_landmarks))
    text += fmt::format(" Landmarks are associated by {}.",
                        arguments.landmarks == "nearest" ? "position" : "ID");
  return text;
}

std::string landmarks_table(const LandmarkEvaluation& landmarks) {
  std::string text = "name,x_m,y_m,true_x_m,true_y_m\r\n";
  for (std::size_t i = 0; i < landmarks.names.size(); ++i) {
    const auto row = static_cast<Eigen::Index>(i);
    text += fmt::format("{},{},{},{},{}\r\n", csv_field(landmarks.names[i]),
                        landmarks.estimate_m(row, 0), landmarks.estimate_m(row, 1),
                        landmarks.ground_truth_m(row, 0), landmarks.ground_truth_m(row, 1));
  }
  return text;
}

/// @throws IoError unless the folder is new, empty, or holds an evaluation of that name.
void check_evaluation_folder(const fs::path& folder, const std::string& name) {
  std::error_code error;
  const fs::path head = folder / kStudyFile;
  if (!fs::exists(head, error)) return check_result_folder(folder, kStudyFile, "evaluation");
  refuse_links_out(folder);
  if (!is_results_study(folder) || parse_results_study(read_file(head), head.string()).name != name)
    throw IoError(folder.string(),
                  fmt::format("holds another study than \"{}\"; choose another --out", name));
}

void write_records(const ResultsStudy& study, const std::vector<EvaluatedRun>& runs,
                   const OutputFolder& out) {
  for (const char* folder : {"errors", "maps"}) out.remove(folder);
  out.write(kStudyFile, results_study_json(study));
  out.write(kResultsFile, results_csv(study.results.rows));
  for (const EvaluatedRun& run : runs) {
    if (run.path)
      out.write(fs::path("errors") / run.run / (run.method + ".csv"),
                pose_errors_csv(run.path->poses));
    if (run.landmarks)
      out.write(fs::path("maps") / fmt::format("{}-{}.csv", run.method, run.run),
                landmarks_table(*run.landmarks));
  }
}

/// "over 1 km" of an estimate that diverged, if some did not: else distances are that large.
std::string text_of(const std::vector<EvaluatedRun>& runs) {
  const bool has_great_errors = std::ranges::any_of(runs, [](const EvaluatedRun& run) {
    return (run.path && error_statistics(run.path->poses.error_m).rmse <= kGreatestError_m) ||
           (run.landmarks && run.landmarks->error_m.mean() <= kGreatestError_m);
  });
  const auto metres = [&](double error_m) {
    return has_great_errors ? error_text(error_m) : significant(error_m) + " m";
  };
  std::string text;
  for (const EvaluatedRun& run : runs) {
    text += fmt::format("{}, {}:", run.method, run.run);
    if (run.path) {
      const ErrorStatistics errors = error_statistics(run.path->poses.error_m);
      text += fmt::format(" ATE {} RMSE, {} mean, {} median, {} greatest; {}", metres(errors.rmse),
                          metres(errors.mean), metres(errors.median), metres(errors.maximum),
                          counted(static_cast<long long>(run.path->poses.size()), "pose"));
      if (run.path->alignment.scale != 1.0)
        text += fmt::format("; scale {}", significant(run.path->alignment.scale, 5));
    }
    if (run.landmarks)
      text += fmt::format("{} landmarks {} mean, {} greatest; {} of {} found, {} spurious",
                          run.path ? ";" : "", metres(run.landmarks->error_m.mean()),
                          metres(run.landmarks->error_m.maxCoeff()), run.landmarks->error_m.size(),
                          run.landmarks->error_m.size() + run.landmarks->missed,
                          run.landmarks->spurious);
    if (!run.path && !run.landmarks) text += " lost";
    text += "\n";
  }
  return text;
}

nlohmann::ordered_json statistics_json(const Eigen::VectorXd& errors) {
  const ErrorStatistics found = error_statistics(errors);
  return {{"rmse_m", found.rmse},
          {"mean_m", found.mean},
          {"median_m", found.median},
          {"max_m", found.maximum}};
}

nlohmann::ordered_json run_json(const EvaluatedRun& run) {
  nlohmann::ordered_json object{{"system", run.method}, {"run", run.run}};
  if (run.has_path) {
    object["path"] = nullptr;
    if (run.path) {
      const SpaceSimilarity& map = run.path->alignment;
      nlohmann::ordered_json path{{"poses", run.path->poses.size()},
                                  {"associated_percent", run.path->associated_percent},
                                  {"ate", statistics_json(run.path->poses.error_m)},
                                  {"scale", map.scale},
                                  {"relative", nlohmann::ordered_json::array()}};
      for (const RelativeErrors& errors : run.path->relative) {
        constexpr std::array kUnits = {"m", "s", "poses"};
        nlohmann::ordered_json relative{
            {"length", errors.spacing.length},
            {"unit", kUnits[static_cast<std::size_t>(errors.spacing.unit)]},
            {"pairs", errors.error_m.size()}};
        relative["rpe"] = statistics_json(errors.error_m);
        path["relative"].push_back(std::move(relative));
      }
      object["path"] = std::move(path);
    }
  }
  if (run.has_landmarks) {
    object["landmarks"] = nullptr;
    if (run.landmarks)
      object["landmarks"] = {{"found", run.landmarks->error_m.size()},
                             {"missed", run.landmarks->missed},
                             {"spurious", run.landmarks->spurious},
                             {"errors", statistics_json(run.landmarks->error_m)}};
  }
  return object;
}

void check(const EvaluateArguments& arguments) {
  if (!kPlainId.holds(arguments.name))
    throw InvalidInput(fmt::format("--name: expected {}", kPlainId.expected));
  if (arguments.gate_m && arguments.landmarks != "nearest")
    throw InvalidInput("--gate: only with --landmarks nearest");
  if (!std::isfinite(arguments.offset_s)) throw InvalidInput("--offset: expected seconds");
}

/// Notes the command that makes the study again where other studies have it.
void write_session(const EvaluateArguments& arguments, const Invocation& invocation,
                   std::chrono::system_clock::time_point start) {
  const std::chrono::duration<double> passed = std::chrono::system_clock::now() - start;
  const std::time_t started = std::chrono::system_clock::to_time_t(start);
  const Session session{.command = invocation.command,
                        .started_utc = fmt::format("{:%Y-%m-%dT%H:%M:%SZ}", fmt::gmtime(started)),
                        .host = invocation.disclosure.host(),
                        .jobs = arguments.jobs,
                        .seconds = std::max(passed.count(), 0.0),
                        .peak_memory_mib = {}};
  OutputFolder(arguments.out).write(kTimingsFile, timings_header() + session_line(session));
}

int evaluate(const EvaluateArguments& arguments, const Invocation& invocation) {
  const auto start = std::chrono::system_clock::now();
  check(arguments);
  const Templates page = load_templates(arguments.templates);
  check_evaluation_folder(arguments.out, arguments.name);
  const EvaluationPlan plan = plan_evaluation(arguments.ground_truths, arguments.estimates);
  std::vector<EvaluatedFile> ground_truths;
  for (const fs::path& file : plan.ground_truths)
    ground_truths.push_back(read_evaluated_file(file));
  const std::vector<PairSpacing> spacings = spacings_of(arguments, ground_truths);
  const Comparison comparison(arguments, spacings, invocation);
  std::vector<EvaluatedRun> runs;
  for (const EstimateFile& estimate : plan.estimates)
    runs.push_back(comparison.run(estimate, ground_truths[estimate.ground_truth],
                                  plan.ground_truths[estimate.ground_truth]));
  ResultsStudy study = evaluation_study(runs, spacings);
  study.name = arguments.name;
  study.title = arguments.title.empty() ? "Errors against the ground truth" : arguments.title;
  study.question = question_of(arguments, runs);
  study.compared_with = compared_words(arguments, plan.ground_truths);

  const LockedFolder folder(arguments.out);
  write_records(study, runs, folder.files());
  write_session(arguments, invocation, start);
  const FolderReport report = read_folder_report(arguments.out, std::nullopt, invocation.command);
  const fs::path path =
      write_report(report, {page, arguments.jobs, invocation.disclosure}, folder.lock());
  nlohmann::ordered_json object{{"study", arguments.out},
                                {"report", path.string()},
                                {"runs", nlohmann::ordered_json::array()}};
  for (const EvaluatedRun& run : runs) object["runs"].push_back(run_json(run));
  invocation.console.result(text_of(runs) + path.string() + "\n", object);
  const bool any =
      std::ranges::any_of(runs, [](const EvaluatedRun& run) { return run.path || run.landmarks; });
  return any ? kDone : kNo;
}

void add_comparison_options(CLI::App& app, EvaluateArguments& arguments) {
  app.add_option("--align", arguments.alignment,
                 "none; rigid: rotation and translation; similarity: with a scale; first-pose")
      ->transform(one_of({"none", "rigid", "similarity", "first-pose"}))
      ->capture_default_str();
  app.add_option("--offset", arguments.offset_s, "Added to the times of estimates [s]")
      ->check(finite_number())
      ->capture_default_str();
  app.add_option("--largest-gap", arguments.largest_gap_s,
                 "Poses farther apart in time are not associated [s]")
      ->check(not_negative())
      ->capture_default_str();
  app.add_option("--relative", arguments.spacings,
                 "Relative errors over these lengths: 1m,10m (way of the estimate), 5s, 100f "
                 "(poses); without: 1, 2 and 5 times powers of 10 m, as the ground truth allows")
      ->allow_extra_args(false)
      ->delimiter(',');
  app.add_flag("--all-pairs", arguments.all_pairs,
               "Relative errors from every pose, to the one that lies the length away within "
               "10 %; without: of pairs that follow each other");
  app.add_option("--plane", arguments.plane,
                 "Errors of trajectories in one plane alone: xy, xz or yz of the ground truth; the "
                 "alignment is in space")
      ->transform(one_of({"xy", "xz", "yz"}));
  app.add_option("--landmarks", arguments.landmarks,
                 "id: landmarks are associated by ID; nearest: by position alone")
      ->transform(one_of({"id", "nearest"}))
      ->capture_default_str();
  app.add_option("--gate", arguments.gate_m,
                 "With --landmarks nearest: landmarks farther apart are not associated [m]; "
                 "without: half the median distance between neighbours")
      ->check(above_zero());
}

}  // namespace

Action evaluate_command(CLI::App& app) {
  auto arguments = std::make_shared<EvaluateArguments>();
  app.description("Compare trajectories and maps of other systems with the ground truth");
  app.footer(
      "Examples:\n"
      "  mapproof evaluate --ground-truth gt.txt orb.txt vins.txt --out out\n"
      "  mapproof evaluate --ground-truth gt/ orb/ vins/ --align similarity --out out\n"
      "  mapproof evaluate --ground-truth gt.csv ours=run1.txt ours=run2.txt --relative 1m,10m,5s "
      "--out out\n"
      "  mapproof evaluate --ground-truth gt.txt orb.txt --plane xy --all-pairs --out out\n"
      "  mapproof evaluate --ground-truth landmarks.csv map.csv --landmarks nearest --out out\n\n"
      "Trajectories are TUM, KITTI, EuRoC (CSV) or g2o, in space, or CSV with t, x, y, heading;\n"
      "maps are CSV with name, x [m], y [m], or g2o. Several files of one system are its runs.\n"
      "With a folder of ground truths, estimates belong to the file whose name theirs begins "
      "with.\n"
      "The folder is a study: report, diff and nightly take it. The exit code is 1 if nothing\n"
      "could be compared.\n");
  app.add_option("ESTIMATE", arguments->estimates,
                 "Files or folders of estimates, SYSTEM=PATH to name the system")
      ->required();
  app.add_option("--ground-truth,--truth", arguments->ground_truths,
                 "File of the ground truth, or a folder with one file per sequence")
      ->required()
      ->allow_extra_args(false);
  add_out_option(app, arguments->out, "Folder for records, figures and report")->required();
  add_comparison_options(app, *arguments);
  app.add_option("--name", arguments->name,
                 "Of the study: begins the ids of figures, and names it in nightly runs")
      ->capture_default_str();
  app.add_option("--title", arguments->title, "Of the report");
  app.add_option("--templates", arguments->templates,
                 "Folder whose templates replace the embedded ones")
      ->check(names_folder());
  add_jobs_option(app, arguments->jobs);
  group_options(app, {{"Input", {"ESTIMATE", "--ground-truth"}},
                      {"Comparison",
                       {"--align", "--offset", "--largest-gap", "--relative", "--all-pairs",
                        "--plane", "--landmarks", "--gate"}},
                      {"Output", {"--name", "--title", "--templates"}}});
  return [arguments](const Invocation& invocation) { return evaluate(*arguments, invocation); };
}

}  // namespace mapproof
