#include "core/topics/uncertainty.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "core/base/not_finite.hpp"
#include "core/base/random.hpp"
#include "core/base/stopwatch.hpp"
#include "core/experiment/scored_map.hpp"
#include "core/linalg/decompositions.hpp"
#include "core/simulate/robot_walk.hpp"
#include "core/simulate/sensors.hpp"
#include "core/topics/topics.hpp"
#include "core/uncertainty/block_length.hpp"
#include "core/uncertainty/map_bootstrap.hpp"

namespace mapproof {
namespace {

/// Where a landmark lies on average over the maps that have it; NaN if none has.
Points mean_map(const std::vector<Points>& maps, Eigen::Index landmarks) {
  Points mean = Points::Zero(landmarks, 2);
  Eigen::VectorXd counts = Eigen::VectorXd::Zero(landmarks);
  for (const Points& map : maps)
    for (Eigen::Index i = 0; i < landmarks; ++i)
      if (map.row(i).allFinite()) {
        mean.row(i) += map.row(i);
        counts(i) += 1.0;
      }
  return mean.array().colwise() / counts.array();
}

const std::vector<MethodSetting> kSettings = {{Method::kLpca, std::nullopt},
                                              {Method::kSmacof, std::nullopt},
                                              {Method::kSmacofKnn, 8.0},
                                              {Method::kIsomap, 8.0}};

/// Setups whose levels are numbers of steps.
constexpr std::pair<const char*, Sensor> kSensors[] = {{"bearing", Sensor::kBearing},
                                                       {"visibility", Sensor::kVisibility}};
/// The one whose levels are lengths of blocks, in the usual length.
constexpr const char* kBlocks = "blocks";
constexpr const char* kBlockLength = "block_length";

TopicDesign uncertainty_design(const TopicExperiment& experiment) {
  TopicDesign design;
  for (const auto& [id, sensor] : kSensors)
    design.setups.push_back({id,
                             fmt::format("Ellipses of maps from {}", name(sensor)),
                             {steps_factor(list_option(experiment, "observations"))}});
  design.setups.push_back(
      {kBlocks,
       "Ellipses from blocks of other lengths, bearing",
       {{kBlockLength, "relative length of the blocks", "", list_option(experiment, "blocks")}}});
  for (const MethodSetting& setting : kSettings)
    design.methods.push_back({slug(setting), label(setting)});
  design.quantities = {
      study_quantity("mean_covered_percent", "Coverage of the mean map", "%", Better::kHigher),
      study_quantity("ground_truth_covered_percent", "Coverage of the ground truth", "%",
                     Better::kHigher),
      study_quantity("bias_m", "Bias of the mean map", "m", Better::kLower),
      study_quantity("spread_m", "RMS spread of the maps", "m", Better::kLower),
      study_quantity("predicted_m", "RMS spread by the ellipses", "m", Better::kNeither)};
  return design;
}

/// One sensor's walks in one world.
class WalkedWorld {
 public:
  WalkedWorld(const TopicTask& context, Sensor sensor)
      : context_(context),
        frame_{context.world->landmarks_m, context.anchors},
        histories_(walked_histories(
            *context.world, context.experiment.walk,
            {.sensor = sensor,
             .steps = context.experiment.steps,
             .walks = static_cast<int>(number_option(context.experiment, "walks"))},
            derive_seed(context.seed, {static_cast<std::uint64_t>(sensor)}))) {}

  Eigen::Index most_steps() const { return histories_.front().steps(); }

  /// Confidence ellipses of the first walks, and their coverage.
  /// @param blocks  Their length in units of the usual one.
  TopicOutcome tried(const MethodSetting& setting, Eigen::Index steps, double blocks,
                     TopicPart& part) const {
    const Stopwatch stopwatch;
    HistoryUncertaintyOptions options{.setting = setting, .embedder = {}};
    options.replicates = static_cast<int>(number_option(context_.experiment, "replicates"));
    const auto tried = static_cast<std::size_t>(number_option(context_.experiment, "tried"));
    const std::vector<Points> maps = walked_maps(histories_, steps, frame_, options);
    std::vector<MapUncertainty> uncertainties;
    for (std::size_t w = 0; w < std::min(tried, histories_.size()); ++w) {
      const double usual = static_cast<double>(map_block_length(histories_[w], steps));
      options.block = std::clamp<Eigen::Index>(std::llround(blocks * usual), 1, steps);
      options.seed = derive_seed(context_.seed, {w});
      uncertainties.push_back(history_uncertainty(histories_[w], steps, frame_, options));
    }
    add_seconds(part, slug(setting), stopwatch.seconds());
    const Coverage found = coverage(maps, uncertainties, frame_);
    return {.at = Condition{},
            .method = slug(setting),
            .values = {{"mean_covered_percent", found.mean_percent},
                       {"ground_truth_covered_percent", found.ground_truth_percent},
                       {"bias_m", found.bias_m},
                       {"spread_m", found.spread_m},
                       {"predicted_m", found.predicted_m}},
            .statuses = {}};
  }

  /// The first walk's map with its ellipses.
  TopicMap shown(const MethodSetting& setting, const Condition& at) const {
    const ObservationHistory& history = histories_.front();
    HistoryEmbedder embedder(history, history.steps());
    TopicMap shown;
    shown.id = fmt::format("{}-{}", at.setup.get(), slug(setting));
    shown.at = at;
    shown.method = slug(setting);
    const Embedding embedding = embedder.embed(setting);
    const auto placed = in_frame(embedding.coordinates, frame_, AffineFit::kLeastDistances);
    shown.map = map_record({.id = shown.id,
                            .origin = FromSensor{history.sensor, setting},
                            .step = static_cast<int>(history.steps()),
                            .names = history.names,
                            .ground_truth_m = frame_.positions_m,
                            .anchors = frame_.anchors},
                           {.positions_m = placed.value_or(embedding.coordinates),
                            .frame = placed ? Frame::kGroundTruth : Frame::kSimilarity,
                            .statuses = embedding.statuses,
                            .score = std::nullopt});
    if (!placed) return shown;
    shown.uncertainty =
        history_uncertainty(history, history.steps(), frame_, {.setting = setting, .embedder = {}});
    return shown;
  }

 private:
  const TopicTask& context_;
  UncertaintyFrame frame_;
  std::vector<ObservationHistory> histories_;
};

void add(TopicPart& part, TopicOutcome outcome, const char* setup, const std::string& factor,
         double level) {
  outcome.at = condition(setup, {{.factor = factor, .value = level}});
  part.outcomes.push_back(std::move(outcome));
}

TopicPart make_uncertainty(const TopicTask& context) {
  TopicPart part;
  for (const auto& [id, sensor] : kSensors) {
    const WalkedWorld walked(context, sensor);
    for (const double steps : list_option(context.experiment, "observations"))
      for (const MethodSetting& setting : kSettings) {
        const auto used = std::min<Eigen::Index>(std::llround(steps), walked.most_steps());
        add(part, walked.tried(setting, used, 1.0, part), id, std::string(kStepsFactor), steps);
      }
    if (sensor == Sensor::kBearing)
      for (const double blocks : list_option(context.experiment, "blocks"))
        for (const Method method : {Method::kLpca, Method::kSmacof})
          add(part, walked.tried({method, std::nullopt}, walked.most_steps(), blocks, part),
              kBlocks, kBlockLength, blocks);
    const double most = list_option(context.experiment, "observations").back();
    if (context.with_maps)
      part.maps.push_back(walked.shown(
          kSettings[1], condition(id, {{.factor = std::string(kStepsFactor), .value = most}})));
  }
  return part;
}

}  // namespace

std::vector<ObservationHistory> walked_histories(const World& world, const WalkOptions& walk,
                                                 const WalkedSensor& walked, std::uint64_t seed) {
  std::vector<ObservationHistory> histories;
  SensorOptions options;
  options.sensor = walked.sensor;
  for (int w = 0; w < walked.walks; ++w) {
    Random random(derive_seed(seed, {static_cast<std::uint64_t>(w)}));
    const Path path = random_walk(world, walk, walked.steps, random);
    histories.push_back(observe(world, path, options, random));
  }
  return histories;
}

std::vector<Points> walked_maps(const std::vector<ObservationHistory>& histories,
                                Eigen::Index steps, const UncertaintyFrame& frame,
                                const HistoryUncertaintyOptions& options) {
  std::vector<Points> maps;
  for (const ObservationHistory& history : histories) {
    HistoryEmbedder embedder(history, steps, options.embedder);
    const Points coordinates = embedder.embed(options.setting).coordinates;
    const Points nowhere = Points::Constant(coordinates.rows(), 2, kNaN);
    maps.push_back(in_frame(coordinates, frame, options.fit).value_or(nowhere));
  }
  return maps;
}

Coverage coverage(const std::vector<Points>& maps, const std::vector<MapUncertainty>& uncertainties,
                  const UncertaintyFrame& frame) {
  const Eigen::Index M = frame.positions_m.rows();
  const Points mean = mean_map(maps, M);
  double judged = 0.0, positions = 0.0, landmarks = 0.0;
  Coverage sum;
  for (Eigen::Index i = 0; i < M; ++i) {
    if (std::ranges::find(frame.anchors, i) != frame.anchors.end()) continue;
    if (!mean.row(i).allFinite()) continue;
    const Eigen::RowVector2d ground_truth = frame.positions_m.row(i);
    sum.bias_m += (mean.row(i) - ground_truth).norm();
    landmarks += 1.0;
    for (const Points& map : maps)
      if (map.row(i).allFinite()) {
        sum.spread_m += (map.row(i) - mean.row(i)).squaredNorm();
        positions += 1.0;
      }
    for (std::size_t w = 0; w < uncertainties.size(); ++w) {
      const MapUncertainty& uncertainty = uncertainties[w];
      if (!uncertainty.covariances[static_cast<std::size_t>(i)].allFinite()) continue;
      if (!maps[w].row(i).allFinite()) continue;
      sum.predicted_m += uncertainty.covariances[static_cast<std::size_t>(i)].trace();
      sum.mean_percent += covers(uncertainty, i, maps[w].row(i), mean.row(i)) ? 100.0 : 0.0;
      sum.ground_truth_percent +=
          covers(uncertainty, i, maps[w].row(i), ground_truth) ? 100.0 : 0.0;
      judged += 1.0;
    }
  }
  // Without maps or ellipses these are 0 / 0, NaN.
  return {.mean_percent = sum.mean_percent / judged,
          .ground_truth_percent = sum.ground_truth_percent / judged,
          .bias_m = sum.bias_m / landmarks,
          .spread_m = std::sqrt(sum.spread_m / positions),
          .predicted_m = std::sqrt(sum.predicted_m / judged)};
}

const Topic kUncertaintyTopic = {.name = "uncertainty",
                                 .of_data = false,
                                 .options = {{"walks", {60}, 2, 1000, true, false},
                                             {"tried", {8}, 1, 1000, true, false},
                                             {"replicates", {100}, 10, 10000, true, false},
                                             {"observations", {500, 2000}, 10, 100000, true, true},
                                             {"blocks", {0.5, 1, 2, 4}, 0.01, 100, false, true}},
                                 .design = uncertainty_design,
                                 .make = make_uncertainty};

}  // namespace mapproof
