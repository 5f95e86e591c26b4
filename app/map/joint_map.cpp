#include "app/map/joint_map.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "app/map/joint_map_sources.hpp"
#include "app/map/one_sensor.hpp"
#include "core/choice/mixed_quality.hpp"
#include "core/mixed/mixed_map.hpp"

namespace mapproof {
namespace {

constexpr double kMuchContinuity = 1e-3;  ///< Maps of one quality differ by less than this,
constexpr double kMuchMpe = 0.05;         ///< or by this share of their MPE.

ComparedMap compared(const std::string& what, const ObservationHistory& history,
                     const MethodSetting& setting, const Embedding& embedding,
                     const Reference& reference, AffineFit fit) {
  ComparedMap map{.what = what, .record = {}};
  map.record.id = "map";
  map.record.origin = FromSensor{history.sensor, setting};
  map.record.step = static_cast<int>(history.steps());
  map.record.names = history.names;
  map.record.statuses = embedding.statuses;
  map.record.certificate = embedding.certificate;
  align_and_score(map.record, embedding.coordinates, reference, fit);
  return map;
}

std::string number_words(double value) { return fmt::format("{:.3f}", value); }

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
  if (const ComparedMap* best = best_alone([](const ComparedMap& map) { return map.mpe_m(); });
      best != nullptr && !std::isnan(joint.mpe_m()))
    words += fmt::format(" By the truth it is {} the best single one: MPE {} m against {} m of {}.",
                         comparison(joint.mpe_m(), best->mpe_m(), kMuchMpe * best->mpe_m()),
                         number_words(joint.mpe_m()), number_words(best->mpe_m()), best->what);
  return words;
}

std::vector<Sensor> sensors_of(const std::vector<ObservationHistory>& histories) {
  std::vector<Sensor> sensors;
  for (const ObservationHistory& history : histories) sensors.push_back(history.sensor);
  return sensors;
}

/// The joint map, then each sensor's own, then those by the joint map's way, with what speaks for
/// each.
JointMapResult compared_maps(const MixedMap& made, const std::vector<ObservationHistory>& histories,
                             const Reference& reference, AffineFit fit) {
  JointMapResult mixed;
  const auto add = [&](const std::string& what, std::size_t s, const MethodSetting& setting,
                       const Embedding& embedding) {
    mixed.maps.push_back(compared(what, histories[s], setting, embedding, reference, fit));
  };
  add("joint map", 0, made.setting, made.joint);
  mixed.maps.front().is_joint = true;
  mixed.maps.front().record.id = "joint";
  mixed.maps.front().record.origin = FromSensors{sensors_of(histories), made.setting};
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

double ComparedMap::mpe_m() const {
  if (!record.score) return std::numeric_limits<double>::quiet_NaN();
  return std::isnan(record.score->mpe_m) ? record.score->mpe_all_fitted_m : record.score->mpe_m;
}

MapResult map_mixed(const std::vector<ObservationSource>& sources,
                    const std::optional<NamedPointsFile>& anchors,
                    const std::optional<NamedPointsFile>& truth, const MapOptions& options) {
  const std::vector<std::string> names = joint_names(sources);
  const std::vector<ObservationHistory> histories = common_histories(sources, names, options);
  MapResult result{.record = {}, .remarks = {}, .joined = {}, .read = {}};
  describe_sources(sources, names, result);
  const MappedLandmarks landmarks{.path = sources.front().path,
                                  .names = names,
                                  .unseen = unseen_by_all(sources, histories, options, result),
                                  .truth_m = common_truth(sources, names)};
  const Reference reference = reference_of(landmarks, anchors, truth, result.remarks);
  begin_map(options,
            {.id = "joint",
             .origin = FromSensors{sensors_of(histories), options.setting},
             .step = static_cast<int>(histories.front().steps()),
             .names = names},
            reference);
  EmbedderOptions fitting;
  fitting.only_seen_together = options.only_seen_together;
  const MixedMap made = mixed_map(histories, 0, options.setting, fitting);
  JointMapResult mixed = compared_maps(made, histories, reference, options.fit);
  const std::string judged = verdict(mixed.maps);
  mixed.sensors.why =
      "Weights are r / (1 - r) of each sensor's reliability r, the correlation of its distances "
      "from both halves of its steps; shares are those of the pairs' inverse variances about the "
      "joint map. " +
      judged;
  result.remarks.push_back(judged);
  result.record = mixed.maps.front().record;
  result.mixed = std::move(mixed);
  return result;
}

}  // namespace mapproof
