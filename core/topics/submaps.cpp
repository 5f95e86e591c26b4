#include <cmath>
#include <set>
#include <string>

#include <fmt/format.h>

#include "core/base/not_finite.hpp"
#include "core/base/stopwatch.hpp"
#include "core/experiment/scored_map.hpp"
#include "core/missing/filled.hpp"
#include "core/simulate/missing_entries.hpp"
#include "core/simulate/sensors.hpp"
#include "core/submaps/submap_embedding.hpp"
#include "core/topics/topics.hpp"

namespace mapproof {
namespace {

constexpr const char* kSize = "size";
constexpr const char* kOverlap = "overlap";
constexpr const char* kSubmapsRange = "sensor-range";
constexpr const char* kFilled =
    "-filled";  ///< Ends the id of a method whose missing data PPCA fills.

std::vector<MethodSetting> settings_of(const TopicExperiment& experiment) {
  const double K = number_option(experiment, "neighbours");
  return {{Method::kSmacofKnn, K}, {Method::kIsomap, K}, {Method::kSde, K}};
}

std::string method_id(bool whole, const MethodSetting& setting) {
  return fmt::format("{}-{}", whole ? "whole" : "parts", info(setting.method).name);
}

TopicDesign submaps_design(const TopicExperiment& experiment) {
  TopicDesign design;
  const auto percent = [&](const char* option) {
    std::vector<double> levels;
    for (const double share : list_option(experiment, option))
      levels.push_back(std::round(1e4 * share) / 100.0);
    return levels;
  };
  design.setups = {
      {kSize,
       "Sub-maps by size",
       {{"submap_landmarks", "most landmarks of a sub-map", "", list_option(experiment, "sizes")}}},
      {kOverlap,
       "Sub-maps by overlap",
       {{"borrowed_percent", "share borrowed", "%", percent("overlaps")}}},
      {kSubmapsRange,
       "Distant landmarks not observed",
       {{"missing_percent", "share missing", "%", percent("shares_sensor_range")}}}};
  for (const bool whole : {true, false})
    for (const MethodSetting& setting : settings_of(experiment))
      design.methods.push_back({method_id(whole, setting),
                                fmt::format("{}, {}", label(setting), whole ? "whole" : "parts")});
  for (const bool whole : {true, false}) {
    const MethodSetting setting = settings_of(experiment).front();
    design.methods.push_back(
        {method_id(whole, setting) + kFilled,
         fmt::format("{}, PPCA, {}", label(setting), whole ? "whole" : "parts")});
  }
  design.quantities = {
      known_quantity("mpe_m"), known_quantity("moe_unmirrored_percent"),
      study_quantity("mapped_percent", "Share of landmarks mapped", "%", Better::kHigher),
      study_quantity("residual_percent", "Residual of the joins", "%", Better::kLower)};
  return design;
}

/// The setting at one level: whole or in parts of some size and overlap.
struct SubmapSetting {
  SubmapOptions parts;
  bool whole = false;
};

ProximityRule filled_by_ppca() {
  return [](const ObservationHistory& history, Eigen::Index steps) {
    return filled_proximities(history, steps, {}).proximities;
  };
}

class SubmapOutcomes {
 public:
  SubmapOutcomes(const TopicTask& context, TopicPart& part) : context_(context), part_(part) {}

  /// @param shown  The map is kept, if maps are asked for.
  void add(const Condition& at, const ObservationHistory& history, const MethodSetting& setting,
           const SubmapSetting& submaps, bool shown) {
    const Stopwatch stopwatch;
    SubmapEmbedding made;
    if (submaps.whole)
      made.embedding =
          HistoryEmbedder(history, history.steps(), {}, submaps.parts.rule).embed(setting);
    else
      made = embed_submaps(history, history.steps(), setting, submaps.parts);
    const double seconds = stopwatch.seconds();
    const std::string method =
        method_id(submaps.whole, setting) + (submaps.parts.rule ? kFilled : "");
    part_.seconds.push_back({part_.id, method, seconds});
    const ScoredMap map = scored_map(made.embedding, context_.world->landmarks_m, context_.anchors,
                                     AffineFit::kLeastSquares);
    const double mapped = 100.0 * map.positions_m.array().col(0).isFinite().cast<double>().mean();
    const double unknown = kNaN;
    TopicOutcome outcome{.at = at,
                         .method = method,
                         .values = {{"mpe_m", map.score ? map.score->mpe_m : unknown},
                                    {"moe_unmirrored_percent",
                                     map.score ? map.score->moe_unmirrored_percent : unknown},
                                    {"mapped_percent", mapped}},
                         .statuses = map.statuses};
    if (!submaps.whole && !std::isnan(made.median_residual))
      outcome.values["residual_percent"] = 100.0 * made.median_residual;
    part_.outcomes.push_back(std::move(outcome));
    if (context_.with_maps && shown) show(at, method, history, setting, map);
  }

 private:
  void show(const Condition& at, const std::string& method, const ObservationHistory& history,
            const MethodSetting& setting, const ScoredMap& map) {
    const std::string id = fmt::format("{}-{}", at.setup.get(), method);
    part_.maps.push_back({.id = id,
                          .at = at,
                          .method = method,
                          .map = map_record({.id = id,
                                             .origin = FromSensor{history.sensor, setting},
                                             .step = static_cast<int>(history.steps()),
                                             .names = landmark_names(history.landmarks()),
                                             .ground_truth_m = context_.world->landmarks_m,
                                             .anchors = context_.anchors},
                                            map),
                          .pairs = {},
                          .uncertainty = {}});
  }

  const TopicTask& context_;
  TopicPart& part_;
};

/// All methods at one level. Maps of the first method at the highest level of each setup are shown.
void add_level(const TopicTask& context, const TopicSetup& setup, double level,
               const ObservationHistory& history, SubmapOutcomes& outcomes) {
  SubmapSetting submaps;
  submaps.parts.groups.size = static_cast<int>(number_option(context.experiment, "usual_size"));
  if (setup.id == kSize) submaps.parts.groups.size = static_cast<int>(level);
  if (setup.id == kOverlap) submaps.parts.groups.overlap_share = level / 100.0;
  for (const bool whole : {true, false})
    for (const MethodSetting& setting : settings_of(context.experiment)) {
      submaps.whole = whole;
      outcomes.add(
          condition_at(setup, level), history, setting, submaps,
          level == levels_of(setup).back() && setting == settings_of(context.experiment).front());
    }
}

TopicPart make_submaps(const TopicTask& context) {
  TopicPart part{.id = context.part, .run = context.run, .outcomes = {}, .maps = {}, .seconds = {}};
  Random random(context.seed);
  const ObservationHistory history =
      observe(*context.world, *context.path, {.sensor = Sensor::kBearing}, random);
  const Losses losses = range_losses(*context.world, *context.path);
  SubmapOutcomes outcomes(context, part);
  for (const TopicSetup& setup : submaps_design(context.experiment).setups)
    for (const double level : levels_of(setup)) {
      if (setup.id != kSubmapsRange) {
        add_level(context, setup, level, history, outcomes);
        continue;
      }
      const ObservationHistory incomplete = with_missing(history, losses, level / 100.0);
      add_level(context, setup, level, incomplete, outcomes);
      SubmapSetting submaps{.parts = {.groups = {}, .embedder = {}, .rule = filled_by_ppca()},
                            .whole = true};
      submaps.parts.groups.size = static_cast<int>(number_option(context.experiment, "usual_size"));
      outcomes.add(condition_at(setup, level), incomplete, settings_of(context.experiment).front(),
                   submaps, false);
      submaps.whole = false;
      outcomes.add(condition_at(setup, level), incomplete, settings_of(context.experiment).front(),
                   submaps, false);
    }
  return part;
}

}  // namespace

const Topic kSubmapsTopic = {
    .name = "submaps",
    .of_data = false,
    .options = {{"sizes", {12, 16, 20, 30, 40}, 6, 5000, true, true},
                {"overlaps", {0.2, 0.35, 0.5, 0.65}, 0, 0.8, false, true},
                {"shares_sensor_range", {0.5, 0.7, 0.89}, 0, 0.95, false, true},
                {"usual_size", {24}, 6, 5000, true, false},
                {"neighbours", {8}, 1, 1000, true, false}},
    .design = submaps_design,
    .make = make_submaps,
    .data_sets = nullptr};

}  // namespace mapproof
