#include <algorithm>
#include <cmath>
#include <optional>

#include <fmt/format.h>

#include "core/base/not_finite.hpp"
#include "core/base/random.hpp"
#include "core/base/stopwatch.hpp"
#include "core/choice/judged_maps.hpp"
#include "core/experiment/scored_map.hpp"
#include "core/score/map_score.hpp"
#include "core/simulate/sensors.hpp"
#include "core/topics/topics.hpp"

namespace mapproof {
namespace {

constexpr std::pair<const char*, Sensor> kChoiceSensors[] = {{"visibility", Sensor::kVisibility},
                                                             {"bearing", Sensor::kBearing}};
constexpr const char* kRandom = "random";
constexpr const char* kFixed = "fixed";
const MethodSetting kFixedSetting{Method::kIsomap, 6.0};

TopicDesign choice_design(const TopicExperiment& experiment) {
  TopicDesign design;
  for (const auto& [id, sensor] : kChoiceSensors)
    design.setups.push_back({id,
                             fmt::format("Picking among maps from {}", name(sensor)),
                             {steps_factor(list_option(experiment, "observations"))}});
  for (const CriterionInfo& criterion : all_criteria())
    design.methods.push_back({std::string(criterion.name), std::string(criterion.label)});
  design.methods.push_back({kFixed, label(kFixedSetting) + ", always"});
  design.methods.push_back({kRandom, "any, at random"});
  design.quantities = {
      study_quantity("regret_m", "Regret with anchors", "m", Better::kLower),
      study_quantity("regret_shape_m", "Regret without anchors", "m", Better::kLower),
      study_quantity("mpe_m", "MPE of the pick", "m", Better::kLower)};
  return design;
}

/// The errors of all maps that came out.
struct Errors {
  std::vector<double> of;  ///< NaN: no map.
  double best = HUGE_VAL;
  double mean = 0.0;

  explicit Errors(std::vector<double> values) : of(std::move(values)) {
    int count = 0;
    for (const double error : of) {
      if (std::isnan(error)) continue;
      best = std::min(best, error);
      mean += error;
      ++count;
    }
    mean = count > 0 ? mean / count : kNaN;
  }

  /// Of the first of some maps, best by some criterion first.
  double first(const std::vector<std::size_t>& order) const {
    return order.empty() ? kNaN : of[order.front()];
  }
};

/// @param fitted  Errors with the affine map fitted on all landmarks, else with that on the
/// anchors.
Errors errors_of(const std::vector<JudgedMap>& maps, const TopicTask& context, bool fitted) {
  std::vector<double> errors;
  for (const JudgedMap& map : maps) {
    const std::optional<Score> score = map.mapped
                                           ? score_map(map.positions, context.world->landmarks_m,
                                                       context.anchors, AffineFit::kLeastDistances)
                                           : std::nullopt;
    errors.push_back(!score ? kNaN : fitted ? score->mpe_all_fitted_m : score->mpe_m);
  }
  return Errors(std::move(errors));
}

/// What every criterion picks of one history's maps.
class Picks {
 public:
  Picks(const MapJudge& judge, const TopicTask& context)
      : anchored_(judge.in({context.world->landmarks_m, context.anchors})),
        shapes_(judge.in({context.world->landmarks_m, {}})),
        errors_(errors_of(anchored_, context, false)),
        shape_errors_(errors_of(shapes_, context, true)) {}

  std::vector<TopicOutcome> outcomes() const {
    std::vector<TopicOutcome> outcomes;
    for (const CriterionInfo& criterion : all_criteria()) {
      const double error = errors_.first(ranked(anchored_, criterion.criterion));
      std::optional<double> shape_error;
      if (!criterion.needs_anchors)
        shape_error = shape_errors_.first(ranked(shapes_, criterion.criterion));
      outcomes.push_back(outcome(criterion.name, error, shape_error));
    }
    outcomes.push_back(outcome(kFixed, of_fixed(errors_), of_fixed(shape_errors_)));
    outcomes.push_back(outcome(kRandom, errors_.mean, shape_errors_.mean));
    return outcomes;
  }

  /// What a criterion picks; null: there is no map.
  const JudgedMap* pick(Criterion criterion) const {
    const std::vector<std::size_t> order = ranked(anchored_, criterion);
    return order.empty() ? nullptr : &anchored_[order.front()];
  }

 private:
  /// @param shape_error  Empty: the criterion does not apply without anchors.
  TopicOutcome outcome(std::string_view method, double error,
                       std::optional<double> shape_error) const {
    TopicOutcome outcome{.at = Condition{},
                         .method = std::string(method),
                         .values = {{"regret_m", error - errors_.best}, {"mpe_m", error}},
                         .statuses = {}};
    if (shape_error) outcome.values["regret_shape_m"] = *shape_error - shape_errors_.best;
    return outcome;
  }

  double of_fixed(const Errors& errors) const {
    const auto found = std::ranges::find(anchored_, kFixedSetting, &JudgedMap::setting);
    return found == anchored_.end()
               ? kNaN
               : errors.of[static_cast<std::size_t>(found - anchored_.begin())];
  }

  std::vector<JudgedMap> anchored_;
  std::vector<JudgedMap> shapes_;
  Errors errors_;
  Errors shape_errors_;
};

/// The map that the mean rank picks.
void show_pick(const Picks& picks, const Condition& at, const ObservationHistory& history,
               Eigen::Index steps, const TopicTask& context, TopicPart& part) {
  const JudgedMap* pick = picks.pick(Criterion::kCombined);
  if (pick == nullptr) return;
  const std::string method(info(Criterion::kCombined).name);
  const std::string id = fmt::format("{}-{}", at.setup.get(), method);
  part.maps.push_back({.id = id,
                       .at = at,
                       .method = method,
                       .map = map_record({.id = id,
                                          .origin = FromSensor{history.sensor, pick->setting},
                                          .step = static_cast<int>(steps),
                                          .names = landmark_names(history.landmarks()),
                                          .ground_truth_m = context.world->landmarks_m,
                                          .anchors = context.anchors},
                                         scored_map(pick->embedding, context.world->landmarks_m,
                                                    context.anchors, AffineFit::kLeastDistances)),
                       .pairs = {},
                       .uncertainty = {}});
}

TopicPart make_choice(const TopicTask& context) {
  TopicPart part;
  for (const auto& [id, sensor] : kChoiceSensors) {
    SensorOptions options;
    options.sensor = sensor;
    Random noise(derive_seed(context.seed, {static_cast<std::uint64_t>(sensor)}));
    const ObservationHistory history = observe(*context.world, *context.path, options, noise);
    for (const double level : list_option(context.experiment, "observations")) {
      const Stopwatch stopwatch;
      const auto steps = std::min<Eigen::Index>(std::llround(level), history.steps());
      const MapJudge judge(
          history, steps,
          {.settings = usual_candidates(HistoryEmbedder(history, steps), history.landmarks()),
           .embedder = {},
           .replicates = static_cast<int>(number_option(context.experiment, "replicates")),
           .seed = context.seed});
      const Picks picks(judge, context);
      const Condition at = condition(id, {{.factor = std::string(kStepsFactor), .value = level}});
      for (TopicOutcome& outcome : picks.outcomes()) {
        outcome.at = at;
        part.outcomes.push_back(std::move(outcome));
      }
      if (context.with_maps && level == list_option(context.experiment, "observations").back())
        show_pick(picks, at, history, steps, context, part);
      add_seconds(part, info(Criterion::kCombined).name, stopwatch.seconds());
    }
  }
  return part;
}

}  // namespace

const Topic kChoiceTopic = {.name = "choice",
                            .of_data = false,
                            .options = {{"observations", {200, 500, 2000}, 10, 100000, true, true},
                                        {"replicates", {10}, 1, 1000, true, false}},
                            .design = choice_design,
                            .make = make_choice};

}  // namespace mapproof
