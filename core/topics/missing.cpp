#include <algorithm>
#include <cmath>
#include <string>

#include <fmt/format.h>

#include "core/base/not_finite.hpp"
#include "core/base/stopwatch.hpp"
#include "core/embed/embedder.hpp"
#include "core/experiment/scored_map.hpp"
#include "core/missing/covisible.hpp"
#include "core/missing/filled.hpp"
#include "core/missing/missing_pattern.hpp"
#include "core/simulate/missing_entries.hpp"
#include "core/simulate/sensors.hpp"
#include "core/topics/topics.hpp"

namespace mapproof {
namespace {

constexpr const char* kAtRandom = "at-random";
constexpr const char* kLimitedRange = "sensor-range";
constexpr const char* kOcclusion = "occlusion";

/// The fillings in the order of the tables, with their labels.
constexpr std::pair<Filling, const char*> kFillings[] = {
    {Filling::kPairwiseComplete, "Pairwise-complete"},
    {Filling::kPpca, "PPCA"},
    {Filling::kPca, "PCA with missing data"},
    {Filling::kMean, "Means"}};
constexpr const char* kExpected = "ppca-expected";
constexpr const char* kCovisible = "covisible";
constexpr const char* kAuto = "auto";

MethodSetting smacof_of(const TopicExperiment& experiment) {
  return {Method::kSmacofKnn, number_option(experiment, "smacof_neighbours")};
}

/// The methods that a filling is combined with.
std::vector<MethodSetting> settings_of(const TopicExperiment& experiment, Filling filling) {
  if (filling == Filling::kMean) return {smacof_of(experiment)};
  return {smacof_of(experiment), {Method::kIsomap, number_option(experiment, "isomap_neighbours")}};
}

/// Without the parameter, which the experiment fixes.
std::string method_words(const MethodSetting& setting) {
  return setting.method == Method::kSmacofKnn ? "kNN-SMACOF" : "ISOMAP";
}

std::string method_id(Filling filling, const MethodSetting& setting) {
  return fmt::format("{}-{}", name(filling), info(setting.method).name);
}

std::vector<double> percent(const std::vector<double>& shares) {
  std::vector<double> levels;
  for (const double share : shares) levels.push_back(std::round(1e4 * share) / 100.0);
  return levels;
}

TopicDesign missing_design(const TopicExperiment& experiment) {
  TopicDesign design;
  const auto factors = [&](const char* option) {
    return std::vector<SetupFactor>{
        {"missing_percent", "share missing", "%", percent(list_option(experiment, option))}};
  };
  design.setups = {
      {kAtRandom, "Entries missing at random", factors("shares_at_random")},
      {kLimitedRange, "Distant landmarks not observed", factors("shares_sensor_range")},
      {kOcclusion, "Landmarks hidden by others", factors("shares_occlusion")}};
  for (const auto& [filling, words] : kFillings)
    for (const MethodSetting& setting : settings_of(experiment, filling))
      design.methods.push_back(
          {method_id(filling, setting), fmt::format("{}, {}", words, method_words(setting))});
  design.methods.push_back({kExpected, "PPCA, expected squares, kNN-SMACOF"});
  design.methods.push_back({kCovisible, "Covisible pairs, SMACOF of relative errors"});
  design.methods.push_back(
      {kAuto, "The strategy that the pattern of missing data suggests, kNN-SMACOF"});
  design.quantities = {
      known_quantity("mpe_m"), known_quantity("moe_unmirrored_percent"),
      study_quantity("mapped_percent", "Share of landmarks mapped", "%", Better::kHigher)};
  return design;
}

std::map<std::string, double> values_of(const ScoredMap& map) {
  const auto mapped = (map.positions_m.array().col(0).isNaN() == false).count();
  const double share = 100.0 * static_cast<double>(mapped) /
                       static_cast<double>(std::max<Eigen::Index>(map.positions_m.rows(), 1));
  return {{"mpe_m", map.score ? map.score->mpe_m : kNaN},
          {"moe_unmirrored_percent", map.score ? map.score->moe_unmirrored_percent : kNaN},
          {"mapped_percent", share}};
}

/// One history with missing data, mapped with every strategy.
class IncompleteHistory {
 public:
  IncompleteHistory(const TopicTask& context, const ObservationHistory& history,
                    const TopicSetup& setup, double level, TopicPart& part)
      : context_(context),
        setup_(setup),
        level_(level),
        part_(part),
        all_(history.landmarks()),
        seen_(seen_landmarks(history, history.steps())) {
    history_ = with_rows(history, seen_);
    options_.ppca.dimensions = options_.pca.dimensions =
        static_cast<int>(number_option(context.experiment, "dimensions"));
  }

  void map() {
    if (seen_.size() < 3) return;
    for (const auto& [filling, words] : kFillings) map_filled(filling);
    add_advised();
    if (setup_.id == kAtRandom)
      return;  // data missing at random have no information on what is near
    const CovisibleOptions options{
        .neighbours = static_cast<int>(number_option(context_.experiment, "covisible_neighbours"))};
    add(kCovisible, relative_stress_map(covisible_proximities(history_, steps(), options)), {});
  }

 private:
  /// The outcome of the strategy that the pattern of missing data suggests, once more under its own
  /// name. For bearings that is never covisible pairs.
  void add_advised() {
    const StrategyAdvice advice =
        advised_strategy(missing_pattern(history_, steps()), history_.sensor);
    const Filling filling =
        advice.strategy == MissingStrategy::kPpca ? Filling::kPpca : Filling::kPairwiseComplete;
    const std::string id = method_id(filling, smacof_of(context_.experiment));
    const auto found = std::ranges::find_if(part_.outcomes, [&](const TopicOutcome& outcome) {
      return outcome.method == id && outcome.at == at();
    });
    if (found == part_.outcomes.end()) return;
    TopicOutcome outcome = *found;
    outcome.method = kAuto;
    part_.outcomes.push_back(std::move(outcome));
  }

  void map_filled(Filling filling) {
    options_.filling = filling;
    const Stopwatch stopwatch;
    const FilledProximities filled = filled_proximities(history_, steps(), options_);
    const double seconds = stopwatch.seconds();
    const MethodSetting smacof = smacof_of(context_.experiment);
    part_.seconds.push_back({part_.id, method_id(filling, smacof), seconds});
    Embedder embedder(filled.proximities);
    for (const MethodSetting& setting : settings_of(context_.experiment, filling)) {
      const ScoredMap map =
          add(method_id(filling, setting), embedder.embed(setting), filled.statuses);
      if (shown(filling) && setting == smacof) show(method_id(filling, setting), setting, map);
    }
    if (filling != Filling::kPpca) return;
    Embedder expected(filled_from(features(history_, steps()), history_.sensor, filled.model,
                                  CompletedDistances::kExpected));
    add(kExpected, expected.embed(smacof), filled.statuses);
  }

  /// Adds the result of one method; returns its map.
  ScoredMap add(const std::string& method, Embedding embedding,
                const std::vector<Status>& statuses) {
    const Points mapped = std::move(embedding.coordinates);
    embedding.coordinates.setConstant(all_, 2, kNaN);
    embedding.coordinates(seen_, Eigen::all) = mapped;
    embedding.statuses.insert(embedding.statuses.begin(), statuses.begin(), statuses.end());
    ScoredMap map = scored_map(embedding, context_.world->landmarks_m, context_.anchors,
                               AffineFit::kLeastSquares);
    part_.outcomes.push_back({at(), method, values_of(map), map.statuses});
    return map;
  }

  /// Maps at the highest level of each setup: with missing data left, and filled by PPCA.
  bool shown(Filling filling) const {
    return context_.with_maps && level_ == levels_of(setup_).back() &&
           (filling == Filling::kPairwiseComplete || filling == Filling::kPpca);
  }

  void show(const std::string& method, const MethodSetting& setting, const ScoredMap& map) {
    const std::string id = fmt::format("{}-{}", setup_.id, method);
    part_.maps.push_back({.id = id,
                          .at = at(),
                          .method = method,
                          .map = map_record({.id = id,
                                             .origin = FromSensor{history_.sensor, setting},
                                             .step = static_cast<int>(steps()),
                                             .names = landmark_names(all_),
                                             .ground_truth_m = context_.world->landmarks_m,
                                             .anchors = context_.anchors},
                                            map),
                          .pairs = {},
                          .uncertainty = {}});
  }

  Eigen::Index steps() const { return history_.steps(); }
  Condition at() const { return condition_at(setup_, level_); }

  const TopicTask& context_;
  const TopicSetup& setup_;
  double level_;
  TopicPart& part_;
  Eigen::Index all_;
  std::vector<Eigen::Index> seen_;
  ObservationHistory history_;  ///< Of the landmarks seen alone.
  FillingOptions options_;
};

Losses losses_of(const TopicSetup& setup, const TopicTask& context, Random& random) {
  if (setup.id == kLimitedRange) return range_losses(*context.world, *context.path);
  if (setup.id == kOcclusion) return occlusion_losses(*context.world, *context.path);
  return random_losses(context.world->landmarks_m.rows(), context.path->positions_m.rows(), random);
}

TopicPart make_missing(const TopicTask& context) {
  TopicPart part{.id = context.part, .run = context.run, .outcomes = {}, .maps = {}, .seconds = {}};
  Random random(context.seed);
  const ObservationHistory history =
      observe(*context.world, *context.path, {.sensor = Sensor::kBearing}, random);
  const TopicDesign plan = missing_design(context.experiment);
  for (const TopicSetup& setup : plan.setups) {
    const Losses losses = losses_of(setup, context, random);
    for (const double level : levels_of(setup))
      IncompleteHistory(context, with_missing(history, losses, level / 100.0), setup, level, part)
          .map();
  }
  return part;
}

}  // namespace

const Topic kMissingTopic = {
    .name = "missing",
    .of_data = false,
    .options = {{"shares_at_random", {0, 0.1, 0.3, 0.5, 0.7}, 0, 0.95, false, true},
                {"shares_sensor_range", {0.1, 0.3, 0.5, 0.7, 0.89}, 0, 0.95, false, true},
                {"shares_occlusion", {0.1, 0.3, 0.5, 0.7}, 0, 0.95, false, true},
                {"dimensions", {10}, 1, 100, true, false},
                {"smacof_neighbours", {8}, 1, 1000, true, false},
                {"isomap_neighbours", {9}, 1, 1000, true, false},
                {"covisible_neighbours", {8}, 1, 1000, true, false}},
    .design = missing_design,
    .make = make_missing,
    .data_sets = nullptr};

}  // namespace mapproof
