#include <memory>

#include <fmt/format.h>

#include "app/commands.hpp"
#include "app/input_streams.hpp"
#include "app/map/arguments.hpp"
#include "app/map/incremental_map.hpp"
#include "app/map/incremental_options.hpp"
#include "app/map/incremental_outputs.hpp"
#include "app/map/incremental_pairs.hpp"
#include "app/map/incremental_values.hpp"
#include "app/map/map_folder.hpp"
#include "app/map/map_json.hpp"
#include "app/map/outputs.hpp"
#include "core/base/input_file.hpp"
#include "render/figures/status_words.hpp"

namespace mapproof {
namespace {

int follow_file(const MapArguments& arguments, const Templates& page,
                const Invocation& invocation) {
  require_followable(arguments.input, arguments.options);
  const MapOptions& options = arguments.options;
  const std::optional<Sensor> sensor = sensor_named(arguments.input.kind);
  FollowOrder order{.path = arguments.input.path,
                    .table = {.source = {},
                              .sensor = sensor.value_or(Sensor::kRange),
                              .unit = arguments.input.unit,
                              .options = {.setting = options.setting, .embedder = {}},
                              .anchors = read_points(arguments.anchors),
                              .truth = read_points(arguments.truth),
                              .fit = options.fit,
                              .rigid = arguments.input.rigid,
                              .find_moved = arguments.input.labels.find_moved},
                    .follower = sensor ? value_follower : pair_follower,
                    .every = follow_interval(arguments.every)};
  order.table.options.embedder.only_seen_together = options.only_seen_together;
  const MapResult map = follow_map(order, invocation.console,
                                   followed_outputs({.out = arguments.out,
                                                     .observations = arguments.input.path,
                                                     .command = invocation.command,
                                                     .page = page}));
  return report_followed(map, arguments.out, invocation);
}

int make_map(MapArguments arguments, const Invocation& invocation) {
  const Templates page = load_templates(arguments.templates);
  check_map_folder(arguments.out);
  std::vector<std::string> inputs = {arguments.input.path, arguments.anchors, arguments.truth};
  inputs.insert(inputs.end(), arguments.with.begin(), arguments.with.end());
  refuse_shared_streams(inputs);
  settle(arguments);
  if (arguments.follow) return follow_file(arguments, page, invocation);
  const bool any_method = arguments.options.choose;
  arguments.options.begin = [&](const MapRecord& begun) {
    check_may_become(arguments.out, begun, any_method);
  };
  MapResult map = map_input(arguments.input, read_points(arguments.anchors),
                            read_points(arguments.truth), arguments.options);
  for (const auto& [what, value] : map.read)
    invocation.console.detail(
        fmt::format("{}: {}: {}", input_name(arguments.input.path), what, value));
  for (std::string& warning : frame_warnings(map.record)) map.warnings.push_back(warning);
  for (const std::string& remark : map.remarks) invocation.console.info(remark);
  for (const std::string& warning : map.warnings) invocation.console.warning(warning);
  for (const Status& status : map.record.statuses)
    invocation.console.warning(fmt::format("{}: {}", name(status.code), status_words(status)));
  write_outputs(arguments, map, page, invocation.command);
  invocation.console.result(map_text(map, arguments.out), map_json(map, arguments.out));
  return map.record.estimate.array().isNaN().all() ? kNo : kDone;
}

}  // namespace

Action map_command(CLI::App& app) {
  auto arguments = std::make_shared<MapArguments>();
  app.description("Map your own observations");
  app.footer(
      "Examples:\n"
      "  mapproof map bearings.csv --sensor bearing --anchors anchors.csv --out out/map\n"
      "  mapproof map seen.csv --sensor visibility --method lpca --out out/shape\n"
      "  mapproof map MRCLAM_Dataset2 --method isomap -K 5 --out out/mrclam\n"
      "  mapproof map MRCLAM_Dataset2 --sensor range-bearing --out out/pairs\n"
      "  mapproof map seen.csv --sensor visibility --with bearings.csv --with-sensor bearing --out "
      "out/joint\n\n"
      "OBSERVATIONS is one of\n"
      "  wide CSV: one row per landmark, one column per step; an empty cell or nan is missing\n"
      "  long CSV: the columns step, landmark, value\n"
      "  detections: the columns step or time, landmark, range, bearing\n"
      "  JSON: mapproof.observations or mapproof.detections\n"
      "  a folder of MRCLAM files\n"
      "It may be compressed by gzip or xz. A pipe or standard input (-) serves wherever a file "
      "does.\n"
      "Bearings are relative to the robot's heading, counter-clockwise, in radians.\n"
      "Range and bearing of one scan measure distances: their map is in metres without anchors.\n"
      "The exit code is 1 if there is no map; the report says why.\n");
  app.add_option("OBSERVATIONS", arguments->input.path, "File or folder")->required();
  add_out_option(app, arguments->out, "Folder for map, figure and report")->required();
  app.add_option(
      "--method", arguments->method,
      "The embedding method, see \"mapproof methods\" (default: isomap; pairs for range-bearing). "
      "auto: the best one, judged without ground truth");
  CLI::Option_group* parameter =
      app.add_option_group("Parameter of the method", "One of these, see \"mapproof methods\"");
  parameter->require_option(0, 1);
  parameter->add_option("--parameter", arguments->parameter, "The parameter, whatever the method");
  parameter->add_option("-K,--neighbours", arguments->neighbours,
                        "Number of nearest neighbours (default: 6, or what there can be)");
  parameter->add_option("--sigma2", arguments->variance,
                        "Variance of the Gaussian kernel (default: the median squared distance)");
  parameter->add_option("--degree", arguments->degree,
                        "Degree of the polynomial kernel (default: 2)");
  app.add_option(
         "--sensor", arguments->input.kind,
         "What the values are: visibility (0/1), bearing [rad], range [m], or range-bearing; "
         "needed for CSV but detections")
      ->check(CLI::IsMember({"visibility", "bearing", "range", "range-bearing"}));
  app.add_option(
         "--with", arguments->with,
         "Observations of the same landmarks by another sensor, for one joint map. Landmarks "
         "are matched by name; the steps may differ")
      ->take_all();
  app.add_option("--with-sensor", arguments->with_kind, "The sensor of each --with")
      ->check(CLI::IsMember({"visibility", "bearing", "range"}))
      ->take_all();
  app.add_flag("--degrees", arguments->degrees, "Bearings in CSV files are in degrees");
  app.add_option("--layout", arguments->layout, "Layout of a CSV file")
      ->check(CLI::IsMember({"auto", "wide", "long"}))
      ->capture_default_str();
  app.add_option("--anchors", arguments->anchors,
                 "Known positions of three or more landmarks: CSV with name, x [m], y [m]");
  app.add_option("--ground-truth,--truth", arguments->truth,
                 "True positions, to compute errors: CSV as for --anchors");
  app.add_option("--steps", arguments->options.steps, "Use only the first N steps")
      ->check(CLI::Range(1, 1000000));
  app.add_option(
         "--fit", arguments->fit,
         "How to fit the map to the anchors by an affine map. rigid: a map of range-bearing "
         "keeps its scale and shape")
      ->check(CLI::IsMember({"least-distances", "least-squares", "rigid"}))
      ->capture_default_str();
  app.add_flag("--drop-unseen", arguments->options.drop_unseen,
               "Leave out landmarks that were never observed");
  app.add_flag("--only-seen-together", arguments->options.only_seen_together,
               "Visibility: no edge of the graph joins landmarks that were never seen together");
  app.add_option(
         "--missing", arguments->options.missing.way,
         "Strategy for missing data: distances over common steps, entries filled in by PPCA "
         "or PCA, or distances of covisible landmarks alone. auto: by the pattern of what "
         "is missing")
      ->check(CLI::IsMember(missing_ways()))
      ->capture_default_str();
  app.add_option("--dimensions", arguments->options.missing.dimensions,
                 "Dimensions of PPCA and PCA (default: 10, or one fewer than landmarks)")
      ->check(CLI::Range(1, 1000));
  app.add_option("--submaps", arguments->options.submaps,
                 "Map overlapping groups of at most N landmarks separately, and join them")
      ->check(CLI::Range(6, 5000));
  app.add_option("--overlap", arguments->options.overlap,
                 "Share of each sub-map that it has from its neighbours (default: 0.5)")
      ->check(CLI::Range(0.0, 0.8));
  app.add_option("--ellipses", arguments->options.ellipse_replicates,
                 "Draw the 95 % confidence ellipse of each landmark, from N bootstrap resamples of "
                 "the steps (default: 200)")
      ->expected(0, 1)
      ->default_str("200")
      ->check(CLI::Range(10, 10000));
  app.add_flag(
      "--follow", arguments->follow,
      "Read long CSV or detections while the file grows (-: standard input), and update map "
      "and figure until it ends, or until SIGINT or SIGTERM. Not with --method auto, "
      "--ellipses, --missing, --submaps, --steps, --drop-unseen, --check-ids or "
      "--repair-ids");
  app.add_option("--every", arguments->every,
                 "With --follow: update after so many steps (100) or seconds (2s)")
      ->capture_default_str();
  app.add_flag(
      "--check-ids", arguments->input.labels.check,
      "Range and bearing: report landmark IDs that contradict the others, or the known positions");
  app.add_flag("--repair-ids", arguments->input.labels.repair, "Correct these IDs before mapping");
  app.add_flag("--find-moved", arguments->input.labels.find_moved,
               "Range and bearing: report landmarks that moved, and map both positions. With "
               "--follow, as soon as a move is significant");
  app.add_option(
         "--uncertain-ids", arguments->input.unsure,
         "Landmark IDs that may be confused with one another, a,b,...: their data association "
         "is estimated together with the map, as that of the landmark ? in long CSV")
      ->delimiter(',');
  app.add_option("--templates", arguments->templates,
                 "Folder whose templates replace the embedded ones")
      ->check(names_folder());
  return [arguments](const Invocation& invocation) { return make_map(*arguments, invocation); };
}

}  // namespace mapproof
