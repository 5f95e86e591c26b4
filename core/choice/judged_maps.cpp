#include "core/choice/judged_maps.hpp"

#include <algorithm>
#include <cmath>

#include "core/align/aligned_to.hpp"
#include "core/base/errors.hpp"
#include "core/base/not_finite.hpp"
#include "core/choice/map_quality.hpp"
#include "core/embed/connected_graph.hpp"
#include "core/graph/shortest_paths.hpp"
#include "core/score/map_score.hpp"
#include "core/statistics/block_bootstrap.hpp"
#include "core/uncertainty/block_length.hpp"
#include "core/uncertainty/map_bootstrap.hpp"
#include "core/uncertainty/resampled_maps.hpp"

namespace mapproof {
namespace {

constexpr int kGraphNeighbours = 8;
constexpr int kNeighbourhood = 10;

bool failed(const Embedding& embedding) {
  return std::ranges::find(embedding.statuses, StatusCode::kFailed, &Status::code) !=
         embedding.statuses.end();
}

/// The mean of the ranks by all criteria that have a value for every map.
void combine(std::vector<JudgedMap>& maps) {
  std::vector<double> sums(maps.size(), 0.0);
  int criteria = 0;
  for (const CriterionInfo& one : all_criteria()) {
    const bool reported = std::ranges::all_of(maps, [&](const JudgedMap& map) {
      return !map.mapped || !std::isnan(value_of(map.values, one.criterion));
    });
    if (one.criterion == Criterion::kCombined || !reported) continue;
    const std::vector<std::size_t> order = ranked(maps, one.criterion);
    for (std::size_t rank = 0; rank < order.size(); ++rank)
      sums[order[rank]] += static_cast<double>(rank + 1);
    ++criteria;
  }
  for (std::size_t m = 0; m < maps.size(); ++m)
    if (maps[m].mapped && criteria > 0)
      value_of(maps[m].values, Criterion::kCombined) = sums[m] / criteria;
}

}  // namespace

std::span<const CriterionInfo> all_criteria() {
  static constexpr CriterionInfo kInfos[] = {
      {.criterion = Criterion::kStress,
       .name = "stress",
       .label = "Stress",
       .meaning = "share of the squared observation distances that the map's, scaled, do not have",
       .lower_is_better = true},
      {.criterion = Criterion::kResidualVariance,
       .name = "residual-variance",
       .label = "Residual variance",
       .meaning = "1 - R^2 of the map's distances and those along the neighbour graph",
       .lower_is_better = true},
      {.criterion = Criterion::kTrustworthiness,
       .name = "trustworthiness",
       .label = "Trustworthiness",
       .meaning = "whether neighbours on the map are neighbours in the observations",
       .lower_is_better = false},
      {.criterion = Criterion::kContinuity,
       .name = "continuity",
       .label = "Continuity",
       .meaning = "whether neighbours in the observations are neighbours on the map",
       .lower_is_better = false},
      {.criterion = Criterion::kStability,
       .name = "stability",
       .label = "Instability",
       .meaning = "how far maps of bootstrap resamples lie from the map, in its size",
       .lower_is_better = true},
      {.criterion = Criterion::kAnchors,
       .name = "anchors",
       .label = "Anchors left out",
       .meaning = "how far each anchor is from where the others put it, m",
       .lower_is_better = true,
       .needs_anchors = true},
      {.criterion = Criterion::kCombined,
       .name = "combined",
       .label = "Mean rank",
       .meaning = "mean of the ranks by the other criteria",
       .lower_is_better = true},
  };
  return kInfos;
}

const CriterionInfo& info(Criterion criterion) {
  return all_criteria()[static_cast<std::size_t>(criterion)];
}

Criterion usual_criterion(bool) { return Criterion::kContinuity; }

MapJudge::MapJudge(const ObservationHistory& history, Eigen::Index steps,
                   const ChoiceOptions& options)
    : fit_(options.fit) {
  if (options.replicates < 0 || options.replicates > 10000)
    throw InvalidInput("the choice needs 0 to 10,000 replicates");
  observe(history, steps, options);
  HistoryEmbedder embedder(history, steps, options.embedder, options.rule);
  for (const MethodSetting& setting : options.settings) {
    JudgedMap map{.setting = setting, .embedding = embedder.embed(setting), .positions = {}};
    map.values.fill(kNaN);
    map.mapped = !failed(map.embedding);
    maps_.push_back(std::move(map));
  }
  if (options.replicates > 0) judge_stability(history, steps, options);
}

void MapJudge::observe(const ObservationHistory& history, Eigen::Index steps,
                       const ChoiceOptions& options) {
  seen_ = seen_landmarks(history, steps);
  const auto n = std::ssize(seen_);
  if (n < 3) return;
  const ObservationHistory seen = with_rows(history, seen_);
  const Proximities found = options.rule ? options.rule(seen, steps) : proximities(seen, steps);
  distances_ = found.squared_distances.cwiseSqrt();
  const int neighbours = static_cast<int>(std::min<std::ptrdiff_t>(kGraphNeighbours, n - 1));
  const double apart = options.embedder.only_seen_together
                           ? std::sqrt(found.apart_squared) * (1.0 - 1e-12)
                           : kInfinity;
  const ConnectedGraph graph =
      connected_neighbour_graph(distances_, {.neighbours = neighbours, .cutoff = apart});
  along_the_graph_ = shortest_paths(graph.graph);
}

/// Resamples the steps and maps them by every setting.
void MapJudge::judge_stability(const ObservationHistory& history, Eigen::Index steps,
                               const ChoiceOptions& options) {
  const Eigen::Index block = map_block_length(history, steps);
  ResampledMaps resampled(history, steps, options.embedder, options.rule);
  std::vector<double> sums(maps_.size(), 0.0);
  for (int draw = 0; draw < options.replicates; ++draw) {
    Random random(derive_seed(options.seed, {static_cast<std::uint64_t>(draw)}));
    const std::vector<Points> drawn = resampled.maps_of(
        block_resample(steps, block, BlockEnds::kCircular, random), options.settings);
    for (std::size_t m = 0; m < maps_.size(); ++m) {
      if (!maps_[m].mapped) continue;
      const double gap = relative_gap(drawn[m], maps_[m].embedding.coordinates);
      sums[m] += gap * gap;
    }
  }
  for (std::size_t m = 0; m < maps_.size(); ++m)
    if (maps_[m].mapped)
      value_of(maps_[m].values, Criterion::kStability) = std::sqrt(sums[m] / options.replicates);
}

/// Fills in the criteria that need the one map alone.
void MapJudge::judge(JudgedMap& map, const UncertaintyFrame& frame) const {
  const Points positions = map.positions(seen_, Eigen::all);
  const auto n = static_cast<int>(positions.rows());
  value_of(map.values, Criterion::kStress) = normalised_stress(distances_, positions);
  value_of(map.values, Criterion::kResidualVariance) =
      residual_variance(along_the_graph_, positions);
  if (const int neighbours = std::min(kNeighbourhood, n / 4); neighbours > 0) {
    const NeighbourhoodsKept kept = neighbourhoods_kept(distances_, positions, neighbours);
    value_of(map.values, Criterion::kTrustworthiness) = kept.trustworthiness;
    value_of(map.values, Criterion::kContinuity) = kept.continuity;
  }
  if (!frame.anchors.empty())
    value_of(map.values, Criterion::kAnchors) =
        anchors_left_out(map.embedding.coordinates, frame.positions_m, frame.anchors, fit_);
}

std::vector<JudgedMap> MapJudge::in(const UncertaintyFrame& frame) const {
  std::vector<JudgedMap> maps = maps_;
  for (JudgedMap& map : maps) {
    map.positions = map.embedding.coordinates;
    if (map.mapped && !frame.anchors.empty()) {
      const std::optional<Points> placed = in_frame(map.positions, frame, fit_);
      map.mapped = placed.has_value();
      if (placed) map.positions = *placed;
    }
    if (map.mapped)
      judge(map, frame);
    else
      map.values.fill(kNaN);
  }
  combine(maps);
  return maps;
}

std::vector<MethodSetting> usual_candidates(const HistoryEmbedder& embedder,
                                            Eigen::Index landmarks) {
  constexpr Eigen::Index kMostOfSde = 60;
  std::vector<MethodSetting> settings;
  for (const MethodInfo& method : all_methods()) {
    if (method.approximates || (method.method == Method::kSde && landmarks > kMostOfSde)) continue;
    if (!method.parameter || !method.parameter->counts_neighbours) {
      settings.push_back(embedder.usual_setting(method.method));
      continue;
    }
    for (const double K : {5.0, 6.0, 8.0, 10.0})
      if (K < static_cast<double>(landmarks) && K >= method.parameter->minimum &&
          !(method.method == Method::kHessianLle && K < 6.0) &&
          !(method.method == Method::kSde && K > 6.0))
        settings.push_back({method.method, K});
  }
  return settings;
}

std::vector<std::size_t> ranked(const std::vector<JudgedMap>& maps, Criterion criterion) {
  std::vector<std::size_t> order;
  for (std::size_t m = 0; m < maps.size(); ++m)
    if (maps[m].mapped) order.push_back(m);
  const double sign = info(criterion).lower_is_better ? 1.0 : -1.0;
  std::ranges::stable_sort(order, {}, [&](std::size_t m) {
    const double value = value_of(maps[m].values, criterion);
    return std::isnan(value) ? HUGE_VAL : sign * value;
  });
  return order;
}

}  // namespace mapproof
