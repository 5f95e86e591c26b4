#include "core/trials/certainty.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>

#include <fmt/format.h>

#include "core/base/random.hpp"
#include "core/certainty/block_length.hpp"
#include "core/certainty/map_bootstrap.hpp"
#include "core/trials/certainty_walks.hpp"

namespace mapproof {
namespace {

using Clock = std::chrono::steady_clock;

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

TrialDesign certainty_design(const TrialExperiment& experiment) {
  TrialDesign design;
  for (const auto& [id, sensor] : kSensors)
    design.setups.push_back({id,
                             fmt::format("Ellipses of maps from {}", name(sensor)),
                             {steps_factor(list_option(experiment, "observations"))}});
  design.setups.push_back({kBlocks,
                           "Ellipses from blocks of other lengths, bearing",
                           {{kBlockLength, "length of the blocks, of the usual one", "",
                             list_option(experiment, "blocks")}}});
  for (const MethodSetting& setting : kSettings)
    design.series.push_back({slug(setting), label(setting)});
  design.quantities = {
      study_quantity("mean_covered_percent", "Mean in the ellipse", "%", Better::kHigher),
      study_quantity("truth_covered_percent", "Truth in the ellipse", "%", Better::kHigher),
      study_quantity("bias_m", "Mean map from the truth", "m", Better::kLower),
      study_quantity("spread_m", "Maps from the mean map (RMS)", "m", Better::kLower),
      study_quantity("told_m", "Maps from the mean map as ellipses tell", "m", Better::kLower)};
  return design;
}

/// One sensor's walks in one world.
class WalkedWorld {
 public:
  WalkedWorld(const TrialContext& context, Sensor sensor)
      : context_(context),
        frame_{context.world->landmarks_m, context.anchors},
        histories_(walked_histories(
            *context.world, context.experiment.walk, sensor, context.experiment.steps,
            static_cast<int>(number_option(context.experiment, "walks")),
            derive_seed(context.seed, {static_cast<std::uint64_t>(sensor)}))) {}

  Eigen::Index most_steps() const { return histories_.front().steps(); }

  /// Ellipses of the first walks, and how many of them hold what they should.
  /// @param blocks  Their length in units of the usual one.
  Trial tried(const MethodSetting& setting, Eigen::Index steps, double blocks,
              TrialPart& part) const {
    const Clock::time_point start = Clock::now();
    HistoryCertaintyOptions options{.setting = setting, .embedder = {}};
    options.replicates = static_cast<int>(number_option(context_.experiment, "replicates"));
    const auto tried = static_cast<std::size_t>(number_option(context_.experiment, "tried"));
    const std::vector<Points> maps = walked_maps(histories_, steps, frame_, options);
    std::vector<MapCertainty> certainties;
    for (std::size_t w = 0; w < std::min(tried, histories_.size()); ++w) {
      const double usual = static_cast<double>(map_block_length(histories_[w], steps));
      options.block = std::clamp<Eigen::Index>(std::llround(blocks * usual), 1, steps);
      options.seed = derive_seed(context_.seed, {w});
      certainties.push_back(history_certainty(histories_[w], steps, frame_, options));
    }
    add_seconds(part, slug(setting), std::chrono::duration<double>(Clock::now() - start).count());
    const Coverage found = coverage(maps, certainties, frame_);
    return {.at = {},
            .series = slug(setting),
            .values = {{"mean_covered_percent", found.mean_percent},
                       {"truth_covered_percent", found.truth_percent},
                       {"bias_m", found.bias_m},
                       {"spread_m", found.spread_m},
                       {"told_m", found.told_m}},
            .statuses = {}};
  }

  /// The first walk's map with its ellipses.
  TrialMap shown(const MethodSetting& setting, const Condition& at) const {
    const ObservationHistory& history = histories_.front();
    HistoryEmbedder embedder(history, history.steps());
    TrialMap shown;
    shown.id = fmt::format("{}-{}", at.setup, slug(setting));
    shown.at = at;
    shown.series = slug(setting);
    MapRecord& map = shown.map;
    map.id = shown.id;
    map.origin = FromSensor{history.sensor, setting};
    map.step = static_cast<int>(history.steps());
    map.names = history.names;
    map.truth_m = frame_.positions_m;
    map.anchors = frame_.anchors;
    const Embedding embedding = embedder.embed(setting);
    map.statuses = embedding.statuses;
    const auto placed = in_frame(embedding.coordinates, frame_, AffineFit::kLeastDistances);
    map.frame = placed ? Frame::kTruth : Frame::kSimilarity;
    map.estimate = placed.value_or(embedding.coordinates);
    if (!placed) return shown;
    shown.certainty =
        history_certainty(history, history.steps(), frame_, {.setting = setting, .embedder = {}});
    return shown;
  }

 private:
  const TrialContext& context_;
  CertaintyFrame frame_;
  std::vector<ObservationHistory> histories_;
};

void add(TrialPart& part, Trial trial, const char* setup, const std::string& factor, double level) {
  trial.at = condition(setup, {{.factor = factor, .value = level}});
  part.trials.push_back(std::move(trial));
}

TrialPart make_certainty(const TrialContext& context) {
  TrialPart part;
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

const Topic kCertaintyTopic = {.name = "certainty",
                               .of_data = false,
                               .options = {{"walks", {60}, 2, 1000, true, false},
                                           {"tried", {8}, 1, 1000, true, false},
                                           {"replicates", {100}, 10, 10000, true, false},
                                           {"observations", {500, 2000}, 10, 100000, true, true},
                                           {"blocks", {0.5, 1, 2, 4}, 0.01, 100, false, true}},
                               .design = certainty_design,
                               .make = make_certainty};

}  // namespace mapproof
