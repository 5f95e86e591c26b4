#include "core/experiment/variations.hpp"

#include <algorithm>
#include <optional>
#include <utility>

#include "core/base/errors.hpp"
#include "core/base/random.hpp"
#include "core/embed/embedder.hpp"
#include "core/experiment/scored_map.hpp"
#include "core/experiment/seeds.hpp"
#include "core/simulate/sensors.hpp"
#include "core/simulate/world.hpp"

namespace mapproof {
namespace {

/// One variation in one run; keeps what its levels share.
class Varying {
 public:
  Varying(const Experiment& experiment, const Variation& variation, const Run& run,
          const Path& path)
      : experiment_(experiment), variation_(variation), run_(run), path_(path) {
    if (variation.step < 1 || variation.step > path.positions_m.rows())
      throw InvalidInput("a variation at a step that the path does not have");
  }

  void add_level(double level, std::vector<VariationRecord>& records) {
    Experiment varied = experiment_;
    set_level(varied, variation_.sensor, variation_.factor, level);
    const std::vector<Eigen::Index> anchors = anchors_of(varied);
    prepare(varied);
    for (std::size_t i = 0; i < variation_.settings.size(); ++i) {
      ScoredMap map =
          scored_map(embeddings_[i], run_.world.landmarks_m, anchors, experiment_.affine_fit);
      records.push_back({.variation = variation_.id,
                         .level = level,
                         .setting = variation_.settings[i],
                         .statuses = std::move(map.statuses),
                         .score = map.score});
    }
  }

 private:
  std::vector<Eigen::Index> anchors_of(const Experiment& varied) const {
    if (variation_.factor != Factor::kAnchors && !variation_.placement) return run_.anchors;
    // A larger number of random anchors holds the smaller one.
    Random random(
        derive_seed(experiment_.seed, {kPlacement, static_cast<std::uint64_t>(run_.id.layout)}));
    return place_anchors(run_.world, varied.anchors,
                         variation_.placement.value_or(experiment_.anchor_placement), random);
  }

  /// Observes and embeds anew where the level asks for it.
  void prepare(const Experiment& varied) {
    const bool same_history = history_ && variation_.factor != Factor::kNoise &&
                              variation_.factor != Factor::kDropoutShare;
    if (!same_history) history_ = observed(find_sensor(varied, variation_.sensor)->sensor);
    if (same_history && variation_.factor == Factor::kAnchors) return;
    HistoryEmbedder embedder(*history_, variation_.step, embedder_options(varied.solver));
    embeddings_.clear();
    for (const MethodSetting& setting : variation_.settings)
      embeddings_.push_back(embedder.embed(setting));
  }

  ObservationHistory observed(const SensorOptions& sensor) const {
    Random noise(derive_seed(
        experiment_.seed,
        {kVariationNoise, static_cast<std::uint64_t>(run_.id.layout),
         static_cast<std::uint64_t>(run_.id.pose), static_cast<std::uint64_t>(variation_.sensor)}));
    return observe(run_.world, path_, sensor, noise);
  }

  const Experiment& experiment_;
  const Variation& variation_;
  const Run& run_;
  const Path& path_;
  std::optional<ObservationHistory> history_;
  std::vector<Embedding> embeddings_;
};

}  // namespace

std::vector<VariationRecord> vary(const Experiment& experiment, const Run& run, const Path& path) {
  std::vector<VariationRecord> records;
  for (const Variation& variation : experiment.variations) {
    Varying varying(experiment, variation, run, path);
    for (const double level : variation.levels) varying.add_level(level, records);
  }
  return records;
}

}  // namespace mapproof
