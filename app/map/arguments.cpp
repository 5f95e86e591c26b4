#include "app/map/arguments.hpp"

#include <cmath>

#include <fmt/format.h>

#include "app/command_line.hpp"
#include "core/base/errors.hpp"
#include "core/base/files/input_file.hpp"
#include "core/base/text/words.hpp"
#include "core/missing/filled.hpp"

namespace mapproof {
namespace {

/// What is mapped, where to, and by which method.
void add_method_options(CLI::App& app, MapJob& job) {
  app.add_option("OBSERVATIONS", job.path, "File or folder")->required();
  add_out_option(app, job.out, "Folder for map, figure and report")->required();
  app.add_option(
      "--method", job.method,
      "The embedding method, see \"mapproof methods\". auto: the best one, judged without "
      "ground truth (default for up to 200 landmarks if it takes seconds, else isomap; pairs for "
      "range-bearing)");
  app.add_option("--parameter", job.parameter,
                 "The parameter, whatever the method, see \"mapproof methods\"")
      ->check(finite_number());
  app.add_option("-K,--neighbours", job.neighbours,
                 "Number of nearest neighbours (default: 6, or as many as there can be)")
      ->check(finite_number());
  app.add_option("--sigma2", job.variance,
                 "Variance of the Gaussian kernel (default: the median squared distance)")
      ->check(finite_number());
  app.add_option("--degree", job.degree, "Degree of the polynomial kernel (default: 2)")
      ->check(finite_number());
  exclude_one_another(app, {"--parameter", "--neighbours", "--sigma2", "--degree"});
  app.add_option("--references", job.references,
                 "Landmark ISOMAP and landmark MVU: number of reference landmarks, which determine the "
                 "others (default: 200 and 20; all if there are fewer)")
      ->check(CLI::Range(3, 100000));
  app.add_option("--stress-fall", job.stress_fall,
                 "SMACOF stops when a step reduces the stress by less than this share of it "
                 "(default: 1e-10; 0.01 with kNN weights, where stopping early makes better maps)")
      ->check(number_in(0.0, 1.0));
}

/// What was observed, and what is known of it.
void add_observation_options(CLI::App& app, MapJob& job) {
  app.add_option(
         "--sensor", job.sensor,
         "What the values are: visibility (0/1), bearing [rad], range [m], or range-bearing; "
         "needed for tables, except detections")
      ->transform(one_of({"visibility", "bearing", "range", "range-bearing"}));
  app.add_option(
         "--with", job.with,
         "Observations of the same landmarks by another sensor, for one joint map. Landmarks "
         "are matched by name; the steps may differ")
      ->take_all();
  app.add_option("--with-sensor", job.with_sensor, "The sensor of each --with")
      ->transform(one_of({"visibility", "bearing", "range"}))
      ->take_all();
  add_table_options(app, job.table);
  app.add_option("--anchors", job.anchors,
                 "Known positions of three or more landmarks: CSV with name, x [m], y [m]");
  app.add_option("--ground-truth,--truth", job.ground_truth,
                 "True positions, to compute errors: CSV as for --anchors");
  app.add_option("--steps", job.steps, "Use only the first N steps")->check(CLI::Range(1, 1000000));
  app.add_option(
         "--fit", job.fit,
         "How the affine map to the anchors is fitted. rigid: a map of range-bearing keeps its "
         "scale and shape")
      ->transform(one_of({"least-distances", "least-squares", "rigid"}))
      ->capture_default_str();
  app.add_flag("--drop-unseen", job.drop_unseen, "Leave out landmarks that were never observed");
  app.add_flag(
      "--only-seen-together", job.embedder.only_seen_together,
      "Visibility: no edge of the neighbour graph joins landmarks that were never seen together");
}

/// Missing data, sub-maps, ellipses.
void add_capability_options(CLI::App& app, MapJob& job) {
  app.add_option(
         "--missing", job.missing,
         "Strategy for missing data: pairwise-complete distances, entries filled in by PPCA or "
         "PCA, or distances of covisible landmarks only. auto: by the pattern of the missing data")
      ->transform(one_of(missing_strategies()))
      ->capture_default_str();
  app.add_option("--dimensions", job.dimensions,
                 "Dimensions of PPCA and PCA (default: 10, or one fewer than landmarks)")
      ->check(CLI::Range(1, 1000));
  app.add_option(
         "--submaps", job.submaps,
         "Map overlapping groups of at most N landmarks separately, and join them (N from 6 "
         "to 5000)")
      ->check(CLI::Range(6, 5000));
  app.add_option("--overlap", job.overlap,
                 "Share of each sub-map that it has in common with its neighbours (default: 0.5)")
      ->check(number_in(0.0, 0.8));
  app.add_option("--ellipses", job.ellipse_replicates,
                 "Draw the 95 % confidence ellipse of each landmark, from N bootstrap resamples of "
                 "the steps")
      ->expected(0, 1)
      ->default_str("200")
      ->check(CLI::Range(10, 10000));
}

/// Incremental maps, landmark IDs, templates.
void add_incremental_options(CLI::App& app, MapJob& job) {
  app.add_flag(
      "--incremental", job.incremental,
      "Read long CSV or detections while the file grows (-: standard input), and update map "
      "and figure until it ends, or until SIGINT or SIGTERM");
  app.add_option("--every", job.every,
                 "With --incremental: update after so many steps (100) or seconds (2s)")
      ->capture_default_str();
  app.add_flag(
      "--check-ids", job.check_ids,
      "Range and bearing: report landmark IDs that contradict the others, or the known positions");
  app.add_flag("--repair-ids", job.repair_ids, "Correct these IDs before mapping");
  app.add_flag("--find-moved", job.find_moved,
               "Range and bearing: report landmarks that moved, and map both positions. With "
               "--incremental, as soon as a move is significant");
  app.add_option(
         "--uncertain-ids", job.uncertain_ids,
         "Landmark IDs that may be confused with one another, a,b,...: their data association "
         "is estimated together with the map, as that of the landmark ? in long CSV")
      ->allow_extra_args(false)
      ->delimiter(',');
  app.add_option("--templates", job.templates, "Folder whose templates replace the embedded ones")
      ->check(names_folder());
}

}  // namespace

bool MapJob::chooses_method() const { return lower_case(method) == "auto"; }

bool MapJob::may_choose_method() const {
  return method.empty() && !is_range_bearing() && !parameter && !neighbours && !variance &&
         !degree && with.empty() && submaps == 0 && !incremental && uncertain_ids.empty();
}

AffineFit MapJob::affine_fit() const {
  return fit == "least-squares" ? AffineFit::kLeastSquares : AffineFit::kLeastDistances;
}

TableFormat MapJob::table_format() const {
  TableFormat format = table.format();
  format.columns = columns;
  return format;
}

std::vector<std::string> missing_strategies() {
  return {std::string(name(Filling::kPairwiseComplete)), std::string(name(Filling::kPpca)),
          std::string(name(Filling::kPca)), "covisible", "auto"};
}

void add_map_options(CLI::App& app, MapJob& job) {
  add_method_options(app, job);
  add_observation_options(app, job);
  add_capability_options(app, job);
  add_incremental_options(app, job);
  app.add_flag("--force", job.force, "Replace another map in the folder");
  add_jobs_option(app, job.jobs);
  group_options(
      app, {{"Input",
             {"OBSERVATIONS", "--sensor", "--with", "--with-sensor", "--steps", "--drop-unseen"}},
            {"Method",
             {"--method", "--parameter", "--neighbours", "--sigma2", "--degree", "--references",
              "--stress-fall",
              "--only-seen-together", "--submaps", "--overlap"}},
            {"Known positions", {"--anchors", "--ground-truth", "--fit"}},
            {"Missing data", {"--missing", "--dimensions"}},
            {"Landmark IDs", {"--check-ids", "--repair-ids", "--find-moved", "--uncertain-ids"}},
            {"Files that grow", {"--incremental", "--every"}},
            {"Output", {"--ellipses", "--templates", "--force"}}});
  for (const char* file : {"--anchors", "--ground-truth", "--with"})
    app.get_option(file)->type_name("FILE");
}

}  // namespace mapproof
