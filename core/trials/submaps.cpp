#include <chrono>
#include <cmath>
#include <set>
#include <string>

#include <fmt/format.h>

#include "core/base/not_finite.hpp"
#include "core/experiment/scored_map.hpp"
#include "core/missing/filled.hpp"
#include "core/simulate/missing_entries.hpp"
#include "core/simulate/sensors.hpp"
#include "core/submaps/submap_embedding.hpp"
#include "core/trials/topics.hpp"

namespace mapproof {
namespace {

using Clock = std::chrono::steady_clock;

constexpr const char* kSize = "size";
constexpr const char* kOverlap = "overlap";
constexpr const char* kSubmapsRange = "sensor-range";
constexpr const char* kFilled = "-filled";  ///< Ends the series whose missing data PPCA fills.

std::vector<MethodSetting> settings_of(const TrialExperiment& experiment) {
  const double K = number_option(experiment, "neighbours");
  return {{Method::kSmacofKnn, K}, {Method::kIsomap, K}, {Method::kSde, K}};
}

std::string series_id(bool whole, const MethodSetting& setting) {
  return fmt::format("{}-{}", whole ? "whole" : "parts", info(setting.method).name);
}

TrialDesign submaps_design(const TrialExperiment& experiment) {
  TrialDesign design;
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
      design.series.push_back({series_id(whole, setting),
                               fmt::format("{}, {}", whole ? "Whole" : "Parts", label(setting))});
  for (const bool whole : {true, false}) {
    const MethodSetting setting = settings_of(experiment).front();
    design.series.push_back(
        {series_id(whole, setting) + kFilled,
         fmt::format("{}, PPCA, {}", whole ? "Whole" : "Parts", label(setting))});
  }
  design.quantities = {
      known_quantity("mpe_m"), known_quantity("moe_unmirrored_percent"),
      study_quantity("mapped_percent", "Landmarks mapped", "%", Better::kHigher),
      study_quantity("residual_percent", "Residual of the joins", "%", Better::kLower)};
  return design;
}

/// The setting at one level: whole or in parts of some size and overlap.
struct Way {
  SubmapOptions parts;
  bool whole = false;
};

ProximityRule filled_by_ppca() {
  return [](const ObservationHistory& history, Eigen::Index steps) {
    return filled_proximities(history, steps, {}).proximities;
  };
}

class Trials {
 public:
  Trials(const TrialContext& context, TrialPart& part) : context_(context), part_(part) {}

  void add(const Condition& at, const ObservationHistory& history, const MethodSetting& setting,
           const Way& way) {
    const Clock::time_point start = Clock::now();
    SubmapEmbedding made;
    if (way.whole)
      made.embedding = HistoryEmbedder(history, history.steps(), {}, way.parts.rule).embed(setting);
    else
      made = embed_submaps(history, history.steps(), setting, way.parts);
    const double seconds = std::chrono::duration<double>(Clock::now() - start).count();
    const std::string series = series_id(way.whole, setting) + (way.parts.rule ? kFilled : "");
    part_.seconds.push_back({part_.id, series, seconds});
    const ScoredMap map = scored_map(made.embedding, context_.world->landmarks_m, context_.anchors,
                                     AffineFit::kLeastSquares);
    const double mapped = 100.0 * map.positions_m.array().col(0).isFinite().cast<double>().mean();
    const double unknown = kNaN;
    Trial trial{.at = at,
                .series = series,
                .values = {{"mpe_m", map.score ? map.score->mpe_m : unknown},
                           {"moe_unmirrored_percent",
                            map.score ? map.score->moe_unmirrored_percent : unknown},
                           {"mapped_percent", mapped}},
                .statuses = map.statuses};
    if (!way.whole && !std::isnan(made.median_residual))
      trial.values["residual_percent"] = 100.0 * made.median_residual;
    part_.trials.push_back(std::move(trial));
  }

 private:
  const TrialContext& context_;
  TrialPart& part_;
};

/// All methods at one level of size or overlap.
void add_level(const TrialContext& context, const TrialSetup& setup, double level,
               const ObservationHistory& history, Trials& trials) {
  Way way;
  way.parts.groups.size = static_cast<int>(number_option(context.experiment, "usual_size"));
  if (setup.id == kSize) way.parts.groups.size = static_cast<int>(level);
  if (setup.id == kOverlap) way.parts.groups.overlap_share = level / 100.0;
  for (const bool whole : {true, false})
    for (const MethodSetting& setting : settings_of(context.experiment)) {
      way.whole = whole;
      trials.add(condition_at(setup, level), history, setting, way);
    }
}

TrialPart make_submaps(const TrialContext& context) {
  TrialPart part{.id = context.part, .run = context.run, .trials = {}, .maps = {}, .seconds = {}};
  Random random(context.seed);
  const ObservationHistory history =
      observe(*context.world, *context.path, {.sensor = Sensor::kBearing}, random);
  const Losses losses = range_losses(*context.world, *context.path);
  Trials trials(context, part);
  for (const TrialSetup& setup : submaps_design(context.experiment).setups)
    for (const double level : levels_of(setup)) {
      if (setup.id != kSubmapsRange) {
        add_level(context, setup, level, history, trials);
        continue;
      }
      const ObservationHistory incomplete = with_missing(history, losses, level / 100.0);
      add_level(context, setup, level, incomplete, trials);
      Way way{.parts = {.groups = {}, .embedder = {}, .rule = filled_by_ppca()}, .whole = true};
      way.parts.groups.size = static_cast<int>(number_option(context.experiment, "usual_size"));
      trials.add(condition_at(setup, level), incomplete, settings_of(context.experiment).front(),
                 way);
      way.whole = false;
      trials.add(condition_at(setup, level), incomplete, settings_of(context.experiment).front(),
                 way);
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
