#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/model/anchor_placement.hpp"
#include "core/model/method.hpp"
#include "core/model/score.hpp"
#include "core/model/sensor.hpp"
#include "core/model/status.hpp"

namespace mapproof {

/// What a variation changes from one level to the next, everything else being as in the study.
enum class Quantity {
  kNoise,             ///< SensorOptions::noise.
  kDropoutShare,      ///< SensorOptions::dropout_share.
  kAnchors,           ///< Experiment::anchors.
  kSmacofFall,        ///< SolverOptions::smacof_relative_fall.
  kSmacofKnnFall,     ///< SolverOptions::smacof_knn_relative_fall.
  kOnlySeenTogether,  ///< SolverOptions::only_seen_together: 0 or 1.
};

/// Everything about a quantity that its readers ask.
struct QuantityInfo {
  Quantity quantity;
  std::string_view name;  ///< In files: "dropout_share".
  bool integer;
  double minimum;  ///< Inclusive.
  double maximum;  ///< Inclusive.
};

const QuantityInfo& info(Quantity quantity);

/// The quantity of that name; empty if there is none.
std::optional<Quantity> quantity_named(std::string_view name);

/// The names of all quantities, in their order.
std::vector<std::string_view> quantity_names();

/// A side study: some methods over the levels of one quantity, at one step of every run.
struct Variation {
  std::string id;  ///< [a-z][a-z0-9-]*, unique in the experiment.
  Sensor sensor = Sensor::kVisibility;
  Quantity quantity = Quantity::kNoise;
  std::vector<double> levels;  ///< Ascending.
  int step = 0;
  /// Where the anchors stand; empty: as in the experiment.
  std::optional<AnchorPlacement> placement;
  std::vector<MethodSetting> settings;
};

/// How one map of a variation came out.
struct VariationRecord {
  std::string variation;  ///< Its id.
  double level = 0.0;
  MethodSetting setting;
  std::vector<Status> statuses;
  std::optional<Score> score;  ///< Empty if no map came out.
};

}  // namespace mapproof
