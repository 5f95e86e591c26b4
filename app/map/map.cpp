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
      "OBSERVATIONS: wide CSV (a row a landmark, a column a step; empty or nan: missing), long "
      "CSV\n"
      "(step, landmark, value), detections (step or time, landmark, range, bearing), JSON of\n"
      "mapproof.observations or mapproof.detections, or a folder of MRCLAM files. Files may be\n"
      "packed by gzip or xz; here as in the options a pipe of the shell does, too, or standard "
      "input (-).\n"
      "Bearings are relative to the robot's heading, counter-clockwise, in radians.\n"
      "Range and bearing seen together measure distances: their map is in metres without anchors.\n"
      "Exit code 1 if no map came out; the report then says why.\n");
  app.add_option("OBSERVATIONS", arguments->input.path, "File or folder")->required();
  add_out_option(app, arguments->out, "Folder for map, figure and report")->required();
  app.add_option(
      "--method", arguments->method,
      "See \"mapproof methods\" (default: isomap), or auto: the best by what can be told "
      "without the truth; of range-bearing: pairs");
  CLI::Option_group* parameter =
      app.add_option_group("Parameter of the method", "One of these, see \"mapproof methods\"");
  parameter->require_option(0, 1);
  parameter->add_option("--parameter", arguments->parameter, "Of whatever method");
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
  app.add_option("--with", arguments->with,
                 "Observations of the same landmarks by another kind of sensor, for one map of "
                 "both: landmarks are matched by name, steps need not be the same")
      ->take_all();
  app.add_option("--with-sensor", arguments->with_kind, "What they are, for each --with")
      ->check(CLI::IsMember({"visibility", "bearing", "range"}))
      ->take_all();
  app.add_flag("--degrees", arguments->degrees, "Bearings in a CSV file are in degrees");
  app.add_option("--layout", arguments->layout, "Of a CSV file")
      ->check(CLI::IsMember({"auto", "wide", "long"}))
      ->capture_default_str();
  app.add_option("--anchors", arguments->anchors,
                 "Known positions of 3 landmarks or more: CSV of name, x [m], y [m]");
  app.add_option("--ground-truth,--truth", arguments->truth,
                 "True positions, for the errors: as --anchors");
  app.add_option("--steps", arguments->options.steps, "Use the first so many observations alone")
      ->check(CLI::Range(1, 1000000));
  app.add_option("--fit", arguments->fit,
                 "How the affine map to the anchors is fitted; rigid: a map of range-bearing is "
                 "turned and shifted alone")
      ->check(CLI::IsMember({"least-distances", "least-squares", "rigid"}))
      ->capture_default_str();
  app.add_flag("--drop-unseen", arguments->options.drop_unseen,
               "Leave landmarks out that were never observed");
  app.add_flag("--only-seen-together", arguments->options.only_seen_together,
               "Visibility: no graph edge between landmarks never seen together");
  app.add_option("--missing", arguments->options.missing.way,
                 "Missing entries: distances over common steps, filled in by PPCA or PCA, or of "
                 "covisible landmarks alone; auto: as the pattern of the gaps advises")
      ->check(CLI::IsMember(missing_ways()))
      ->capture_default_str();
  app.add_option("--dimensions", arguments->options.missing.dimensions,
                 "Of PPCA and PCA (default: 10, or one fewer than landmarks)")
      ->check(CLI::Range(1, 1000));
  app.add_option("--submaps", arguments->options.submaps,
                 "Map overlapping groups of at most so many landmarks apart, and join them")
      ->check(CLI::Range(6, 5000));
  app.add_option("--overlap", arguments->options.overlap,
                 "Share of each sub-map that it borrows from its neighbours (default: 0.5)")
      ->check(CLI::Range(0.0, 0.8));
  app.add_option("--ellipses", arguments->options.ellipse_replicates,
                 "Draw each landmark's 95 % ellipse, from so many maps of steps drawn anew "
                 "(default: 200)")
      ->expected(0, 1)
      ->default_str("200")
      ->check(CLI::Range(10, 10000));
  app.add_flag("--follow", arguments->follow,
               "Follow long CSV or detections as they grow (-: standard input; packed or not) and "
               "write map and figure again and again, to their end, SIGINT or SIGTERM; not with "
               "--method auto, --ellipses, --missing, --submaps, --steps, --drop-unseen, "
               "--check-ids or --repair-ids");
  app.add_option("--every", arguments->every,
                 "With --follow: after so many steps (100) or seconds (2s)")
      ->capture_default_str();
  app.add_flag(
      "--check-ids", arguments->input.labels.check,
      "Detections of range and bearing: name labels that contradict the others, or the places "
      "that anchors, truth or survey tell");
  app.add_flag("--repair-ids", arguments->input.labels.repair, "And correct them before mapping");
  app.add_flag("--find-moved", arguments->input.labels.find_moved,
               "Detections of range and bearing: name landmarks that moved, map both places; with "
               "--follow, as soon as it shows");
  app.add_option("--uncertain-ids", arguments->input.unsure,
                 "Labels that are confused with one another, a,b,...: whose their readings are is "
                 "estimated together with the map (as of readings under the label ? in long CSV)")
      ->delimiter(',');
  app.add_option("--templates", arguments->templates,
                 "Folder whose templates replace the embedded ones")
      ->check(names_folder());
  return [arguments](const Invocation& invocation) { return make_map(*arguments, invocation); };
}

}  // namespace mapproof
