#pragma once

#include <algorithm>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "core/model/slam/slam_experiment.hpp"
#include "core/model/slam/slam_study.hpp"
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
inline constexpr FieldRule kSteps = {.description = "Numbers of steps, ascending.",
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
  v.field("id", noise.id, described("Name of the noise model.", kId));
  if constexpr (Visitor::kReads) noise.title = noise.id;
  v.field(
      "title", noise.title,
      {.description = "For readers; by default the id.", .max_bytes = 200, .key = Key::kOptional});
  v.field("noise_m", noise.noise_m,
          {.description = "Standard deviation of a range, m.",
           .minimum = 0.0,
           .maximum = kWidest_m,
           .key = Key::kOptional});
  v.field("share", noise.share,
          described("Standard deviation of a range, as a share of it; the variances add.", kShare));
  v.field("correlation", noise.correlation,
          {.description = "Of the errors to one landmark, one step apart.",
           .minimum = 0.0,
           .maximum = 0.999,
           .key = Key::kOptional});
  v.field(
      "plain_svd", noise.plain_svd,
      described(
          "Whether the contribution of the noise to the Gram matrix is left in, as in the paper.",
          kFlag));
}

template <typename Visitor>
void fields(Visitor& v, SlamWorldOptions& world) {
  using namespace record_rules;
  v.field("landmarks", world.landmarks,
          {.description = "Number of landmarks.",
           .minimum = 4,
           .maximum = kMostRangeLandmarks,
           .key = Key::kOptional});
  v.field("known", world.known, described("The first of them have a known position.", at_least(4)));
  check_at_most(v, "known", world.known, 4, world.landmarks);
  v.field("half_width_m", world.half_width_m,
          described("Half the side of the square world, m.", kHalfWidth));
  v.field("step_m", world.step_m, described("Length of a step, m.", at_least(1e-6)));
  check_at_most(v, "step_m", world.step_m, 1e-6, world.half_width_m);
  v.field("heading_change_sigma_rad", world.heading_change_sigma_rad,
          described("Standard deviation of the heading change per step, rad.", kTurn));
}

template <typename Visitor>
void fields(Visitor& v, SlamExample& example) {
  using namespace record_rules;
  v.field("figure", example.figure, described("Id of its figure.", kId));
  v.field("steps", example.steps, described("Number of steps.", kWorldSteps));
  v.field("noise", example.noise, {.description = "Noise of the ranges."});
}

template <typename Visitor>
void fields(Visitor& v, ConvergenceOptions& convergence) {
  using namespace record_rules;
  v.field("pairs", convergence.pairs,
          {.description = "Number of random worlds.",
           .minimum = 2,
           .maximum = 100'000,
           .key = Key::kOptional});
  v.field("most_condition", convergence.most_condition,
          {.description =
               "Worlds whose known landmarks have a condition number above this are drawn again.",
           .minimum = 10.0,
           .maximum = 1e6,
           .key = Key::kOptional});
  v.field("steps", convergence.steps, kSteps);
  v.field("noises", convergence.noises,
          {.description = "Noise models that are compared.", .min_items = 1, .max_items = 20});
  check_ids(v, "noises", convergence.noises);
}

template <typename Visitor>
void fields(Visitor& v, SlamDataSet& set) {
  using namespace record_rules;
  v.field("id", set.id, described("Name of the log.", kId));
  v.field("title", set.title, {.description = "For readers.", .max_bytes = 200});
  v.field("figure", set.figure, described("Id of the figure of its path.", kId));
  v.field(
      "files", set.files,
      {.description = "Possible paths below the folder of the data; the first that exists counts.",
       .min_items = 1,
       .max_items = 20,
       .max_bytes = 1000,
       .form = &kFileBelow});
  v.field("source", set.source, {.description = "How to get the log.", .max_bytes = 1000});
  v.field("published", set.published,
          {.description = "What a paper says of the log.", .key = Key::kOptional});
}

template <typename Visitor>
void fields(Visitor& v, RangeHistoryOptions& histories) {
  using namespace record_rules;
  v.field("landmarks", histories.landmarks,
          {.description = "Number of landmarks.",
           .minimum = 4,
           .maximum = 1000,
           .key = Key::kOptional});
  v.field("steps", histories.steps, described("Number of steps.", kWorldSteps));
  v.field("noise", histories.noise, {.description = "Noise of the ranges."});
  const int most = histories.landmarks - 1;
  if constexpr (Visitor::kReads) histories.neighbours = std::min(histories.neighbours, most);
  v.field("neighbours", histories.neighbours, described("K of the methods.", at_least(1)));
  check_at_most(v, "neighbours", histories.neighbours, 1, most);
  v.field("methods", histories.methods, described("Mapping methods on the ranges.", kKinds));
  if constexpr (Visitor::kReads) std::ranges::sort(histories.methods);
}

template <typename Visitor>
void fields(Visitor& v, SpaceFlightOptions& space) {
  using namespace record_rules;
  v.field("landmarks", space.landmarks,
          {.description = "Number of landmarks.",
           .minimum = 5,
           .maximum = kMostRangeLandmarks,
           .key = Key::kOptional});
  if constexpr (Visitor::kReads) space.known = std::min(space.known, space.landmarks);
  v.field("known", space.known, described("The first of them have a known position.", at_least(5)));
  check_at_most(v, "known", space.known, 5, space.landmarks);
  v.field("steps", space.steps,
          {.description = "Number of steps.",
           .minimum = 13,
           .maximum = 100'000,
           .key = Key::kOptional});
  v.field("half_width_m", space.half_width_m,
          described("Half the side of the square world, m.", kHalfWidth));
  if constexpr (Visitor::kReads)
    space.height_m = std::min(space.height_m, 2.0 * space.half_width_m);
  v.field("height_m", space.height_m, described("Height of the world, m.", at_least(1e-3)));
  check_at_most(v, "height_m", space.height_m, 1e-3, 2.0 * space.half_width_m);
  if constexpr (Visitor::kReads) space.step_m = std::min(space.step_m, 0.5 * space.height_m);
  v.field("step_m", space.step_m, described("Length of a step, m.", at_least(1e-6)));
  check_at_most(v, "step_m", space.step_m, 1e-6, 0.5 * space.height_m);
  v.field("heading_change_sigma_rad", space.heading_change_sigma_rad,
          described("Standard deviation of the direction's change per step about each axis, rad.",
                    kTurn));
  v.field("noise", space.noise, {.description = "Noise of the ranges."});
}

template <typename Visitor>
void fields(Visitor& v, FactorizationGrid& grid) {
  FieldRule landmarks = record_rules::kSteps;
  landmarks.minimum = 4;
  landmarks.maximum = kMostRangeLandmarks;
  landmarks.description = "Numbers of landmarks, ascending.";
  v.field("landmarks", grid.landmarks, landmarks);
  v.field("steps", grid.steps, record_rules::kSteps);
}

/// Sizes that no single number shows.
std::optional<RecordFault> fault_of(const SlamExperiment& experiment);

template <typename Visitor>
void fields(Visitor& v, SlamExperiment& experiment) {
  using namespace record_rules;
  v.file("mapproof.slam_experiment", "A range-only experiment.");
  name_fields(v, experiment);
  v.field("seed", experiment.seed,
          {.description = "Of all random numbers: the same seed gives the same study.",
           .key = Key::kOptional});
  v.field("world", experiment.world,
          {.description = "The simulated worlds.", .key = Key::kOptional});
  v.field("example", experiment.example, {.description = "One world to show.", .key = Key::kIfAny});
  v.field("convergence", experiment.convergence,
          {.description = "Errors over random worlds as measurements arrive.", .key = Key::kIfAny});
  v.field("data", experiment.data,
          {.description = "Logs that are not part of the program.",
           .max_items = 100,
           .key = Key::kOptional});
  check_ids(v, "data", experiment.data);
  v.field("methods", experiment.methods, described("Methods that are run on each log.", kKinds));
  if constexpr (Visitor::kReads) std::ranges::sort(experiment.methods);
  v.field("random_starts", experiment.random_starts,
          {.description = "Random starts of the refinement on each log.",
           .minimum = 1,
           .maximum = 1000,
           .key = Key::kOptional});
  v.field("histories", experiment.histories,
          {.description = "Mapping methods on the ranges of one world.", .key = Key::kIfAny});
  v.field("space", experiment.space,
          {.description = "A flight over landmarks in space.", .key = Key::kIfAny});
  v.field("factorization", experiment.factorization,
          {.description = "Sizes at which factorisation and upgrade are timed.",
           .key = Key::kOptional,
           .written = !experiment.factorization.steps.empty()});
  if constexpr (Visitor::kReads)
    if (const auto fault = fault_of(experiment)) v.refuse(fault->pointer, fault->what);
}

/// What study.json of a range-only study holds.
struct SlamStudyStart {
  SlamExperiment experiment;
  Provenance provenance;
};

/// The head of a study: study.json.
template <typename Visitor>
void fields(Visitor& v, SlamStudyStart& head) {
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
SlamStudyStart parse_slam_study(std::string_view text, const std::string& source);

}  // namespace mapproof
