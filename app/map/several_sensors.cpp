#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "app/map/alignment.hpp"
#include "app/map/pipeline.hpp"
#include "app/result_json.hpp"
#include "core/align/aligned_to.hpp"
#include "core/base/errors.hpp"
#include "core/base/not_finite.hpp"
#include "core/base/text/number_text.hpp"
#include "core/base/text/words.hpp"
#include "core/choice/mixed_quality.hpp"
#include "core/mixed/mixed_map.hpp"
#include "render/figures/maps/map_grid.hpp"
#include "reports/model/format.hpp"

namespace mapproof {
namespace {

using Sources = std::vector<ObservationSource>;

constexpr std::string_view kSensorsFigure = "sensors";
constexpr double kMuchContinuity = 1e-3;  ///< Maps of one quality differ by less than this,
constexpr double kMuchMpe = 0.05;         ///< or by this share of their MPE.

void require_different(const Sources& sources) {
  for (std::size_t b = 0; b < sources.size(); ++b)
    for (std::size_t a = 0; a < b; ++a)
      if (sources[a].history.sensor == sources[b].history.sensor)
        throw IoError(sources[b].path,
                      fmt::format("holds {}, as {} does; each sensor only once",
                                  name(sources[b].history.sensor), sources[a].path));
}

/// The history in the rows of `names`; rows that it does not have are missing throughout.
ObservationHistory in_rows(const ObservationHistory& history,
                           const std::vector<std::string>& names) {
  ObservationHistory result{.sensor = history.sensor, .names = names, .values = {}};
  result.values = Eigen::MatrixXd::Constant(std::ssize(names), history.steps(), kNaN);
  for (std::size_t i = 0; i < history.names.size(); ++i) {
    const auto row = std::ranges::find(names, history.names[i]) - names.begin();
    result.values.row(row) = history.values.row(static_cast<Eigen::Index>(i));
  }
  return result;
}

/// What of landmarks and steps is not in all files.
void remark_differences(const Sources& sources, const std::vector<std::string>& names,
                        MapResult& result) {
  std::vector<std::string> partial;
  for (const std::string& name : names)
    if (!std::ranges::all_of(sources, [&](const ObservationSource& source) {
          return std::ranges::find(source.history.names, name) != source.history.names.end();
        }))
      partial.push_back(printable(name));
  if (!partial.empty())
    result.remarks.push_back(fmt::format(
        "{} not in all files ({}): their positions come from the sensors that have them.",
        counted(std::ssize(partial), "landmark"), listed(partial, 10)));
  if (std::ranges::any_of(sources, [&](const ObservationSource& source) {
        return source.history.steps() != sources.front().history.steps();
      }))
    result.remarks.emplace_back(
        "The files hold different numbers of steps: the distances of each sensor use its own "
        "steps.");
}

/// Names, sensors and steps of the files, for the report.
void list_sources(const Sources& sources, MapResult& result) {
  for (const ObservationSource& source : sources) {
    const std::string sensor(name(source.history.sensor));
    const auto missing = static_cast<double>(source.history.values.array().isNaN().count());
    result.read.emplace_back(
        "Sensor " + sensor,
        fmt::format("{}: {}, {}, {:.1f} % missing", source.path,
                    counted(source.history.landmarks(), "landmark"),
                    counted(source.history.steps(), "step"),
                    100.0 * missing / static_cast<double>(source.history.values.size())));
    for (const std::string& remark : source.remarks)
      if (std::ranges::find(result.remarks, remark) == result.remarks.end())
        result.remarks.push_back(remark);
  }
}

/// All names of the files' landmarks, in the order in which they come.
/// @throws IoError naming the file if a sensor is there twice, or a file shares fewer than
///         three landmarks with those before it.
std::vector<std::string> joint_names(const Sources& sources) {
  require_different(sources);
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

/// The ground truth that comes with the first file that has one, in the rows of `names`.
std::optional<Points> common_ground_truth(const Sources& sources,
                                          const std::vector<std::string>& names) {
  const auto source = std::ranges::find_if(
      sources, [](const ObservationSource& one) { return one.ground_truth_m.has_value(); });
  if (source == sources.end()) return std::nullopt;
  Points ground_truth_m = Points::Constant(std::ssize(names), 2, kNaN);
  for (std::size_t i = 0; i < source->history.names.size(); ++i)
    ground_truth_m.row(std::ranges::find(names, source->history.names[i]) - names.begin()) =
        source->ground_truth_m->row(static_cast<Eigen::Index>(i));
  return ground_truth_m;
}

/// Rows that no sensor saw, with a remark. @throws IoError unless they are to be dropped or a log
/// says so; or if a file shows none at all.
std::vector<Eigen::Index> unseen_by_all(const Sources& sources, const MapJob& job,
                                        MapResult& result) {
  std::vector<int> misses(sources.front().history.names.size(), 0);
  for (const ObservationSource& source : sources) {
    const std::vector<Eigen::Index> unseen =
        unseen_landmarks(source.history, source.history.steps());
    if (unseen.size() == misses.size())
      throw IoError(source.path, "holds no observation of any landmark");
    for (const Eigen::Index row : unseen) ++misses[static_cast<std::size_t>(row)];
  }
  std::vector<Eigen::Index> rows;
  for (std::size_t i = 0; i < misses.size(); ++i)
    if (misses[i] == static_cast<int>(sources.size())) rows.push_back(static_cast<Eigen::Index>(i));
  if (rows.empty()) return rows;
  if (!job.drop_unseen && !sources.front().ground_truth_m)
    throw IoError(
        sources.front().path,
        fmt::format(
            "landmark \"{}\" is never observed by any of the sensors; remove it, "
            "or pass --drop-unseen to map the others",
            printable(sources.front().history.names[static_cast<std::size_t>(rows.front())])));
  result.remarks.push_back(
      fmt::format("{} of {} landmarks were never observed by any of the sensors and are left out.",
                  rows.size(), misses.size()));
  return rows;
}

/// Brings what the files hold into common rows: landmarks are matched by name; those that some
/// files alone name are placed by the sensors that have them, with a remark. Steps are not matched:
/// each sensor's distances are over its own.
/// @throws IoError naming the file if a sensor is there twice, a file shares fewer than three
///         landmarks with those before it, or nothing was observed.
MapDraft take_common_landmarks(MapDraft draft, const MapJob& job) {
  auto* sources = std::get_if<Sources>(&draft.observed);
  if (sources == nullptr) return draft;
  MapResult& result = draft.result;
  draft.landmarks.path = sources->front().path;
  draft.landmarks.names = joint_names(*sources);
  const std::vector<std::string>& names = draft.landmarks.names;
  require_neighbours(job, draft.landmarks);
  for (const ObservationSource& source : *sources)
    require_steps(job, source.path, source.history.steps());
  list_sources(*sources, result);
  remark_differences(*sources, names, result);
  draft.landmarks.ground_truth_m = common_ground_truth(*sources, names);
  for (ObservationSource& source : *sources) {
    source.history = in_rows(source.history, names);
    if (job.steps > 0)
      source.history.values = Eigen::MatrixXd(source.history.values.leftCols(job.steps));
  }
  draft.landmarks.unseen = unseen_by_all(*sources, job, result);
  FromSensors origin{{}, job.setting};
  for (const ObservationSource& source : *sources) origin.sensors.push_back(source.history.sensor);
  result.record = begin_record(std::move(origin), names, sources->front().history.steps());
  return draft;
}

/// One map that a joint map is compared with, or itself.
struct ComparedMap {
  std::string what;         ///< "bearing alone", "joint map".
  MapRecord record;         ///< In the frame of the anchors, or aligned to the joint map.
  double continuity = 0.0;  ///< Against all sensors' distances; NaN: not determined.
  bool is_joint = false;

  /// In the anchors' frame, or else with the affine map fitted to all; NaN without ground truth.
  double mpe_m() const {
    if (!record.score) return kNaN;
    return std::isnan(record.score->mpe_m) ? record.score->mpe_all_fitted_m : record.score->mpe_m;
  }
};

/// What a map of several sensors was made of.
struct JointMapResult {
  MapSensors sensors;
  std::vector<ComparedMap> maps;  ///< The joint map, then each sensor's own, then by order.
};

/// Not aligned.
/// @param history  Of the sensor, or of the first of them.
ComparedMap compared(const std::string& what, const ObservationHistory& history, MapOrigin origin,
                     const Embedding& embedding) {
  ComparedMap map{.what = what,
                  .record = begin_record(std::move(origin), history.names, history.steps())};
  map.record.statuses = embedding.statuses;
  map.record.certificate = embedding.certificate;
  map.record.estimate = embedding.coordinates;
  return map;
}

std::string number_words(double value) { return fmt::format("{:.3f}", value); }

/// @param much  Differences up to this are none. Less is better.
const char* comparison(double joint, double single, double much) {
  if (joint < single - much) return "better than";
  return joint > single + much ? "worse than" : "about as good as";
}

/// Which map is better by the neighbourhoods of all sensors' observations, and which by the ground
/// truth.
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
        "is {} the best map of a single sensor: {}, compared with {} of {}.",
        comparison(lost(joint), lost(*best), kMuchContinuity), number_words(joint.continuity),
        number_words(best->continuity), best->what);
  else
    words =
        "Whether the joint map is better than those of single sensors cannot be determined without "
        "ground truth.";
  if (const ComparedMap* best = best_alone([](const ComparedMap& map) { return map.mpe_m(); });
      best != nullptr && !std::isnan(joint.mpe_m()))
    words += fmt::format(
        " By the ground truth it is {} the best map of a single sensor: MPE {}, compared with {} "
        "of "
        "{}.",
        comparison(joint.mpe_m(), best->mpe_m(), kMuchMpe * best->mpe_m()),
        error_text(joint.mpe_m()), error_text(best->mpe_m()), best->what);
  return words;
}

/// The joint map, then the map of each sensor, then those by the joint map's method, with their
/// criteria.
JointMapResult compared_maps(const MixedMap& made, const std::vector<ObservationHistory>& histories,
                             const Reference& reference, AffineFit fit) {
  JointMapResult mixed;
  const auto add = [&](const std::string& what, std::size_t s, MapOrigin origin,
                       const Embedding& embedding) {
    mixed.maps.push_back(compared(what, histories[s], std::move(origin), embedding));
    align_and_score(mixed.maps.back().record, embedding.coordinates, reference, fit);
  };
  FromSensors all{{}, made.setting};
  for (const ObservationHistory& history : histories) all.sensors.push_back(history.sensor);
  add("joint map", 0, std::move(all), made.joint);
  mixed.maps.front().is_joint = true;
  std::vector<Eigen::MatrixXd> distances;
  std::vector<double> weights;
  for (std::size_t s = 0; s < made.sensors.size(); ++s) {
    const MixedSensor& sensor = made.sensors[s];
    add(std::string(name(sensor.sensor)) + " alone", s,
        FromSensor{histories[s].sensor, sensor.setting}, sensor.own);
    distances.push_back(sensor.distances);
    weights.push_back(sensor.weight);
  }
  for (std::size_t s = 0; s < made.sensors.size(); ++s)
    if (const MixedSensor& sensor = made.sensors[s]; sensor.by_order.coordinates.size() > 0)
      add(std::string(name(sensor.sensor)) + " alone, by order", s,
          FromSensor{histories[s].sensor, sensor.setting}, sensor.by_order);
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

/// The joint map compared with the map of each sensor: weights, criteria, errors where known, and
/// which is better, in words.
Section mixed_section(const JointMapResult& mixed, const std::string& judged) {
  Section section{"mixed", "Several sensors in one map", {}};
  section.blocks.emplace_back(
      Paragraph{{{"Weights are r / (1 - r) of each sensor's reliability r, the correlation of its "
                  "distances from both halves of its steps; shares are those of the pairs' inverse "
                  "variances about the joint map. " +
                  judged}}});
  Table table{"mixed-maps",
              "The joint map and the map of each sensor",
              {{"Map", "", "", ""},
               {"Method", "", "", ""},
               {"Steps", "", "", ""},
               {"Reliability", "", "",
                "Correlation of the distances from both halves, stepped up "
                "to all steps."},
               {"Weight", "", "", "In the mean distances that the joint map starts from."},
               {"Share", "", "", "In the weights of the joint map's pairs."},
               {"Continuity", "", "", "Share of all sensors' neighbourhoods that the map keeps."},
               {"MPE", "m", "", "Where the ground truth is known."},
               {"MOE", "%", "", "Where the ground truth is known."}},
              {},
              {}};
  for (std::size_t k = 0; k < mixed.maps.size(); ++k) {
    const ComparedMap& map = mixed.maps[k];
    const std::size_t sensors = mixed.sensors.sensors.size();
    const bool own = k >= 1 && k <= sensors;
    Row row;
    row.source = map.record.id;
    row.cells = {TextCell{map.what}, TextCell{label(*setting_of(map.record))},
                 NumberCell{static_cast<double>(map.record.step), 0}};
    const SensorShare share = own ? mixed.sensors.sensors[k - 1] : SensorShare{};
    for (const double value : {share.reliability, share.weight, share.share})
      row.cells.emplace_back(NumberCell{own ? value : kNaN, 3});
    row.cells.emplace_back(NumberCell{map.continuity, 3});
    const std::optional<Score>& score = map.record.score;
    row.cells.emplace_back(NumberCell{map.mpe_m(), 3});
    row.cells.emplace_back(NumberCell{score ? score->moe_unmirrored_percent : kNaN, 2});
    table.rows.push_back(std::move(row));
  }
  table.notes.emplace_back(
      "By order: the joint map's method on one sensor only; what it gains is not due to the joint "
      "map.");
  section.blocks.emplace_back(std::move(table));
  return section;
}

/// The same for --json.
nlohmann::ordered_json mixed_json(const JointMapResult& mixed) {
  nlohmann::ordered_json object = {{"sensors", nlohmann::ordered_json::array()},
                                   {"maps", nlohmann::ordered_json::array()}};
  for (const SensorShare& one : mixed.sensors.sensors)
    object["sensors"].push_back({{"sensor", name(one.sensor)},
                                 {"reliability", one.reliability},
                                 {"weight", one.weight},
                                 {"share", one.share}});
  for (const ComparedMap& map : mixed.maps)
    object["maps"].push_back({{"map", map.what},
                              {"method", method_name(map.record)},
                              {"continuity", number_or_null(map.continuity)},
                              {"mpe_m", number_or_null(map.mpe_m())}});
  return object;
}

/// The maps side by side; empty if there are fewer than two.
std::optional<Figure> mixed_figure(const JointMapResult& mixed) {
  const MapRecord& joint = mixed.maps.front().record;
  MapGridSpec spec{.id = std::string(kSensorsFigure),
                   .title = "The joint map and the map of each sensor",
                   .maps = {}};
  const std::size_t shown = 1 + mixed.sensors.sensors.size();
  for (std::size_t k = 0; k < std::min(shown, mixed.maps.size()); ++k) {
    MapRecord record = mixed.maps[k].record;
    if (record.estimate.array().isNaN().all() || record.frame != joint.frame) continue;
    // Shapes without a frame are aligned to one another.
    if (k > 0 && joint.frame == Frame::kSimilarity) {
      const std::optional<Points> laid = aligned_to(record.estimate, joint.estimate);
      if (!laid) continue;
      record.estimate = *laid;
    }
    spec.maps.push_back({mixed.maps[k].what, std::move(record)});
  }
  if (spec.maps.size() < 2) return std::nullopt;
  return map_pair_figure(spec);
}

/// Maps what several sensors observed into one (see mixed_map()), and compares it with each
/// sensor's own. The first sensor leads: its ground truth, if it has one.
MapDraft embed_jointly(MapDraft draft, const MapJob& job) {
  const auto* sources = std::get_if<Sources>(&draft.observed);
  if (sources == nullptr) return draft;
  std::vector<ObservationHistory> histories;
  for (const ObservationSource& source : *sources) histories.push_back(source.history);
  const MixedMap made = mixed_map(histories, 0, job.setting, job.embedder);
  draft.setting = made.setting;
  take_embedding(draft, made.joint);
  JointMapResult mixed = compared_maps(made, histories, draft.reference, job.affine_fit());
  const std::string judged = verdict(mixed.maps);
  MapResult& result = draft.result;
  result.remarks.push_back(judged);
  result.sections.push_back(mixed_section(mixed, judged));
  result.members.push_back({"mixed", mixed_json(mixed)});
  if (std::optional<Figure> figure = mixed_figure(mixed))
    result.figures.push_back(*std::move(figure));
  result.sensors = std::move(mixed.sensors);
  return draft;
}

}  // namespace

const MapStep kCommonLandmarks{take_common_landmarks};
const MapStep kJointMap{.take = embed_jointly, .figure = kSensorsFigure};

}  // namespace mapproof
