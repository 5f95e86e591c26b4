#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/base/not_finite.hpp"
#include "core/base/random.hpp"
#include "core/choice/mixed_quality.hpp"
#include "core/embed/embedder.hpp"
#include "core/mixed/mixed_distances.hpp"
#include "core/mixed/mixed_map.hpp"
#include "core/score/map_score.hpp"
#include "core/simulate/sensors.hpp"
#include "core/topics/topics.hpp"

namespace mapproof {
namespace {

constexpr const char* kBearingNoise = "bearing-noise";
constexpr const char* kVisibilityErrors = "visibility-errors";
constexpr const char* kRangeToo = "range-too";
/// Factors, and options of the same names.
constexpr const char* kNoiseFactor = "bearing_noise_deg";
constexpr const char* kErrorsFactor = "visibility_errors_percent";

TopicDesign mixed_design(const TopicExperiment& experiment) {
  TopicDesign design;
  const SetupFactor noise{kNoiseFactor, "noise of bearings", "°",
                          list_option(experiment, kNoiseFactor)};
  const SetupFactor errors{kErrorsFactor, "share of wrong visibility entries", "%",
                           list_option(experiment, kErrorsFactor)};
  design.setups = {
      {kBearingNoise, "Visibility with bearings of more and more noise", {noise}},
      {kVisibilityErrors, "Bearings with visibility that errs more and more", {errors}},
      {kRangeToo, "Visibility, bearing and range", {noise}}};
  for (const Sensor sensor : {Sensor::kVisibility, Sensor::kBearing, Sensor::kRange}) {
    const std::string id(name(sensor));
    design.methods.push_back({id, id + " alone"});
    design.methods.push_back({id + "-order", id + " alone, order of distances"});
  }
  for (const auto& [id, label] :
       {std::pair{"equal", "mean distance, equal weights"},
        std::pair{"reliable", "mean distance, weighted"}, std::pair{"joint", "joint map"}})
    design.methods.push_back({id, label});
  design.quantities = {
      known_quantity("mpe_m"), known_quantity("moe_percent"),
      study_quantity("continuity", "Continuity over all sensors", "", Better::kHigher)};
  return design;
}

MethodSetting single_setting(Sensor sensor) {
  return sensor == Sensor::kVisibility ? MethodSetting{Method::kIsomap, 6.0}
                                       : MethodSetting{Method::kSmacofKnn, 8.0};
}

/// Histories of one walk, mapped singly and together.
class MixedMaps {
 public:
  MixedMaps(const TopicTask& context, Condition at, TopicPart& part)
      : context_(context), at_(std::move(at)), part_(part) {}

  void add(const SensorOptions& options) {
    Random noise(derive_seed(context_.seed, {static_cast<std::uint64_t>(options.sensor)}));
    histories_.push_back(observe(*context_.world, *context_.path, options, noise));
  }

  void run() {
    const MethodSetting setting{Method::kSmacofKnn, 8.0};
    std::vector<MethodSetting> own;
    for (const ObservationHistory& history : histories_)
      own.push_back(single_setting(history.sensor));
    const MixedMap made = mixed_map(histories_, 0, setting, {}, own);
    std::vector<Eigen::MatrixXd> squared;
    for (const MixedSensor& sensor : made.sensors) {
      distances_.push_back(sensor.distances);
      squared.push_back(sensor.distances.cwiseAbs2());
      weights_.push_back(sensor.weight);
    }
    for (const MixedSensor& sensor : made.sensors) {
      const std::string id(name(sensor.sensor));
      record(id, sensor.own);
      if (!sensor.own.coordinates.allFinite()) return;  // Nothing to mix.
      // The joint map's method on the one sensor: its gain must not be taken for that of mixing.
      if (sensor.by_order.coordinates.rows() > 0) record(id + "-order", sensor.by_order);
    }
    const std::vector<double> equal(squared.size(), 1.0);
    record("equal", Embedder(mixed_proximities(squared, equal)).embed(setting));
    record("reliable", made.mean);
    if (made.mean.coordinates.allFinite()) record("joint", made.joint);
  }

 private:
  void record(const std::string& method, const Embedding& embedding) {
    const Points& ground_truth = context_.world->landmarks_m;
    const AlignedMap map = align_to_anchors(embedding.coordinates, ground_truth, context_.anchors,
                                            AffineFit::kLeastDistances);
    TopicOutcome outcome{
        .at = at_,
        .method = method,
        .values = {{"mpe_m", kNaN},
                   {"moe_percent", kNaN},
                   {"continuity", mixed_continuity(distances_, weights_, embedding.coordinates)}},
        .statuses = embedding.statuses};
    outcome.statuses.insert(outcome.statuses.end(), map.statuses.begin(), map.statuses.end());
    if (map.aligned)
      if (const auto score = score_map(map.positions_m, ground_truth, context_.anchors,
                                       AffineFit::kLeastDistances)) {
        outcome.values["mpe_m"] = score->mpe_m;
        outcome.values["moe_percent"] = score->moe_percent;
      }
    part_.outcomes.push_back(std::move(outcome));
  }

  const TopicTask& context_;
  Condition at_;
  TopicPart& part_;
  std::vector<ObservationHistory> histories_;
  std::vector<Eigen::MatrixXd> distances_;  ///< Of each.
  std::vector<double> weights_;
};

double in_rad(double degrees) { return degrees * std::numbers::pi / 180.0; }

TopicPart make_mixed(const TopicTask& context) {
  TopicPart part;
  const TopicExperiment& experiment = context.experiment;
  const double usual_deg = number_option(experiment, "usual_bearing_noise_deg");
  for (const double degrees : list_option(experiment, kNoiseFactor)) {
    MixedMaps outcomes(context, condition(kBearingNoise, {{kNoiseFactor, degrees}}), part);
    outcomes.add({.sensor = Sensor::kVisibility});
    outcomes.add({.sensor = Sensor::kBearing, .noise = in_rad(degrees)});
    outcomes.run();
  }
  for (const double percent : list_option(experiment, kErrorsFactor)) {
    MixedMaps outcomes(context, condition(kVisibilityErrors, {{kErrorsFactor, percent}}), part);
    outcomes.add({.sensor = Sensor::kVisibility, .noise = percent / 100.0});
    outcomes.add({.sensor = Sensor::kBearing, .noise = in_rad(usual_deg)});
    outcomes.run();
  }
  for (const double degrees : list_option(experiment, kNoiseFactor)) {
    MixedMaps outcomes(context, condition(kRangeToo, {{kNoiseFactor, degrees}}), part);
    outcomes.add({.sensor = Sensor::kVisibility});
    outcomes.add({.sensor = Sensor::kBearing, .noise = in_rad(degrees)});
    outcomes.add({.sensor = Sensor::kRange, .noise = number_option(experiment, "range_noise_m")});
    outcomes.run();
  }
  return part;
}

}  // namespace

const Topic kMixedTopic = {
    .name = "mixed",
    .of_data = false,
    .options = {{"bearing_noise_deg", {0, 10, 20, 40}, 0, 180, false, true},
                {"visibility_errors_percent", {0, 2, 5, 10}, 0, 50, false, true},
                {"usual_bearing_noise_deg", {20}, 0, 180, false, false},
                {"range_noise_m", {0.1}, 0, 100, false, false}},
    .design = mixed_design,
    .make = make_mixed};

}  // namespace mapproof
