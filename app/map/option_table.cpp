#include "app/map/option_table.hpp"

#include <algorithm>
#include <vector>

#include <fmt/format.h>

#include "core/base/errors.hpp"
#include "core/base/text/words.hpp"

namespace mapproof {
namespace {

using Job = const MapJob&;

/// An option that sets one parameter of the methods that have it: "--sigma2".
struct ParameterOption {
  std::string_view symbol;
  std::string_view option;
  std::optional<double> MapJob::*value;
};

constexpr ParameterOption kParameterOptions[] = {{"K", "-K", &MapJob::neighbours},
                                                 {"sigma2", "--sigma2", &MapJob::variance},
                                                 {"d", "--degree", &MapJob::degree}};

/// The parameter that the job's method has; null: none.
const ParameterInfo* parameter_of(Job job) {
  const std::optional<Method> method = method_of(job);
  return method && info(*method).parameter ? &*info(*method).parameter : nullptr;
}

bool has_parameter(Job job, std::string_view symbol) {
  const ParameterInfo* parameter = parameter_of(job);
  return parameter != nullptr && parameter->symbol == symbol;
}

bool is_filled_in(Job job) {
  return job.missing == "ppca" || job.missing == "pca" || job.missing == "auto";
}

/// Whether a file has bearings, or may have them: the columns of detections name the sensor.
bool has_bearings(Job job) {
  return (job.sensor != "range" && job.sensor != "visibility") ||
         std::ranges::find(job.with_sensor, "bearing") != job.with_sensor.end();
}

/// All options, and what they come to.
const std::vector<MapOption> kOptions = {
    {"--sensor", [](Job job) { return !job.sensor.empty(); }},
    {"--sensor bearing", [](Job job) { return job.sensor == "bearing"; }, {"--sensor", "bearing"}},
    {"--sensor range", [](Job job) { return job.sensor == "range"; }, {"--sensor", "range"}},
    {"--sensor visibility",
     [](Job job) { return job.sensor == "visibility"; },
     {"--sensor", "visibility"}},
    {"--sensor range-bearing",
     [](Job job) { return job.is_range_bearing(); },
     {"--sensor", "range-bearing"}},
    {"--method",
     [](Job job) { return !job.method.empty() && job.method != kPairs && !job.chooses_method(); },
     {"--method", "isomap"}},
    {"--method auto", [](Job job) { return job.chooses_method(); }, {"--method", "auto"}},
    {"--method pairs", [](Job job) { return job.method == kPairs; }, {"--method", "pairs"}},
    {"--parameter", [](Job job) { return job.parameter.has_value(); }, {"--parameter", "3"}},
    {"-K", [](Job job) { return job.neighbours.has_value(); }, {"--neighbours", "3"}},
    {"--sigma2", [](Job job) { return job.variance.has_value(); }, {"--sigma2", "3"}},
    {"--degree", [](Job job) { return job.degree.has_value(); }, {"--degree", "3"}},
    {"a method with a parameter", [](Job job) { return parameter_of(job) != nullptr; }},
    {"a method with K", [](Job job) { return has_parameter(job, "K"); }},
    {"a method with sigma2", [](Job job) { return has_parameter(job, "sigma2"); }},
    {"a method with d", [](Job job) { return has_parameter(job, "d"); }},
    {"--references",
     [](Job job) { return job.references.has_value(); },
     {"--references", "50"}},
    {"a method of references",
     [](Job job) {
       const std::optional<Method> method = method_of(job);
       return method && has_references(*method);
     }},
    {"--stress-fall",
     [](Job job) { return job.stress_fall.has_value(); },
     {"--stress-fall", "1e-6"}},
    {"a method of least stress",
     [](Job job) {
       const std::optional<Method> method = method_of(job);
       return method == Method::kSmacof || method == Method::kSmacofKnn || job.chooses_method();
     }},
    {"--sensor with bearings", has_bearings},
    {"--with", [](Job job) { return !job.with.empty(); }, {"--with"}},
    {"--with-sensor",
     [](Job job) { return !job.with_sensor.empty(); },
     {"--with-sensor", "bearing"}},
    {"a --with-sensor for each", [](Job job) { return job.with.size() == job.with_sensor.size(); }},
    {"--degrees", [](Job job) { return job.table.degrees; }, {"--degrees"}},
    {"--layout wide", [](Job job) { return job.table.layout == "wide"; }, {"--layout", "wide"}},
    {"--layout transposed",
     [](Job job) { return job.table.layout == "transposed"; },
     {"--layout", "transposed"}},
    {"--bearing-convention",
     [](Job job) { return job.table.convention != TableOptions().convention; },
     {"--bearing-convention", "clockwise"}},
    {"--columns",
     [](Job job) { return !job.table.columns.empty(); },
     {"--columns", "landmark=landmark"}},
    {"--scan-window",
     [](Job job) { return !job.table.scan_window.empty(); },
     {"--scan-window", "50ms"}},
    {"--anchors", [](Job job) { return !job.anchors.empty(); }, {"--anchors"}},
    {"--ground-truth", [](Job job) { return !job.ground_truth.empty(); }, {"--ground-truth"}},
    {"--steps", [](Job job) { return job.steps > 0; }, {"--steps", "20"}},
    {"--fit", [](Job job) { return job.fit == "least-squares"; }, {"--fit", "least-squares"}},
    {"--fit rigid", [](Job job) { return job.is_rigid(); }, {"--fit", "rigid"}},
    {"--drop-unseen", [](Job job) { return job.drop_unseen; }, {"--drop-unseen"}},
    {"--only-seen-together",
     [](Job job) { return job.embedder.only_seen_together; },
     {"--only-seen-together"}},
    {"--missing", [](Job job) { return job.missing != MapJob().missing; }, {"--missing", "ppca"}},
    {"--missing covisible",
     [](Job job) { return job.missing == "covisible"; },
     {"--missing", "covisible"}},
    {"--missing ppca, pca or auto", is_filled_in},
    {"--dimensions", [](Job job) { return job.dimensions.has_value(); }, {"--dimensions", "3"}},
    {"--submaps", [](Job job) { return job.submaps > 0; }, {"--submaps", "6"}},
    {"--overlap", [](Job job) { return job.overlap.has_value(); }, {"--overlap", "0.5"}},
    {"--ellipses", [](Job job) { return job.ellipse_replicates > 0; }, {"--ellipses", "10"}},
    {"--incremental", [](Job job) { return job.incremental; }, {"--incremental"}},
    {"--every", [](Job job) { return job.every != MapJob().every; }, {"--every", "5"}},
    {"--check-ids", [](Job job) { return job.check_ids; }, {"--check-ids"}},
    {"--repair-ids", [](Job job) { return job.repair_ids; }, {"--repair-ids"}},
    {"--find-moved", [](Job job) { return job.find_moved; }, {"--find-moved"}},
    {"--find-moved without range-bearing",
     [](Job job) { return job.find_moved && !job.is_range_bearing(); }},
    {"--uncertain-ids",
     [](Job job) { return !job.uncertain_ids.empty(); },
     {"--uncertain-ids", "L1,L2"}},
    {"--templates", [](Job job) { return job.templates.has_value(); }, {"--templates"}},
};

constexpr std::string_view kNoParameter = "the method pairs has no parameter";
constexpr std::string_view kChosen = "it chooses the parameter, too; leave out the parameter";
constexpr std::string_view kOneSensor =
    "a map of several sensors uses the distances of each sensor and nothing else";
constexpr std::string_view kDetected =
    "it is for visibility: other sensors do not show which landmarks were seen together";
constexpr std::string_view kNoBearings = "it is for bearings, and --sensor {sensor} has none";
constexpr std::string_view kAllScans =
    "landmark IDs are checked by all scans together; check the whole file instead";
constexpr std::string_view kComplete =
    "data association is estimated for one sensor that measures every landmark at every step (for "
    "range and bearing, see --check-ids)";

/// Options that do not go together.
constexpr OptionPair kApart[] = {
    {"--method", "--sensor range-bearing",
     "range and bearing together are mapped by pairs; for other methods use --sensor range, "
     "bearing or visibility"},
    {"--method auto", "--sensor range-bearing",
     "range and bearing together are mapped by pairs; for other methods use --sensor range, "
     "bearing or visibility"},
    {"--parameter", "--sensor range-bearing", kNoParameter},
    {"-K", "--sensor range-bearing", kNoParameter},
    {"--sigma2", "--sensor range-bearing", kNoParameter},
    {"--degree", "--sensor range-bearing", kNoParameter},
    {"--missing", "--sensor range-bearing", "missing distances of pairs are not filled in"},
    {"--submaps", "--sensor range-bearing", "a map of range and bearing is made as a whole"},
    {"--with", "--sensor range-bearing",
     "range and bearing together are mapped by pairs; choose one of them by --sensor"},
    {"--uncertain-ids", "--sensor range-bearing", kComplete},

    {"--parameter", "--method auto", kChosen},
    {"-K", "--method auto", kChosen},
    {"--sigma2", "--method auto", kChosen},
    {"--degree", "--method auto", kChosen},
    {"--submaps", "--method auto", "the candidates are maps without sub-maps"},
    {"--submaps", "--ellipses", "bootstrap resamples are mapped without sub-maps"},
    {"--missing covisible", "--sensor visibility",
     "it is for bearings and ranges; with visibility, every entry shows what was seen"},
    {"--only-seen-together", "--sensor bearing", kDetected},
    {"--only-seen-together", "--sensor range", kDetected},
    {"--only-seen-together", "--sensor range-bearing", kDetected},

    {"--with", "--method auto", kOneSensor},
    {"--with", "--submaps", kOneSensor},
    {"--with", "--ellipses", kOneSensor},
    {"--with", "--missing", kOneSensor},
    {"--with", "--check-ids", kOneSensor},
    {"--with", "--repair-ids", kOneSensor},
    {"--with", "--find-moved", kOneSensor},
    {"--with", "--uncertain-ids", kComplete},
    {"--with", "--incremental", "only one file can be read while it grows"},

    {"--method auto", "--incremental",
     "it makes some twenty maps by each method, far more than an update may take; choose the "
     "method on a part of the file, then use that method"},
    {"--ellipses", "--incremental",
     "they need hundreds of maps of bootstrap resamples, far more than an update may take; map "
     "the whole file instead"},
    {"--missing", "--incremental",
     "filling in missing data takes the whole history, and an incremental map keeps no steps; it "
     "uses pairwise-complete distances"},
    {"--submaps", "--incremental", "an incremental map is made as a whole"},
    {"--steps", "--incremental", "an incremental map uses every step of the file"},
    {"--drop-unseen", "--incremental", "an incremental map holds observed landmarks only"},
    {"--layout wide", "--incremental", "only a long table can be read step by step"},
    {"--layout transposed", "--incremental", "only a long table can be read step by step"},
    {"--check-ids", "--incremental", kAllScans},
    {"--repair-ids", "--incremental", kAllScans},
    {"--find-moved without range-bearing", "--incremental",
     "ranges or bearings alone do not show which landmark moved; use detections with --sensor "
     "range-bearing"},
    {"--uncertain-ids", "--incremental", kComplete},
};

/// Options of which the first has a use only with the second.
constexpr OptionPair kNeeded[] = {
    {"--incremental", "--sensor",
     "add --sensor visibility, bearing, range or range-bearing: what the values are"},
    {"--method pairs", "--sensor range-bearing", "it maps observations of --sensor range-bearing"},
    {"--fit rigid", "--sensor range-bearing",
     "only a map of --sensor range-bearing has its own scale"},
    {"--with", "a --with-sensor for each", "each file needs its own --with-sensor"},
    {"--with-sensor", "--with", "it is the sensor of another file; add --with FILE"},
    {"--degrees", "--sensor with bearings", kNoBearings},
    {"--bearing-convention", "--sensor with bearings", kNoBearings},
    {"--every", "--incremental",
     "it is the interval of the updates of --incremental; add --incremental"},
    {"--parameter", "a method with a parameter", "the method {method} has {has}"},
    {"-K", "a method with K", "the method {method} has {has}"},
    {"--sigma2", "a method with sigma2", "the method {method} has {has}"},
    {"--degree", "a method with d", "the method {method} has {has}"},
    {"--stress-fall", "a method of least stress",
     "it is the stop rule of smacof and smacof-knn; the method {method} does not have it"},
    {"--references", "a method of references",
     "only landmark-isomap and landmark-mvu have reference landmarks; add --method "
     "landmark-isomap"},
    {"--dimensions", "--missing ppca, pca or auto", "--missing {missing} has no dimensions"},
    {"--overlap", "--submaps", "it is the overlap of sub-maps; add --submaps N"},
};

/// "no parameter", or the parameter of the job's method and its option.
std::string parameter_words(Job job) {
  const ParameterInfo* parameter = parameter_of(job);
  if (parameter == nullptr) return "no parameter";
  const auto* option =
      std::ranges::find(kParameterOptions, parameter->symbol, &ParameterOption::symbol);
  return fmt::format("the parameter {}; did you mean {}?", parameter->shown,
                     option == std::end(kParameterOptions) ? "--parameter" : option->option);
}

std::string reason(const OptionPair& pair, Job job) {
  const std::optional<Method> method = method_of(job);
  return fmt::format(fmt::runtime(pair.why),
                     fmt::arg("method", method ? info(*method).name : std::string_view("pairs")),
                     fmt::arg("has", parameter_words(job)), fmt::arg("missing", job.missing),
                     fmt::arg("sensor", job.sensor));
}

}  // namespace

const OptionTable<MapJob>& map_option_table() {
  static const OptionTable<MapJob> table{kOptions, kApart, kNeeded};
  return table;
}

void complete_help(CLI::App& app) {
  CLI::Option* incremental = app.get_option("--incremental");
  incremental->description(incremental->get_description() + ". " +
                           map_option_table().not_with("--incremental"));
}

std::string refusal(const MapJob& job) {
  return map_option_table().refusal(job, [&](const OptionPair& pair) { return reason(pair, job); });
}

void require_compatible(const MapJob& job) {
  if (const std::string words = refusal(job); !words.empty()) throw InvalidInput(words);
}

std::optional<GivenParameter> given_parameter(const MapJob& job) {
  std::optional<GivenParameter> given;
  if (job.parameter) given = {"--parameter", *job.parameter};
  for (const ParameterOption& option : kParameterOptions)
    if (const std::optional<double>& value = job.*option.value) given = {option.option, *value};
  return given;
}

std::optional<Method> method_of(const MapJob& job) {
  return method_named(job.method.empty() ? "isomap" : lower_case(job.method));
}

void require_known_method(const MapJob& job) {
  if (job.chooses_method() || job.method == kPairs || method_of(job)) return;
  throw InvalidInput(fmt::format("--method: unknown method \"{}\"; did you mean \"{}\"?",
                                 printable(job.method), nearest_method_name(job.method)));
}

}  // namespace mapproof
