#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "core/embed/embedder.hpp"
#include "core/uncertainty/history_uncertainty.hpp"

namespace mapproof {

/// Criteria of a map that need no ground truth.
enum class Criterion {
  kStress,
  kResidualVariance,
  kTrustworthiness,
  kContinuity,
  kStability,
  kAnchors,
  kCombined,
};

inline constexpr std::size_t kCriteria = 7;

struct CriterionInfo {
  Criterion criterion;
  std::string_view name;   ///< In files: "residual-variance".
  std::string_view label;  ///< In tables and figures.
  std::string_view meaning;
  bool lower_is_better;
  bool needs_anchors = false;
};

/// All of them, in the order of the enumeration.
std::span<const CriterionInfo> all_criteria();

const CriterionInfo& info(Criterion criterion);

/// One value per criterion; NaN: undetermined.
using CriterionValues = std::array<double, kCriteria>;

inline double& value_of(CriterionValues& values, Criterion criterion) {
  return values[static_cast<std::size_t>(criterion)];
}

inline double value_of(const CriterionValues& values, Criterion criterion) {
  return values[static_cast<std::size_t>(criterion)];
}

/// The criterion that picked best in the study of choice, with anchors or without.
Criterion usual_criterion(bool with_anchors);

struct ChoiceOptions {
  std::vector<MethodSetting> settings = {};  ///< With their parameters.
  EmbedderOptions embedder;
  ProximityRule rule = {};  ///< See HistoryEmbedder.
  int replicates = 20;  ///< Maps of bootstrap resamples, for the stability; 0: it is not computed.
  std::uint64_t seed = 1;
  AffineFit fit = AffineFit::kLeastDistances;
};

/// One candidate: its map and its criteria.
struct JudgedMap {
  MethodSetting setting;
  Embedding embedding;
  Points positions;  ///< M x 2: in the frame of the anchors, if there are any that serve; judged.
  bool mapped = false;  ///< Some map came out, and could be fitted to the anchors; else NaN below.
  CriterionValues values{};
};

/// Maps a history by every setting and judges the maps without ground truth.
///
/// Distances are those of the observation vectors. The residual variance is against shortest paths
/// over one graph of 8 neighbours for all; neighbourhoods are of 10, or a quarter of the landmarks.
class MapJudge {
 public:
  /// @throws InvalidInput for a bound that is broken.
  /// @note As costly as `replicates` + 1 maps by each setting.
  MapJudge(const ObservationHistory& history, Eigen::Index steps, const ChoiceOptions& options);

  /// @param frame  The anchors and their positions; without anchors the maps are judged as they
  ///               are, and nothing of the frame is read.
  /// @return In the order of the settings. kCombined is the mean of the ranks by all criteria that
  ///         have a value for every map.
  /// @throws InvalidInput for a frame of other landmarks.
  std::vector<JudgedMap> in(const UncertaintyFrame& frame) const;

 private:
  AffineFit fit_;
  std::vector<Eigen::Index> seen_;   ///< Rows of the landmarks that have distances.
  Eigen::MatrixXd distances_;        ///< Of those; infinite where there is no common step.
  Eigen::MatrixXd along_the_graph_;  ///< The same over the neighbour graph.
  std::vector<JudgedMap> maps_;      ///< With the stability alone.

  void observe(const ObservationHistory& history, Eigen::Index steps, const ChoiceOptions& options);
  void judge_stability(const ObservationHistory& history, Eigen::Index steps,
                       const ChoiceOptions& options);
  void judge(JudgedMap& map, const UncertaintyFrame& frame) const;
};

/// Methods and parameters that a choice is among, of landmarks and parameters that fit them:
/// every method; K of 5 to 10; semidefinite embeddings up to 60 landmarks, for their cost.
std::vector<MethodSetting> usual_candidates(const HistoryEmbedder& embedder,
                                            Eigen::Index landmarks);

/// The maps by one criterion, best first: rows of `maps`, successful ones alone; ties, and maps for
/// which the criterion has no value, in the order given and last.
std::vector<std::size_t> ranked(const std::vector<JudgedMap>& maps, Criterion criterion);

}  // namespace mapproof
