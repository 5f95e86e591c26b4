#include "core/trials/missing.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <string>

#include <fmt/format.h>

#include "core/embed/embedder.hpp"
#include "core/experiment/scored_map.hpp"
#include "core/missing/covisible.hpp"
#include "core/missing/filled.hpp"
#include "core/missing/gap_pattern.hpp"
#include "core/simulate/gaps.hpp"
#include "core/simulate/sensors.hpp"
#include "core/trials/trial_means.hpp"

namespace mapproof {
namespace {

using Clock = std::chrono::steady_clock;

constexpr const char* kAtRandom = "at-random";
constexpr const char* kLimitedRange = "sensor-range";
constexpr const char* kOcclusion = "occlusion";

/// The fillings in the order of the tables, with their words.
constexpr std::pair<Filling, const char*> kFillings[] = {{Filling::kCommonSteps, "Common steps"},
                                                         {Filling::kPpca, "PPCA"},
                                                         {Filling::kPca, "PCA with missing data"},
                                                         {Filling::kMean, "Means"}};
constexpr const char* kExpected = "ppca-expected";
constexpr const char* kCovisible = "covisible";
constexpr const char* kAuto = "auto";

MethodSetting smacof_of(const TrialExperiment& experiment) {
  return {Method::kSmacofKnn, number_option(experiment, "smacof_neighbours")};
}

/// The methods that a filling is tried with.
std::vector<MethodSetting> settings_of(const TrialExperiment& experiment, Filling filling) {
  if (filling == Filling::kMean) return {smacof_of(experiment)};
  return {smacof_of(experiment), {Method::kIsomap, number_option(experiment, "isomap_neighbours")}};
}

/// Without the parameter, which the question tells.
std::string method_words(const MethodSetting& setting) {
  return setting.method == Method::kSmacofKnn ? "kNN-SMACOF" : "ISOMAP";
}

std::string series_id(Filling filling, const MethodSetting& setting) {
  return fmt::format("{}-{}", name(filling), info(setting.method).name);
}

std::vector<double> percent(const std::vector<double>& shares) {
  std::vector<double> levels;
  for (const double share : shares) levels.push_back(std::round(1e4 * share) / 100.0);
  return levels;
}

TrialDesign missing_design(const TrialExperiment& experiment) {
  TrialDesign design;
  design.question = fmt::format(
      "Bearings of all landmarks are simulated and a share of them is taken away: at random, those "
      "of the most distant landmarks, or those that wide landmarks hide. PPCA and PCA of {0:g} "
      "dimensions fill the gaps, the landmarks' means fill them, or distances are taken over "
      "common "
      "steps; covisible pairs are the {1:g} landmarks that each is most often observed with. "
      "kNN-SMACOF (K = {2:g}) and ISOMAP (K = {3:g}) map the distances; maps are aligned to the "
      "anchors in least squares.",
      number_option(experiment, "dimensions"), number_option(experiment, "covisible_neighbours"),
      number_option(experiment, "smacof_neighbours"),
      number_option(experiment, "isomap_neighbours"));
  const auto factors = [&](const char* option) {
    return std::vector<TrialFactor>{
        {"missing_percent", "share missing", "%", percent(list_option(experiment, option))}};
  };
  design.setups = {
      {kAtRandom, "Entries missing at random", factors("shares_at_random")},
      {kLimitedRange, "Distant landmarks not observed", factors("shares_sensor_range")},
      {kOcclusion, "Landmarks hidden by others", factors("shares_occlusion")}};
  for (const auto& [filling, words] : kFillings)
    for (const MethodSetting& setting : settings_of(experiment, filling))
      design.series.push_back(
          {series_id(filling, setting), fmt::format("{}, {}", words, method_words(setting))});
  design.series.push_back({kExpected, "PPCA, expected squares, kNN-SMACOF"});
  design.series.push_back({kCovisible, "Covisible pairs, SMACOF of relative errors"});
  design.series.push_back({kAuto, "The way that the gaps' pattern advises, kNN-SMACOF"});
  design.quantities = {known_quantity("mpe_m"), known_quantity("moe_unmirrored_percent"),
                       study_quantity("mapped_percent", "Landmarks mapped", "%", Better::kHigher)};
  return design;
}

std::vector<double> values_of(const ScoredMap& map) {
  const auto mapped = (map.positions_m.array().col(0).isNaN() == false).count();
  const double share = 100.0 * static_cast<double>(mapped) /
                       static_cast<double>(std::max<Eigen::Index>(map.positions_m.rows(), 1));
  if (!map.score) return {std::nan(""), std::nan(""), share};
  return {map.score->mpe_m, map.score->moe_unmirrored_percent, share};
}

/// One history with gaps, mapped in every way.
class GappedHistory {
 public:
  GappedHistory(const TrialContext& context, const ObservationHistory& history,
                const TrialSetup& setup, double level, TrialPart& part)
      : context_(context), setup_(setup), level_(level), part_(part), all_(history.landmarks()) {
    const std::vector<Eigen::Index> unseen = unseen_landmarks(history, history.steps());
    for (Eigen::Index i = 0; i < all_; ++i)
      if (!std::ranges::binary_search(unseen, i)) seen_.push_back(i);
    history_ = with_rows(history, seen_);
    options_.ppca.dimensions = options_.pca.dimensions =
        static_cast<int>(number_option(context.experiment, "dimensions"));
  }

  void map() {
    if (seen_.size() < 3) return;
    for (const auto& [filling, words] : kFillings) map_filled(filling);
    add_advised();
    if (setup_.id == kAtRandom) return;  // such gaps do not tell what is near
    const CovisibleOptions options{
        .neighbours = static_cast<int>(number_option(context_.experiment, "covisible_neighbours"))};
    add(kCovisible, relative_stress_map(covisible_proximities(history_, steps(), options)), {});
  }

 private:
  /// The trial of the way that the pattern of the gaps advises, once more under its own name. Of
  /// bearings that is never covisible pairs.
  void add_advised() {
    const GapAdvice advice = advised_way(gap_pattern(history_, steps()), history_.sensor);
    const Filling filling = advice.way == GapWay::kPpca ? Filling::kPpca : Filling::kCommonSteps;
    const std::string id = series_id(filling, smacof_of(context_.experiment));
    const auto found = std::ranges::find_if(
        part_.trials, [&](const Trial& trial) { return trial.series == id && trial.at == at(); });
    if (found == part_.trials.end()) return;
    Trial trial = *found;
    trial.series = kAuto;
    part_.trials.push_back(std::move(trial));
  }

  void map_filled(Filling filling) {
    options_.filling = filling;
    const Clock::time_point start = Clock::now();
    const FilledProximities filled = filled_proximities(history_, steps(), options_);
    const double seconds = std::chrono::duration<double>(Clock::now() - start).count();
    const MethodSetting smacof = smacof_of(context_.experiment);
    part_.seconds.push_back({part_.id, series_id(filling, smacof), seconds});
    Embedder embedder(filled.proximities);
    for (const MethodSetting& setting : settings_of(context_.experiment, filling)) {
      const ScoredMap map =
          add(series_id(filling, setting), embedder.embed(setting), filled.statuses);
      if (shown(filling) && setting == smacof) show(series_id(filling, setting), setting, map);
    }
    if (filling != Filling::kPpca) return;
    Embedder expected(filled_from(features(history_, steps()), history_.sensor, filled.model,
                                  GapDistances::kExpected));
    add(kExpected, expected.embed(smacof), filled.statuses);
  }

  /// Adds what came of one series; returns its map.
  ScoredMap add(const std::string& series, Embedding embedding,
                const std::vector<Status>& statuses) {
    const Points mapped = std::move(embedding.coordinates);
    embedding.coordinates.setConstant(all_, 2, std::nan(""));
    embedding.coordinates(seen_, Eigen::all) = mapped;
    embedding.statuses.insert(embedding.statuses.begin(), statuses.begin(), statuses.end());
    ScoredMap map = scored_map(embedding, context_.world->landmarks_m, context_.anchors,
                               AffineFit::kLeastSquares);
    part_.trials.push_back({at(), series, values_of(map), map.statuses});
    return map;
  }

  /// Maps at the highest level of each setup: with gaps left, and filled by PPCA.
  bool shown(Filling filling) const {
    return context_.with_maps && level_ == levels_of(setup_).back() &&
           (filling == Filling::kCommonSteps || filling == Filling::kPpca);
  }

  void show(const std::string& series, const MethodSetting& setting, const ScoredMap& map) {
    const std::string id = fmt::format("{}-{}", setup_.id, series);
    part_.maps.push_back(
        {.id = id,
         .title = fmt::format("{}, {}: {}", setup_.title, level_words(setup_, at()),
                              series_label(missing_design(context_.experiment), series)),
         .map = {.id = id,
                 .sensor = history_.sensor,
                 .setting = setting,
                 .step = static_cast<int>(steps()),
                 .frame = map.frame,
                 .names = landmark_names(all_),
                 .estimate = map.positions_m,
                 .truth_m = context_.world->landmarks_m,
                 .anchors = context_.anchors,
                 .statuses = map.statuses,
                 .certificate = std::nullopt,
                 .score = map.score},
         .pairs = {},
         .covariances = {}});
  }

  Eigen::Index steps() const { return history_.steps(); }
  Condition at() const { return condition_at(setup_, level_); }

  const TrialContext& context_;
  const TrialSetup& setup_;
  double level_;
  TrialPart& part_;
  Eigen::Index all_;
  std::vector<Eigen::Index> seen_;
  ObservationHistory history_;  ///< Of the landmarks seen alone.
  FillingOptions options_;
};

Losses losses_of(const TrialSetup& setup, const TrialContext& context, Random& random) {
  if (setup.id == kLimitedRange) return range_losses(*context.world, *context.path);
  if (setup.id == kOcclusion) return occlusion_losses(*context.world, *context.path);
  return random_losses(context.world->landmarks_m.rows(), context.path->positions_m.rows(), random);
}

TrialPart make_missing(const TrialContext& context) {
  TrialPart part{.id = context.part, .run = context.run, .trials = {}, .maps = {}, .seconds = {}};
  Random random(context.seed);
  const ObservationHistory history =
      observe(*context.world, *context.path, {.sensor = Sensor::kBearing}, random);
  const TrialDesign plan = missing_design(context.experiment);
  for (const TrialSetup& setup : plan.setups) {
    const Losses losses = losses_of(setup, context, random);
    for (const double level : levels_of(setup))
      GappedHistory(context, with_gaps(history, losses, level / 100.0), setup, level, part).map();
  }
  return part;
}

/// "PPCA, SMACOF 0.057 m; ...": the three best at one level, and the worst.
std::string ranking(const TrialStudy& study, const Condition& at) {
  std::vector<std::pair<double, std::string>> means;
  for (const TrialSeries& series : study.design.series) {
    const double mean = trial_mean(study, at, series.id, "mpe_m");
    if (!std::isnan(mean)) means.emplace_back(mean, series.label);
  }
  std::ranges::sort(means);
  constexpr std::size_t kBest = 3;
  std::string words;
  for (std::size_t k = 0; k < means.size(); ++k) {
    const bool last = k + 1 == means.size();
    if (k >= kBest && !last) continue;
    words += fmt::format("{}{} {:.3f} m",
                         k == 0               ? ""
                         : last && k >= kBest ? "; worst: "
                                              : "; ",
                         means[k].second, means[k].first);
  }
  return words;
}

/// Mean over parts and levels of one way's MPE less that of the best way there; NaN without any.
/// @param series  Its kNN-SMACOF maps, or the advised ones.
double regret_m(const TrialStudy& study, const std::string& series) {
  double sum = 0.0, count = 0.0;
  for (const TrialPart& part : study.parts)
    for (const Trial& trial : part.trials) {
      if (trial.series != series || !std::isfinite(trial.values[0])) continue;
      double best = trial.values[0];
      for (const Trial& other : part.trials)
        if (other.at == trial.at && std::isfinite(other.values[0]))
          best = std::min(best, other.values[0]);
      sum += trial.values[0] - best;
      count += 1.0;
    }
  return count > 0.0 ? sum / count : std::nan("");
}

std::string advice_words(const TrialStudy& study) {
  const MethodSetting setting = smacof_of(study.experiment);
  return fmt::format(
      "Choosing the way by the gaps' pattern costs {:.3f} m of MPE over the best map of each trial "
      "on average; common steps always cost {:.3f} m, PPCA always {:.3f} m.",
      regret_m(study, kAuto), regret_m(study, series_id(Filling::kCommonSteps, setting)),
      regret_m(study, series_id(Filling::kPpca, setting)));
}

std::vector<std::string> missing_conclusions(const TrialStudy& study) {
  std::vector<std::string> sentences;
  if (const double regret = regret_m(study, kAuto); !std::isnan(regret))
    sentences.push_back(advice_words(study));
  for (const TrialSetup& setup : study.design.setups)
    for (const double level : levels_of(setup)) {
      const Condition at = condition_at(setup, level);
      const std::string words = ranking(study, at);
      if (words.empty() || (level != levels_of(setup).back() && level != 50.0)) continue;
      sentences.push_back(
          fmt::format("{}, {}, mean MPE: {}.", setup.title, level_words(setup, at), words));
    }
  return sentences;
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
    .conclude = missing_conclusions,
    .data_sets = nullptr};

}  // namespace mapproof
