#include <algorithm>
#include <cmath>
#include <map>
#include <memory>

#include <fmt/format.h>

#include "app/build_facts.hpp"
#include "app/commands/verbs.hpp"
#include "app/follow_map.hpp"
#include "app/followable.hpp"
#include "app/followed_outputs.hpp"
#include "app/map_folder.hpp"
#include "app/map_words.hpp"
#include "app/own_input.hpp"
#include "app/result_json.hpp"
#include "core/base/errors.hpp"
#include "core/base/files.hpp"
#include "core/base/words.hpp"
#include "core/records/map_files.hpp"
#include "render/figures/map.hpp"
#include "render/figures/map_ellipses.hpp"
#include "render/figures/score_words.hpp"
#include "render/figures/submaps.hpp"
#include "render/output/write_figure.hpp"
#include "reports/html/report_html.hpp"
#include "reports/sections/certainty_section.hpp"
#include "reports/sections/map_report.hpp"
#include "reports/sections/study_figures.hpp"
#include "reports/tables/write_tables.hpp"

namespace mapproof {
namespace {

namespace fs = std::filesystem;

struct Arguments {
  std::string out;
  std::vector<std::string> with;       ///< Files of other sensors,
  std::vector<std::string> with_kind;  ///< and what each holds.
  std::string method;                  ///< Empty: isomap, or pairs of range and bearing.
  OwnInput input;
  std::string layout = "auto";
  bool degrees = false;
  std::string anchors;
  std::string truth;
  std::string fit = "least-distances";
  std::optional<double> parameter;  ///< One of these four.
  std::optional<double> neighbours;
  std::optional<double> variance;
  std::optional<double> degree;
  std::optional<std::string> templates;
  bool follow = false;
  std::string every = "1s";
  OwnMapOptions options;
};

/// The option that the parameter was given by, and its value; none: the usual value is taken.
struct GivenParameter {
  std::string_view option;
  double value;
};

/// An option for the parameter of a name, as that of the other methods: "--sigma2".
struct ParameterOption {
  std::string_view symbol;
  std::string_view option;
  std::optional<double> Arguments::*value;
};

constexpr ParameterOption kParameterOptions[] = {{"K", "-K", &Arguments::neighbours},
                                                 {"sigma2", "--sigma2", &Arguments::variance},
                                                 {"d", "--degree", &Arguments::degree}};

/// @throws InvalidInput for an option of another method's parameter.
std::optional<GivenParameter> given_parameter(const Arguments& arguments,
                                              const MethodInfo& method) {
  std::optional<GivenParameter> given;
  if (arguments.parameter) given = {"--parameter", *arguments.parameter};
  std::string_view usual;
  for (const ParameterOption& option : kParameterOptions)
    if (method.parameter && method.parameter->symbol == option.symbol) usual = option.option;
  for (const ParameterOption& option : kParameterOptions) {
    const std::optional<double>& value = arguments.*option.value;
    if (!value) continue;
    if (method.parameter && option.option != usual)
      throw InvalidInput(fmt::format("{}: the method {} has the parameter {}; did you mean {}?",
                                     option.option, method.name, method.parameter->shown, usual));
    given = {option.option, *value};
  }
  if (given && !method.parameter)
    throw InvalidInput(fmt::format("{}: the method {} has none", given->option, method.name));
  return given;
}

/// The way that range and bearing are mapped has no parameter and no use for other kinds.
void require_pairs(const Arguments& arguments) {
  const bool of_both = arguments.input.kind == kRangeBearing;
  if (of_both && !arguments.method.empty() && arguments.method != kPairs)
    throw InvalidInput(fmt::format(
        "--method {}: range and bearing together are mapped by pairs; for others say --kind range, "
        "bearing or visibility",
        printable(arguments.method)));
  if (!of_both && arguments.method == kPairs)
    throw InvalidInput("--method pairs: it maps observations of --kind range-bearing");
  if (of_both &&
      (arguments.parameter || arguments.neighbours || arguments.variance || arguments.degree))
    throw InvalidInput("the method pairs has no parameter");
  if (of_both && arguments.options.missing.way != MissingChoice().way)
    throw InvalidInput("--missing: pairs that were not measured are not filled in");
  if (of_both && arguments.options.submaps > 0)
    throw InvalidInput("--submaps: a map of pairs is made as a whole");
  if (arguments.options.overlap && arguments.options.submaps == 0)
    throw InvalidInput("--overlap: it is of sub-maps; add --submaps SIZE");
  if (!of_both && arguments.input.rigid)
    throw InvalidInput("--fit rigid: only a map of range and bearing has a scale of its own");
}

/// Fills in the other sensors' files. @throws InvalidInput for what does not go with them.
void take_others(Arguments& arguments) {
  if (arguments.with.size() != arguments.with_kind.size())
    throw InvalidInput("--with: each file needs a --with-kind of its own");
  for (std::size_t k = 0; k < arguments.with.size(); ++k)
    arguments.input.others.push_back({arguments.with[k], arguments.with_kind[k]});
  if (!arguments.input.unsure.empty() &&
      (arguments.follow || !arguments.with.empty() || arguments.input.kind == kRangeBearing))
    throw InvalidInput(
        "--labels-unsure: of one kind of value that every landmark has at every step; not with "
        "--follow, --with or range-bearing (see --check-labels)");
  if (arguments.with.empty()) return;
  const OwnMapOptions& options = arguments.options;
  if (arguments.input.kind == kRangeBearing)
    throw InvalidInput(
        "--with: range and bearing together are mapped by pairs; name one of them by --kind");
  if (options.choose || options.submaps > 0 || options.ellipse_replicates > 0 ||
      options.missing.way != MissingChoice().way || arguments.follow ||
      arguments.input.labels.asked())
    throw InvalidInput(
        "--with: not with --method auto, --submaps, --ellipses, --missing, --follow or labels that "
        "are checked");
}

/// The method, and its parameter if one was given.
MethodSetting chosen_setting(const Arguments& arguments) {
  if (arguments.options.submaps > 0 &&
      (arguments.options.choose || arguments.options.ellipse_replicates > 0))
    throw InvalidInput("--submaps: not with --method auto or --ellipses");
  if (arguments.options.choose) {
    if (arguments.parameter || arguments.neighbours || arguments.variance || arguments.degree)
      throw InvalidInput("--method auto chooses the parameter, too; leave it out");
    return {Method::kIsomap, std::nullopt};
  }
  const std::string name = arguments.method.empty() ? "isomap" : lower_case(arguments.method);
  const std::optional<Method> method = method_named(name);
  if (!method)
    throw InvalidInput(fmt::format("--method: unknown method \"{}\"; did you mean \"{}\"?",
                                   printable(arguments.method),
                                   nearest_method_name(arguments.method)));
  const std::optional<GivenParameter> given = given_parameter(arguments, info(*method));
  if (!given) return {*method, std::nullopt};
  const ParameterInfo& parameter = *info(*method).parameter;
  if (!(given->value >= parameter.minimum && given->value <= parameter.maximum) ||
      (parameter.integer && given->value != std::floor(given->value)))
    throw InvalidInput(fmt::format(
        "{}: {} = {:g} is not {} from {:g} to {:g}", given->option, parameter.shown, given->value,
        parameter.integer ? "an integer" : "a number", parameter.minimum, parameter.maximum));
  return {*method, given->value};
}

std::optional<NamedPointsFile> read_points(const std::string& path) {
  if (path.empty()) return std::nullopt;
  return NamedPointsFile{.path = path, .points = read_landmarks(path)};
}

std::vector<std::pair<std::string, std::string>> facts(const Arguments& arguments,
                                                       const OwnMap& map) {
  const MapRecord& record = map.record;
  std::vector<std::pair<std::string, std::string>> items = {{"Observations", arguments.input.path},
                                                            {"Sensor", observed_words(map)}};
  items.insert(items.end(), map.read.begin(), map.read.end());
  items.emplace_back("Method", method_words(map));
  if (record.anchors.empty()) {
    items.emplace_back("Anchors", "none");
  } else {
    std::string names;
    for (const Eigen::Index row : record.anchors)
      names += (names.empty() ? "" : ", ") + record.names[static_cast<std::size_t>(row)];
    items.emplace_back(
        "Anchors",
        names + (arguments.anchors.empty() ? " (the furthest out along the diagonals)" : ""));
    items.emplace_back(arguments.input.rigid ? "Fit to the anchors" : "Affine fit to the anchors",
                       arguments.fit);
  }
  return items;
}

nlohmann::ordered_json landmark_json(const OwnMap& map, Eigen::Index i) {
  const MapRecord& record = map.record;
  const std::string unit = record.frame == Frame::kTruth ? "_m" : "";
  nlohmann::ordered_json landmark{{"name", record.names[static_cast<std::size_t>(i)]},
                                  {"x" + unit, number_or_null(record.estimate(i, 0))},
                                  {"y" + unit, number_or_null(record.estimate(i, 1))}};
  if (!map.certainty) return landmark;
  landmark["ellipse"] = nullptr;
  if (const std::optional<Ellipse> ellipse = confidence_ellipse(*map.certainty, i))
    landmark["ellipse"] = {
        {"a" + unit, ellipse->a}, {"b" + unit, ellipse->b}, {"turn_rad", ellipse->turn_rad}};
  return landmark;
}

nlohmann::ordered_json map_result(const OwnMap& map, const fs::path& out) {
  const MapRecord& record = map.record;
  nlohmann::ordered_json object{
      {"sensor", record.of_pairs ? kRangeBearing
                 : map.mixed     ? "mixed"
                                 : name(record.sensor)},
      {"method", record.of_pairs ? kPairs : info(record.setting.method).name},
      {"parameter", parameter_json(record.setting)},
      {"steps", record.step},
      {"frame", name(record.frame)},
      {"score", nullptr},
      {"landmarks", nlohmann::ordered_json::array()},
      {"statuses", nlohmann::ordered_json::array()},
      {"labels", nlohmann::ordered_json::array()},
      {"remarks", map.remarks},
      {"warnings", map.warnings},
      {"map", (out / kMapFile).string()},
      {"report", (out / "report.html").string()}};
  if (record.score)
    object["score"] = {
        {"mpe_m", number_or_null(record.score->mpe_m)},
        {"moe_percent", number_or_null(record.score->moe_percent)},
        {"mpe_all_fitted_m", number_or_null(record.score->mpe_all_fitted_m)},
        {"moe_unmirrored_percent", number_or_null(record.score->moe_unmirrored_percent)}};
  for (Eigen::Index i = 0; i < record.estimate.rows(); ++i)
    object["landmarks"].push_back(landmark_json(map, i));
  for (const LabelFact& fact : map.labels)
    object["labels"].push_back({{"what", fact.what},
                                {"first", fact.first},
                                {"second", fact.second},
                                {"found", fact.sentence},
                                {"before_m", number_or_null(fact.before_m)},
                                {"after_m", number_or_null(fact.after_m)},
                                {"repaired", fact.repaired}});
  for (const Status& status : record.statuses)
    object["statuses"].push_back({{"code", name(status.code)}, {"detail", status.detail}});
  if (map.choice) object["choice"] = choice_json(*map.choice);
  if (map.mixed) object["mixed"] = mixed_json(*map.mixed);
  return object;
}

std::string map_text(const OwnMap& map, const fs::path& out) {
  const MapRecord& record = map.record;
  std::string text =
      fmt::format("{}, {}, {} steps", method_words(map), observed_words(map), record.step);
  if (record.score)
    if (const std::string score = score_words(*record.score); !score.empty()) text += ": " + score;
  return text + "\n" + (out / "report.html").string() + "\n";
}

void write_outputs(const Arguments& arguments, const OwnMap& map, const Templates& page,
                   const Invocation& invocation) {
  std::vector<Figure> figures = {map_figure(map.record, "map", what_words(map))};
  if (map.joined) figures.push_back(submaps_figure(*map.joined, map.record.names, "submaps"));
  if (map.mixed)
    if (std::optional<Figure> figure = mixed_figure(*map.mixed))
      figures.push_back(std::move(*figure));
  std::vector<Section> sections;
  if (map.mixed) sections.push_back(mixed_section(*map.mixed));
  if (map.choice) sections.push_back(choice_section(*map.choice));
  if (map.certainty) {
    add_ellipses(map.record, *map.certainty, figures.front());
    sections.push_back(certainty_section(map.record, *map.certainty));
  }
  std::vector<FigureBlock> more;
  for (std::size_t k = 1; k < figures.size(); ++k) more.push_back(figure_block(figures[k]));
  const Report report =
      map_report({.record = map.record,
                  .title = "Map of " + fs::path(arguments.input.path).filename().string(),
                  .facts = facts(arguments, map),
                  .remarks = map.remarks,
                  .warnings = map.warnings,
                  .figure = figure_block(figures.front()),
                  .more_figures = std::move(more),
                  .provenance = build_provenance(),
                  .command = invocation.command,
                  .what = what_words(map),
                  .more = std::move(sections)});
  const MapFolder folder(arguments.out, map.record);
  const fs::path& out = folder.path();
  // The file that marks the folder as a map's comes first: a killed command can then be repeated.
  write_file(out / kMapFile,
             map_json(map.record, map.certainty,
                      map.mixed ? std::optional(map.mixed->sensors) : std::nullopt));
  write_file(out / "map.csv", map_csv(map.record, map.certainty));
  for (const char* id : {"submaps", "sensors"})  // of an earlier map in this folder
    if (std::ranges::find(figures, id, &Figure::id) == figures.end())
      for (const char* ending : {".svg", ".png", ".pdf", ".figure.json"})
        fs::remove(out / "figures" / (std::string(id) + ending));
  if (map.estimated)
    write_file(out / "labels.csv", labels_csv(*map.estimated));
  else
    fs::remove(out / "labels.csv");
  std::map<std::string, std::string> drawn;
  for (const Figure& figure : figures)
    drawn[figure.id] = write_figure(figure, report_theme(), out / "figures");
  write_tables(report, out / "tables");
  const std::string html = report_html(report, page, [&](const std::string& id) {
    const auto found = drawn.find(id);
    return found == drawn.end() ? std::string() : found->second;
  });
  write_file(out / "report.html", html);
}

int follow_file(const Arguments& arguments, const Templates& page, const Invocation& invocation) {
  require_followable(arguments.input, arguments.options);
  const OwnMapOptions& options = arguments.options;
  FollowOrder order{.path = arguments.input.path,
                    .table = {.source = {},
                              .sensor = sensor_named(arguments.input.kind),
                              .unit = arguments.input.unit,
                              .options = {.setting = options.setting, .embedder = {}},
                              .anchors = read_points(arguments.anchors),
                              .truth = read_points(arguments.truth),
                              .fit = options.fit,
                              .rigid = arguments.input.rigid,
                              .find_moved = arguments.input.labels.find_moved},
                    .every = follow_interval(arguments.every)};
  order.table.options.embedder.only_seen_together = options.only_seen_together;
  const OwnMap map = follow_map(order, invocation.console,
                                followed_outputs({.out = arguments.out,
                                                  .observations = arguments.input.path,
                                                  .command = invocation.command,
                                                  .page = page}));
  for (const std::string& remark : map.remarks) invocation.console.warning(remark);
  for (const Status& status : map.record.statuses)
    invocation.console.warning(fmt::format("{}: {}", name(status.code), status.detail));
  invocation.console.result(map_text(map, arguments.out), map_result(map, arguments.out));
  return map.record.estimate.array().isNaN().all() ? kNo : kDone;
}

int make_map(Arguments arguments, const Invocation& invocation) {
  const Templates page = load_templates(arguments.templates);
  check_map_folder(arguments.out);
  OwnInput& input = arguments.input;
  input.layout = arguments.layout == "wide"   ? Layout::kWide
                 : arguments.layout == "long" ? Layout::kLong
                                              : Layout::kAuto;
  input.unit = arguments.degrees ? AngleUnit::kDegrees : AngleUnit::kRadians;
  input.rigid = arguments.fit == "rigid";
  if (input.kind.empty() && arguments.method == kPairs) input.kind = kRangeBearing;
  arguments.options.choose = lower_case(arguments.method) == "auto";
  // What grows, or comes by a pipe, cannot be looked into first.
  if (!arguments.follow) input.kind = kind_of(input);
  take_others(arguments);
  require_pairs(arguments);
  if (input.kind != kRangeBearing) arguments.options.setting = chosen_setting(arguments);
  arguments.options.fit =
      arguments.fit == "least-squares" ? AffineFit::kLeastSquares : AffineFit::kLeastDistances;
  if (arguments.follow) return follow_file(arguments, page, invocation);
  const bool any_method = arguments.options.choose;
  arguments.options.begin = [&](const MapRecord& begun) {
    check_may_become(arguments.out, begun, any_method);
  };
  OwnMap map = map_input(input, read_points(arguments.anchors), read_points(arguments.truth),
                         arguments.options);
  for (const auto& [what, value] : map.read)
    invocation.console.detail(fmt::format("{}: {}: {}", input.path, what, value));
  for (std::string& warning : frame_warnings(map.record)) map.warnings.push_back(warning);
  for (const std::string& remark : map.remarks) invocation.console.info(remark);
  for (const std::string& warning : map.warnings) invocation.console.warning(warning);
  for (const Status& status : map.record.statuses)
    invocation.console.warning(fmt::format("{}: {}", name(status.code), status.detail));
  write_outputs(arguments, map, page, invocation);
  invocation.console.result(map_text(map, arguments.out), map_result(map, arguments.out));
  return map.record.estimate.array().isNaN().all() ? kNo : kDone;
}

}  // namespace

Action map_verb(CLI::App& app) {
  auto arguments = std::make_shared<Arguments>();
  app.description("Map your own observations");
  app.footer(
      "Examples:\n"
      "  mapproof map bearings.csv --kind bearing --anchors anchors.csv --out out/map\n"
      "  mapproof map seen.csv --kind visibility --method lpca --out out/shape\n"
      "  mapproof map MRCLAM_Dataset2 --method isomap -K 5 --out out/mrclam\n"
      "  mapproof map MRCLAM_Dataset2 --kind range-bearing --out out/pairs\n"
      "  mapproof map seen.csv --kind visibility --with bearings.csv --with-kind bearing --out "
      "out/joint\n\n"
      "OBSERVATIONS: wide CSV (a row a landmark, a column a step; empty or nan: missing), long "
      "CSV\n"
      "(step, landmark, value), sightings (step or time, landmark, range, bearing), JSON of\n"
      "mapproof.observations or mapproof.sightings, or a folder of MRCLAM files; all of them may "
      "be\ngzip'ed. Bearings are relative to the robot's heading, counter-clockwise, in radians.\n"
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
         "--kind", arguments->input.kind,
         "What the values are: visibility (0/1), bearing [rad], range [m], or range-bearing; "
         "needed for CSV but sightings")
      ->check(CLI::IsMember({"visibility", "bearing", "range", "range-bearing"}));
  app.add_option("--with", arguments->with,
                 "Observations of the same landmarks by another kind of sensor, for one map of "
                 "both: landmarks are matched by name, steps need not be the same")
      ->take_all();
  app.add_option("--with-kind", arguments->with_kind, "What they are, for each --with")
      ->check(CLI::IsMember({"visibility", "bearing", "range"}))
      ->take_all();
  app.add_flag("--degrees", arguments->degrees, "Bearings in a CSV file are in degrees");
  app.add_option("--layout", arguments->layout, "Of a CSV file")
      ->check(CLI::IsMember({"auto", "wide", "long"}))
      ->capture_default_str();
  app.add_option("--anchors", arguments->anchors,
                 "Known positions of 3 landmarks or more: CSV of name, x [m], y [m]");
  app.add_option("--truth", arguments->truth, "True positions, for the errors: as --anchors");
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
               "Follow long CSV or sightings as they grow (-: standard input; gzip'ed or not) and "
               "write map and figure again and again, to their end, SIGINT or SIGTERM; not with "
               "--method auto, --ellipses, --missing, --submaps, --steps, --drop-unseen, "
               "--check-labels or --repair-labels");
  app.add_option("--every", arguments->every,
                 "With --follow: after so many steps (100) or seconds (2s)")
      ->capture_default_str();
  app.add_flag(
      "--check-labels", arguments->input.labels.check,
      "Sightings of range and bearing: name labels that contradict the others, or the places "
      "that anchors, truth or survey tell");
  app.add_flag("--repair-labels", arguments->input.labels.repair, "And mend them before mapping");
  app.add_flag("--find-moved", arguments->input.labels.find_moved,
               "Sightings of range and bearing: name landmarks that moved, map both places; with "
               "--follow, as soon as it shows");
  app.add_option("--labels-unsure", arguments->input.unsure,
                 "Labels that are confused with one another, a,b,...: whose their readings are is "
                 "estimated together with the map (as of readings under the label ? in long CSV)")
      ->delimiter(',');
  app.add_option("--templates", arguments->templates,
                 "Folder whose templates replace the embedded ones");
  return [arguments](const Invocation& invocation) { return make_map(*arguments, invocation); };
}

}  // namespace mapproof
