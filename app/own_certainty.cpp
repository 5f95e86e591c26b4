#include "app/own_certainty.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "core/certainty/map_bootstrap.hpp"
#include "core/trials/pair_bootstrap.hpp"

namespace mapproof {
namespace {

bool is_empty(const MapRecord& record, std::vector<std::string>& remarks) {
  const bool empty = record.estimate.array().isNaN().all();
  if (empty) remarks.emplace_back("No map came out: there are no ellipses.");
  return empty;
}

void remark_without(const MapCertainty& certainty, std::vector<std::string>& remarks) {
  const auto without = std::ranges::count_if(
      certainty.covariances, [](const Eigen::Matrix2d& C) { return !C.allFinite(); });
  if (without > 0)
    remarks.push_back(
        fmt::format("{} of {} landmarks have no ellipse: fewer than half of the {} maps of steps "
                    "drawn anew hold them.",
                    without, certainty.covariances.size(), certainty.maps));
}

}  // namespace

std::optional<MapCertainty> own_certainty(const MapRecord& record,
                                          const ObservationHistory& history,
                                          const HistoryCertaintyOptions& options,
                                          std::vector<std::string>& remarks) {
  if (is_empty(record, remarks)) return std::nullopt;
  const bool tied = record.frame == Frame::kTruth;
  const CertaintyFrame frame{.positions_m = tied ? *record.truth_m : record.estimate,
                             .anchors = tied ? record.anchors : std::vector<Eigen::Index>{}};
  MapCertainty certainty = history_certainty(history, record.step, frame, options);
  remark_without(certainty, remarks);
  return certainty;
}

std::optional<MapCertainty> own_pair_certainty(const MapRecord& record, const SightingLog& log,
                                               bool rigid, int replicates,
                                               std::vector<std::string>& remarks) {
  if (is_empty(record, remarks)) return std::nullopt;
  const bool tied = record.frame == Frame::kTruth && !rigid && !record.anchors.empty();
  PairBootstrapOptions options{.positions_m = tied ? *record.truth_m : record.estimate,
                               .anchors = tied ? record.anchors : std::vector<Eigen::Index>{},
                               .replicates = replicates};
  options.block_looks = std::clamp(options.block_looks, 1, std::max(1, log.steps / 3));
  MapCertainty certainty;
  certainty.covariances = pair_covariances(log, options);
  certainty.squared_radius = squared_radius(
      certainty.confidence, bootstrap_freedom(log.steps, options.block_looks, replicates));
  certainty.replicates = certainty.maps = replicates;
  certainty.block_steps = options.block_looks;
  remark_without(certainty, remarks);
  return certainty;
}

}  // namespace mapproof
