#include <cmath>
#include <optional>

#include <fmt/format.h>

#include "core/association/correspondence.hpp"
#include "core/base/not_finite.hpp"
#include "core/base/random.hpp"
#include "core/base/stopwatch.hpp"
#include "core/embed/embedder.hpp"
#include "core/experiment/scored_map.hpp"
#include "core/simulate/sensors.hpp"
#include "core/topics/topics.hpp"

namespace mapproof {
namespace {

using Mask = Eigen::Array<bool, Eigen::Dynamic, Eigen::Dynamic>;

constexpr const char* kUnassociated = "unassociated";
constexpr const char* kConfused = "confused";
constexpr const char* kStretches = "stretches";

constexpr const char* kGiven = "given";
constexpr const char* kLeftOut = "left-out";
constexpr const char* kEstimated = "estimated";

TopicDesign association_design(const TopicExperiment& experiment) {
  TopicDesign design;
  std::vector<double> percent;
  for (const double share : list_option(experiment, "shares")) percent.push_back(100.0 * share);
  const std::vector<SetupFactor> factors = {
      {"confused_percent", "confused landmark IDs", "%", std::move(percent)}};
  design.setups = {{kUnassociated, "Measurements without a landmark ID", factors},
                   {kConfused, "Measurements under a wrong landmark ID, not known which", factors},
                   {kStretches, "Landmarks confused over stretches, not known which", factors}};
  design.methods = {{kGiven, "Landmark IDs as given"},
                    {kLeftOut, "Doubtful measurements left out"},
                    {kEstimated, "Data association estimated"}};
  design.quantities = {
      study_quantity("correct_percent", "Share of confused IDs corrected", "%", Better::kHigher),
      known_quantity("mpe_m"), known_quantity("moe_unmirrored_percent")};
  return design;
}

/// A history some of whose landmark IDs were permuted.
struct Confused {
  ObservationHistory history;
  Mask confused;  ///< M x N: took part in the permutation.
};

/// Permutes the measurements of the marked rows of one step.
void deal(Confused& to, Eigen::Index step, const std::vector<Eigen::Index>& order) {
  const Eigen::VectorXd before = to.history.values.col(step);
  std::size_t next = 0;
  for (Eigen::Index row = 0; row < before.size(); ++row)
    if (to.confused(row, step)) to.history.values(row, step) = before(order[next++]);
}

/// The rows that are permuted, at random, in a random order.
std::vector<Eigen::Index> drawn(Eigen::Index rows, double share, Random& random,
                                std::vector<char>& marked) {
  std::vector<Eigen::Index> order;
  marked.assign(static_cast<std::size_t>(rows), 0);
  for (Eigen::Index row = 0; row < rows; ++row)
    if (random.uniform() < share) {
      marked[static_cast<std::size_t>(row)] = 1;
      order.push_back(row);
    }
  for (std::size_t k = order.size(); k-- > 1;)
    std::swap(order[k],
              order[static_cast<std::size_t>(random.uniform() * static_cast<double>(k + 1))]);
  return order;
}

/// @param stretch  So many steps have the same permutation.
Confused confused_history(const ObservationHistory& ground_truth, double share,
                          Eigen::Index stretch, Random& random) {
  Confused result{ground_truth,
                  Mask::Constant(ground_truth.landmarks(), ground_truth.steps(), false)};
  std::vector<Eigen::Index> order;
  std::vector<char> marked;
  for (Eigen::Index step = 0; step < ground_truth.steps(); ++step) {
    if (step % stretch == 0) order = drawn(ground_truth.landmarks(), share, random, marked);
    for (Eigen::Index row = 0; row < ground_truth.landmarks(); ++row)
      result.confused(row, step) = marked[static_cast<std::size_t>(row)] != 0;
    deal(result, step, order);
  }
  return result;
}

/// Of the measurements that the permutation gave to another landmark, the share that is back at its
/// own; empty without any.
std::optional<double> correct_percent(const ObservationHistory& found,
                                      const ObservationHistory& ground_truth,
                                      const ObservationHistory& given) {
  const Mask wrong = given.values.array() != ground_truth.values.array();
  const auto all = wrong.count();
  if (all == 0) return std::nullopt;
  const auto right = (wrong && (found.values.array() == ground_truth.values.array())).count();
  return 100.0 * static_cast<double>(right) / static_cast<double>(all);
}

/// One confused history, mapped with every strategy.
class ConfusedMaps {
 public:
  ConfusedMaps(const TopicTask& context, const ObservationHistory& ground_truth,
               const TopicSetup& setup, double level, TopicPart& part)
      : context_(context), ground_truth_(ground_truth), setup_(setup), level_(level), part_(part) {}

  void map(const Confused& confused) {
    const bool known = setup_.id == kUnassociated;
    add(kGiven, confused.history, confused);
    if (known) {
      ObservationHistory left = confused.history;
      left.values = confused.confused.select(kNaN, left.values);
      add(kLeftOut, left, confused);
    }
    const Stopwatch stopwatch;
    const Mask all = Mask::Constant(ground_truth_.landmarks(), ground_truth_.steps(), true);
    CorrespondenceOptions options{
        .rank = static_cast<Eigen::Index>(number_option(context_.experiment, "dimensions")),
        .most_rounds = static_cast<int>(number_option(context_.experiment, "rounds"))};
    if (!known) options.change_cost = number_option(context_.experiment, "change_cost");
    if (setup_.id == kStretches)
      options.stretch = std::llround(number_option(context_.experiment, "assumed_stretch"));
    const Correspondence found =
        estimated_correspondence(confused.history, known ? confused.confused : all, options);
    part_.seconds.push_back({part_.id, kEstimated, stopwatch.seconds()});
    add(kEstimated, found.history, confused);
  }

 private:
  void add(const char* method, const ObservationHistory& history, const Confused& confused) {
    HistoryEmbedder embedder(history, history.steps());
    const MethodSetting setting{Method::kSmacofKnn,
                                number_option(context_.experiment, "neighbours")};
    const ScoredMap map = scored_map(embedder.embed(setting), context_.world->landmarks_m,
                                     context_.anchors, AffineFit::kLeastSquares);
    const double none = kNaN;
    TopicOutcome outcome{.at = condition_at(setup_, level_),
                         .method = method,
                         .values = {{"mpe_m", map.score ? map.score->mpe_m : none},
                                    {"moe_unmirrored_percent",
                                     map.score ? map.score->moe_unmirrored_percent : none}},
                         .statuses = map.statuses};
    if (outcome.method == kEstimated)
      if (const auto correct = correct_percent(history, ground_truth_, confused.history))
        outcome.values["correct_percent"] = *correct;
    part_.outcomes.push_back(std::move(outcome));
    if (context_.with_maps && level_ == levels_of(setup_).back() &&
        method != std::string_view(kLeftOut))
      show(method, setting, map);
  }

  void show(const char* method, const MethodSetting& setting, const ScoredMap& map) {
    const std::string id = fmt::format("{}-{}", setup_.id, method);
    TopicMap shown;
    shown.id = id;
    shown.at = condition_at(setup_, level_);
    shown.method = method;
    shown.map = map_record({.id = id,
                            .origin = FromSensor{ground_truth_.sensor, setting},
                            .step = static_cast<int>(ground_truth_.steps()),
                            .names = ground_truth_.names,
                            .ground_truth_m = context_.world->landmarks_m,
                            .anchors = context_.anchors},
                           map);
    part_.maps.push_back(std::move(shown));
  }

  const TopicTask& context_;
  const ObservationHistory& ground_truth_;
  const TopicSetup& setup_;
  double level_;
  TopicPart& part_;
};

TopicPart make_association(const TopicTask& context) {
  TopicPart part{.id = context.part, .run = context.run, .outcomes = {}, .maps = {}, .seconds = {}};
  Random random(context.seed);
  const ObservationHistory ground_truth =
      observe(*context.world, *context.path, {.sensor = Sensor::kBearing}, random);
  const TopicDesign plan = association_design(context.experiment);
  for (const TopicSetup& setup : plan.setups)
    for (const double level : levels_of(setup)) {
      const auto stretch =
          setup.id == kStretches ? std::llround(number_option(context.experiment, "stretch")) : 1;
      ConfusedMaps(context, ground_truth, setup, level, part)
          .map(confused_history(ground_truth, level / 100.0, stretch, random));
    }
  return part;
}

}  // namespace

const Topic kAssociationTopic = {
    .name = "association",
    .of_data = false,
    .options = {{"shares", {0, 0.05, 0.1, 0.2, 0.4, 0.6}, 0, 1, false, true},
                {"stretch", {50}, 1, 1e6, true, false},
                {"dimensions", {10}, 1, 50, true, false},
                {"assumed_stretch", {10}, 1, 1e6, true, false},
                {"change_cost", {10}, 0, 1e6, false, false},
                {"rounds", {20}, 1, 1000, true, false},
                {"neighbours", {8}, 1, 1000, true, false}},
    .design = association_design,
    .make = make_association,
    .data_sets = nullptr};

}  // namespace mapproof
