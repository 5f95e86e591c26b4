#pragma once

#include <algorithm>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "core/model/slam_experiment.hpp"
#include "core/model/slam_study.hpp"
#include "core/records/experiments/experiment_json.hpp"
#include "core/records/studies/slam_fields.hpp"

namespace mapproof {

// The fields of range-only experiments and of the heads of their studies (core/json/fields.hpp).

namespace record_rules {

inline constexpr double kWidest_m = 1e6;
inline constexpr FieldRule kShare = {.minimum = 0.0, .maximum = 1.0, .key = Key::kOptional};
inline constexpr FieldRule kHalfWidth = {
    .minimum = 1e-3, .maximum = kWidest_m, .key = Key::kOptional};
inline constexpr FieldRule kTurn = {.minimum = 0.0, .maximum = 100.0, .key = Key::kOptional};
inline constexpr FieldRule kWorldSteps = {.minimum = 8, .maximum = 100'000, .key = Key::kOptional};
inline constexpr FieldRule kSteps = {.description = "Ascending.",
                                     .minimum = 8,
                                     .maximum = kMostSteps,
                                     .ascending = true,
                                     .min_items = 1,
                                     .max_items = 1000};
inline constexpr FieldRule kKinds = {.unique = true, .min_items = 1, .max_items = 100};

/// A path below the folder of the data.
inline constexpr TextForm kFileBelow = {"^(?!/|.*\\.\\.).",
                                        [](std::string_view text) {
                                          return !text.empty() && text.front() != '/' &&
                                                 text.find("..") == std::string_view::npos;
                                        },
                                        "a path below the folder of the data"};

inline FieldRule at_least(double minimum) { return {.minimum = minimum, .key = Key::kOptional}; }

}  // namespace record_rules

template <typename Visitor>
void fields(Visitor& v, RangeNoiseModel& noise) {
  using namespace record_rules;
  v.type("noise");
  v.field("id", noise.id, kId);
  if constexpr (Visitor::kReads) noise.title = noise.id;
  v.field("title", noise.title, {.max_bytes = 200, .key = Key::kOptional});
  v.field("noise_m", noise.noise_m, {.minimum = 0.0, .maximum = kWidest_m, .key = Key::kOptional});
  v.field("share", noise.share, kShare);
  v.field("correlation", noise.correlation,
          {.minimum = 0.0, .maximum = 0.999, .key = Key::kOptional});
  v.field("plain_svd", noise.plain_svd, kFlag);
}

template <typename Visitor>
void fields(Visitor& v, SlamWorldOptions& world) {
  using namespace record_rules;
  v.field("landmarks", world.landmarks,
          {.minimum = 4, .maximum = kMostLandmarks, .key = Key::kOptional});
  v.field("known", world.known, at_least(4));
  check_at_most(v, "known", world.known, 4, world.landmarks);
  v.field("half_width_m", world.half_width_m, kHalfWidth);
  v.field("step_m", world.step_m, at_least(1e-6));
  check_at_most(v, "step_m", world.step_m, 1e-6, world.half_width_m);
  v.field("heading_change_sigma_rad", world.heading_change_sigma_rad, kTurn);
}

template <typename Visitor>
void fields(Visitor& v, SlamExample& example) {
  using namespace record_rules;
  v.field("figure", example.figure, kId);
  v.field("steps", example.steps, kWorldSteps);
  v.field("noise", example.noise);
}

template <typename Visitor>
void fields(Visitor& v, ConvergenceOptions& convergence) {
  using namespace record_rules;
  v.field("pairs", convergence.pairs, {.minimum = 2, .maximum = 100'000, .key = Key::kOptional});
  v.field("most_condition", convergence.most_condition,
          {.minimum = 10.0, .maximum = 1e6, .key = Key::kOptional});
  v.field("steps", convergence.steps, kSteps);
  v.field("noises", convergence.noises, {.min_items = 1, .max_items = 20});
  check_ids(v, "noises", convergence.noises);
}

template <typename Visitor>
void fields(Visitor& v, SlamDataSet& set) {
  using namespace record_rules;
  v.field("id", set.id, kId);
  v.field("title", set.title, {.max_bytes = 200});
  v.field("figure", set.figure, kId);
  v.field("files", set.files,
          {.min_items = 1, .max_items = 20, .max_bytes = 1000, .form = &kFileBelow});
  v.field("source", set.source, {.max_bytes = 1000});
  v.field("published", set.published, {.key = Key::kOptional});
}

template <typename Visitor>
void fields(Visitor& v, RangeHistoryOptions& histories) {
  using namespace record_rules;
  v.field("landmarks", histories.landmarks, {.minimum = 4, .maximum = 1000, .key = Key::kOptional});
  v.field("steps", histories.steps, kWorldSteps);
  v.field("noise", histories.noise);
  const int most = histories.landmarks - 1;
  if constexpr (Visitor::kReads) histories.neighbours = std::min(histories.neighbours, most);
  v.field("neighbours", histories.neighbours, at_least(1));
  check_at_most(v, "neighbours", histories.neighbours, 1, most);
  v.field("methods", histories.methods, kKinds);
  if constexpr (Visitor::kReads) std::ranges::sort(histories.methods);
}

template <typename Visitor>
void fields(Visitor& v, SpaceFlightOptions& space) {
  using namespace record_rules;
  v.field("landmarks", space.landmarks,
          {.minimum = 5, .maximum = kMostLandmarks, .key = Key::kOptional});
  if constexpr (Visitor::kReads) space.known = std::min(space.known, space.landmarks);
  v.field("known", space.known, at_least(5));
  check_at_most(v, "known", space.known, 5, space.landmarks);
  v.field("steps", space.steps, {.minimum = 13, .maximum = 100'000, .key = Key::kOptional});
  v.field("half_width_m", space.half_width_m, kHalfWidth);
  if constexpr (Visitor::kReads)
    space.height_m = std::min(space.height_m, 2.0 * space.half_width_m);
  v.field("height_m", space.height_m, at_least(1e-3));
  check_at_most(v, "height_m", space.height_m, 1e-3, 2.0 * space.half_width_m);
  if constexpr (Visitor::kReads) space.step_m = std::min(space.step_m, 0.5 * space.height_m);
  v.field("step_m", space.step_m, at_least(1e-6));
  check_at_most(v, "step_m", space.step_m, 1e-6, 0.5 * space.height_m);
  v.field("heading_change_sigma_rad", space.heading_change_sigma_rad, kTurn);
  v.field("noise", space.noise);
}

template <typename Visitor>
void fields(Visitor& v, FactorizationGrid& grid) {
  FieldRule landmarks = record_rules::kSteps;
  landmarks.minimum = 4;
  landmarks.maximum = kMostLandmarks;
  v.field("landmarks", grid.landmarks, landmarks);
  v.field("steps", grid.steps, record_rules::kSteps);
}

/// Sizes that no single number shows.
std::optional<RecordFault> fault_of(const SlamExperiment& experiment);

template <typename Visitor>
void fields(Visitor& v, SlamExperiment& experiment) {
  using namespace record_rules;
  v.file("mapproof.slam_experiment", "A range-only experiment as it is ordered.");
  name_fields(v, experiment);
  v.field("seed", experiment.seed, {.key = Key::kOptional});
  v.field("world", experiment.world, {.key = Key::kOptional});
  v.field("example", experiment.example, {.key = Key::kIfAny});
  v.field("convergence", experiment.convergence, {.key = Key::kIfAny});
  v.field("data", experiment.data, {.max_items = 100, .key = Key::kOptional});
  check_ids(v, "data", experiment.data);
  v.field("methods", experiment.methods, kKinds);
  if constexpr (Visitor::kReads) std::ranges::sort(experiment.methods);
  v.field("random_starts", experiment.random_starts,
          {.minimum = 1, .maximum = 1000, .key = Key::kOptional});
  v.field("histories", experiment.histories, {.key = Key::kIfAny});
  v.field("space", experiment.space,
          {.description = "A flight over landmarks in space.", .key = Key::kIfAny});
  v.field("factorization", experiment.factorization,
          {.key = Key::kOptional, .written = !experiment.factorization.steps.empty()});
  if constexpr (Visitor::kReads)
    if (const auto fault = fault_of(experiment)) v.refuse(fault->pointer, fault->what);
}

/// What study.json of a range-only study holds.
struct SlamOrder {
  SlamExperiment experiment;
  Provenance provenance;
};

/// The head of a study: study.json.
template <typename Visitor>
void fields(Visitor& v, SlamOrder& head) {
  v.file("mapproof.slam_study",
         "study.json of a range-only study: what was asked for, and what made it.");
  v.field("experiment", head.experiment);
  v.field("provenance", head.provenance);
}

/// A range-only experiment from the text of its file, mapproof.slam_experiment
/// (docs/file-formats.md), every bound checked.
/// @param source, profile  As parse_experiment().
/// @return Methods in the order of all_slam_methods() and all_methods().
/// @throws IoError with the location if the text is no such experiment or lacks that profile.
SlamExperiment parse_slam_experiment(std::string_view text, const std::string& source,
                                     const std::string& profile = "");

/// The file that parses to exactly this experiment: canonical, every default written out.
std::string slam_experiment_json(const SlamExperiment& experiment);

/// study.json (mapproof.slam_study).
std::string slam_study_json(const SlamExperiment& experiment, const Provenance& provenance);
SlamOrder parse_slam_study(std::string_view text, const std::string& source);

}  // namespace mapproof
