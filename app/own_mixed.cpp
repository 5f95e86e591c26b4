#include "app/own_mixed.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "app/own_map.hpp"
#include "app/result_json.hpp"
#include "core/align/laid_on.hpp"
#include "core/base/errors.hpp"
#include "core/base/words.hpp"
#include "core/choice/mixed_quality.hpp"
#include "core/mixed/mixed_map.hpp"
#include "render/figures/map_grid.hpp"

namespace mapproof {
namespace {

constexpr double kMuchContinuity = 1e-3;  ///< Maps of one quality differ by less than this,
constexpr double kMuchMpe = 0.05;         ///< or by this share of their MPE.
constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();

void require_different(const std::vector<ObservationSource>& sources) {
  for (std::size_t b = 0; b < sources.size(); ++b)
    for (std::size_t a = 0; a < b; ++a)
      if (sources[a].history.sensor == sources[b].history.sensor)
        throw IoError(sources[b].path,
                      fmt::format("holds {}, as {} does; each kind once",
                                  name(sources[b].history.sensor), sources[a].path));
}

/// All names, in the order in which they come.
std::vector<std::string> all_names(const std::vector<ObservationSource>& sources) {
  std::vector<std::string> names = sources.front().history.names;
  for (const ObservationSource& source : sources) {
    std::size_t common = 0;
    std::vector<std::string> more;
    for (const std::string& name : source.history.names)
      if (std::ranges::find(names, name) != names.end())
        ++common;
      else
        more.push_back(name);
    if (common < 3)
      throw IoError(
          source.path,
          fmt::format("shares {} with {}; one map of both needs 3 or more in common",
                      counted(static_cast<long long>(common), "landmark"), sources.front().path));
    names.insert(names.end(), more.begin(), more.end());
  }
  return names;
}

/// The history in the rows of `names`; rows that it does not have are missing throughout.
ObservationHistory in_rows(const ObservationHistory& history,
                           const std::vector<std::string>& names) {
  ObservationHistory result{.sensor = history.sensor, .names = names, .values = {}};
  result.values = Eigen::MatrixXd::Constant(std::ssize(names), history.steps(), kUnknown);
  for (std::size_t i = 0; i < history.names.size(); ++i) {
    const auto row = std::ranges::find(names, history.names[i]) - names.begin();
    result.values.row(row) = history.values.row(static_cast<Eigen::Index>(i));
  }
  return result;
}

std::optional<Points> own_truth(const std::vector<ObservationSource>& sources,
                                const std::vector<std::string>& names) {
  const auto source = std::ranges::find_if(
      sources, [](const ObservationSource& one) { return one.truth_m.has_value(); });
  if (source == sources.end()) return std::nullopt;
  Points truth_m = Points::Constant(std::ssize(names), 2, kUnknown);
  for (std::size_t i = 0; i < source->history.names.size(); ++i)
    truth_m.row(std::ranges::find(names, source->history.names[i]) - names.begin()) =
        source->truth_m->row(static_cast<Eigen::Index>(i));
  return truth_m;
}

/// What of landmarks and steps is not in all files.
void remark_differences(const std::vector<ObservationSource>& sources,
                        const std::vector<std::string>& names, OwnMap& result) {
  std::vector<std::string> partial;
  for (const std::string& name : names)
    if (!std::ranges::all_of(sources, [&](const ObservationSource& source) {
          return std::ranges::find(source.history.names, name) != source.history.names.end();
        }))
      partial.push_back(printable(name));
  if (!partial.empty())
    result.remarks.push_back(
        fmt::format("{} not in all files ({}): placed by the sensors that have them.",
                    counted(std::ssize(partial), "landmark"), listed(partial, 10)));
  if (std::ranges::any_of(sources, [&](const ObservationSource& source) {
        return source.history.steps() != sources.front().history.steps();
      }))
    result.remarks.emplace_back(
        "The files hold different numbers of steps: each sensor's distances are over its own.");
}

/// Rows that no sensor saw. @throws IoError unless they are to be dropped or a log says so.
std::vector<Eigen::Index> unseen_by_all(const std::vector<ObservationSource>& sources,
                                        const std::vector<ObservationHistory>& histories,
                                        const OwnMapOptions& options, OwnMap& result) {
  std::vector<int> misses(histories.front().names.size(), 0);
  for (std::size_t s = 0; s < histories.size(); ++s) {
    const std::vector<Eigen::Index> unseen = unseen_landmarks(histories[s], histories[s].steps());
    if (unseen.size() == misses.size())
      throw IoError(sources[s].path, "holds no observation of any landmark");
    for (const Eigen::Index row : unseen) ++misses[static_cast<std::size_t>(row)];
  }
  std::vector<Eigen::Index> rows;
  for (std::size_t i = 0; i < misses.size(); ++i)
    if (misses[i] == static_cast<int>(histories.size()))
      rows.push_back(static_cast<Eigen::Index>(i));
  if (rows.empty()) return rows;
  if (!options.drop_unseen && !sources.front().truth_m)
    throw IoError(
        sources.front().path,
        fmt::format("landmark \"{}\" is never observed by any of the sensors; remove it, "
                    "or pass --drop-unseen to map the others",
                    printable(histories.front().names[static_cast<std::size_t>(rows.front())])));
  result.remarks.push_back(
      fmt::format("{} of {} landmarks were never observed by any of the sensors and are left out.",
                  rows.size(), misses.size()));
  return rows;
}

ComparedMap compared(const std::string& what, const ObservationHistory& history,
                     const MethodSetting& setting, const Embedding& embedding,
                     const Reference& reference, AffineFit fit) {
  ComparedMap map{.what = what, .record = {}};
  map.record.id = "map";
  map.record.sensor = history.sensor;
  map.record.setting = setting;
  map.record.step = static_cast<int>(history.steps());
  map.record.names = history.names;
  map.record.statuses = embedding.statuses;
  map.record.certificate = embedding.certificate;
  align_and_score(map.record, embedding.coordinates, reference, fit);
  return map;
}

std::string number_words(double value) { return fmt::format("{:.3f}", value); }

/// Of the anchors' frame, or else with the affine map fitted to all; NaN without a truth.
double mpe_of(const ComparedMap& map) {
  const std::optional<Score>& score = map.record.score;
  if (!score) return kUnknown;
  return std::isnan(score->mpe_m) ? score->mpe_all_fitted_m : score->mpe_m;
}

/// @param much  Differences up to this are none. Less is better.
const char* comparison(double joint, double single, double much) {
  if (joint < single - much) return "better than";
  return joint > single + much ? "worse than" : "about as good as";
}

/// Which map the neighbourhoods of all sensors' observations speak for, and which the truth.
std::string verdict(const std::vector<ComparedMap>& maps) {
  const auto best_alone = [&](auto value) {
    const ComparedMap* best = nullptr;
    for (const ComparedMap& map : maps)
      if (!map.is_joint && !std::isnan(value(map)) &&
          (best == nullptr || value(map) < value(*best)))
        best = &map;
    return best;
  };
  const auto lost = [](const ComparedMap& map) { return 1.0 - map.continuity; };
  const ComparedMap& joint = maps.front();
  std::string words;
  if (const ComparedMap* best = best_alone(lost); best != nullptr && !std::isnan(joint.continuity))
    words = fmt::format(
        "By the share of all sensors' neighbourhoods that a map keeps (continuity) the joint map "
        "is {} the best single one: {} against {} of {}.",
        comparison(lost(joint), lost(*best), kMuchContinuity), number_words(joint.continuity),
        number_words(best->continuity), best->what);
  else
    words = "Whether the joint map is better than the sensors' own cannot be told without a truth.";
  if (const ComparedMap* best = best_alone(mpe_of); best != nullptr && !std::isnan(mpe_of(joint)))
    words += fmt::format(" By the truth it is {} the best single one: MPE {} m against {} m of {}.",
                         comparison(mpe_of(joint), mpe_of(*best), kMuchMpe * mpe_of(*best)),
                         number_words(mpe_of(joint)), number_words(mpe_of(*best)), best->what);
  return words;
}

/// Names, kinds and steps of the files, for the report.
void list_sources(const std::vector<ObservationSource>& sources, OwnMap& result) {
  std::vector<std::string> kinds;
  for (const ObservationSource& source : sources) {
    const std::string kind(name(source.history.sensor));
    const auto missing = static_cast<double>(source.history.values.array().isNaN().count());
    kinds.push_back(kind);
    result.read.emplace_back(
        "Sensor " + kind,
        fmt::format("{}: {}, {} steps, {:.1f} % missing", source.path,
                    counted(source.history.landmarks(), "landmark"), source.history.steps(),
                    100.0 * missing / static_cast<double>(source.history.values.size())));
    for (const std::string& remark : source.remarks)
      if (std::ranges::find(result.remarks, remark) == result.remarks.end())
        result.remarks.push_back(remark);
  }
  result.observed = listed(kinds, kinds.size());
}

/// Checks method and steps, and brings the files' histories into common rows.
std::vector<ObservationHistory> common_histories(const std::vector<ObservationSource>& sources,
                                                 const std::vector<std::string>& names,
                                                 const OwnMapOptions& options) {
  const double K = options.setting.parameter.value_or(0.0);
  if (on_graph(options.setting.method) && K >= static_cast<double>(names.size()))
    throw IoError(
        sources.front().path,
        fmt::format("K = {:g} needs more than {:g} landmarks, {} are there", K, K, names.size()));
  std::vector<ObservationHistory> histories;
  for (const ObservationSource& source : sources) {
    if (options.steps > source.history.steps())
      throw IoError(source.path, fmt::format("--steps {}: it holds {} observations", options.steps,
                                             source.history.steps()));
    histories.push_back(in_rows(source.history, names));
    if (options.steps > 0)
      histories.back().values = Eigen::MatrixXd(histories.back().values.leftCols(options.steps));
  }
  return histories;
}

/// The joint map, then each sensor's own, then those by the joint map's way, with what speaks for
/// each.
OwnMixed compared_maps(const MixedMap& made, const std::vector<ObservationHistory>& histories,
                       const Reference& reference, AffineFit fit) {
  OwnMixed mixed;
  const auto add = [&](const std::string& what, std::size_t s, const MethodSetting& setting,
                       const Embedding& embedding) {
    mixed.maps.push_back(compared(what, histories[s], setting, embedding, reference, fit));
  };
  add("joint map", 0, made.setting, made.joint);
  mixed.maps.front().is_joint = true;
  mixed.maps.front().record.id = "joint";
  std::vector<Eigen::MatrixXd> distances;
  std::vector<double> weights;
  for (std::size_t s = 0; s < made.sensors.size(); ++s) {
    const MixedSensor& sensor = made.sensors[s];
    add(std::string(name(sensor.sensor)) + " alone", s, sensor.setting, sensor.own);
    distances.push_back(sensor.distances);
    weights.push_back(sensor.weight);
  }
  for (std::size_t s = 0; s < made.sensors.size(); ++s)
    if (const MixedSensor& sensor = made.sensors[s]; sensor.by_order.coordinates.size() > 0)
      add(std::string(name(sensor.sensor)) + " alone, by order", s, sensor.setting,
          sensor.by_order);
  for (ComparedMap& map : mixed.maps)
    map.continuity = mixed_continuity(distances, weights, map.record.estimate);
  for (std::size_t s = 0; s < made.sensors.size(); ++s) {
    const MixedSensor& sensor = made.sensors[s];
    mixed.sensors.sensors.push_back({.sensor = sensor.sensor,
                                     .reliability = sensor.reliability,
                                     .weight = sensor.weight,
                                     .share = sensor.share,
                                     .continuity = mixed.maps[s + 1].continuity});
  }
  mixed.sensors.continuity = mixed.maps.front().continuity;
  return mixed;
}

}  // namespace

OwnMap map_mixed(const std::vector<ObservationSource>& sources,
                 const std::optional<NamedPointsFile>& anchors,
                 const std::optional<NamedPointsFile>& truth, const OwnMapOptions& options) {
  require_different(sources);
  const std::vector<std::string> names = all_names(sources);
  const std::vector<ObservationHistory> histories = common_histories(sources, names, options);
  OwnMap result{.record = {}, .remarks = {}, .joined = {}, .read = {}};
  list_sources(sources, result);
  remark_differences(sources, names, result);
  const OwnLandmarks landmarks{.path = sources.front().path,
                               .names = names,
                               .unseen = unseen_by_all(sources, histories, options, result),
                               .truth_m = own_truth(sources, names)};
  const Reference reference = reference_of(landmarks, anchors, truth, result.remarks);
  begin_map(options,
            {.id = "joint",
             .sensor = histories.front().sensor,
             .step = static_cast<int>(histories.front().steps()),
             .names = names},
            reference);
  EmbedderOptions fitting;
  fitting.only_seen_together = options.only_seen_together;
  const MixedMap made = mixed_map(histories, 0, options.setting, fitting);
  OwnMixed mixed = compared_maps(made, histories, reference, options.fit);
  const std::string judged = verdict(mixed.maps);
  mixed.sensors.why =
      "Weights are r / (1 - r) of each sensor's reliability r, the correlation of its distances "
      "from both halves of its steps; shares are those of the pairs' inverse variances about the "
      "joint map. " +
      judged;
  result.remarks.push_back(judged);
  result.record = mixed.maps.front().record;
  result.made_by = "joint map begun by " + label(made.setting);
  result.mixed = std::move(mixed);
  return result;
}

Section mixed_section(const OwnMixed& mixed) {
  Section section{"mixed", "Several sensors in one map", {}};
  section.blocks.emplace_back(Paragraph{{{mixed.sensors.why}}});
  Table table{"mixed-maps",
              "The joint map and each sensor's own",
              {{"Map", "", "", ""},
               {"Method", "", "", ""},
               {"Steps", "", "", ""},
               {"Reliability", "", "",
                "Correlation of the distances from both halves, stepped up "
                "to all steps."},
               {"Weight", "", "", "In the mean distances that the joint map starts from."},
               {"Share", "", "", "In the weights of the joint map's pairs."},
               {"Continuity", "", "", "Share of all sensors' neighbourhoods that the map keeps."},
               {"MPE", "m", "", "Where the truth is known."},
               {"MOE", "%", "", "Where the truth is known."}},
              {},
              {}};
  for (std::size_t k = 0; k < mixed.maps.size(); ++k) {
    const ComparedMap& map = mixed.maps[k];
    const std::size_t sensors = mixed.sensors.sensors.size();
    const bool own = k >= 1 && k <= sensors;
    Row row;
    row.source = map.record.id;
    row.cells = {TextCell{map.what}, TextCell{label(map.record.setting)},
                 NumberCell{static_cast<double>(map.record.step), 0}};
    const SensorShare share = own ? mixed.sensors.sensors[k - 1] : SensorShare{};
    for (const double value : {share.reliability, share.weight, share.share})
      row.cells.emplace_back(NumberCell{own ? value : kUnknown, 3});
    row.cells.emplace_back(NumberCell{map.continuity, 3});
    const std::optional<Score>& score = map.record.score;
    row.cells.emplace_back(NumberCell{mpe_of(map), 3});
    row.cells.emplace_back(NumberCell{score ? score->moe_unmirrored_percent : kUnknown, 2});
    table.rows.push_back(std::move(row));
  }
  table.notes.emplace_back(
      "By order: the joint map's way on the one sensor alone; what it gains is not the mixing's.");
  section.blocks.emplace_back(std::move(table));
  return section;
}

nlohmann::ordered_json mixed_json(const OwnMixed& mixed) {
  nlohmann::ordered_json object = {{"why", mixed.sensors.why},
                                   {"sensors", nlohmann::ordered_json::array()},
                                   {"maps", nlohmann::ordered_json::array()}};
  for (const SensorShare& one : mixed.sensors.sensors)
    object["sensors"].push_back({{"sensor", name(one.sensor)},
                                 {"reliability", one.reliability},
                                 {"weight", one.weight},
                                 {"share", one.share}});
  for (const ComparedMap& map : mixed.maps)
    object["maps"].push_back({{"map", map.what},
                              {"method", info(map.record.setting.method).name},
                              {"continuity", number_or_null(map.continuity)},
                              {"mpe_m", number_or_null(mpe_of(map))}});
  return object;
}

std::optional<Figure> mixed_figure(const OwnMixed& mixed) {
  const MapRecord& joint = mixed.maps.front().record;
  MapGridSpec spec{.id = "sensors", .title = "The joint map and each sensor's own", .maps = {}};
  const std::size_t shown = 1 + mixed.sensors.sensors.size();
  for (std::size_t k = 0; k < std::min(shown, mixed.maps.size()); ++k) {
    MapRecord record = mixed.maps[k].record;
    if (record.estimate.array().isNaN().all() || record.frame != joint.frame) continue;
    // Shapes without a frame are laid on one another.
    if (k > 0 && joint.frame == Frame::kSimilarity) {
      const std::optional<Points> laid = laid_on(record.estimate, joint.estimate);
      if (!laid) continue;
      record.estimate = *laid;
    }
    spec.maps.push_back({mixed.maps[k].what, std::move(record)});
  }
  if (spec.maps.size() < 2) return std::nullopt;
  return map_pair_figure(spec);
}

}  // namespace mapproof
