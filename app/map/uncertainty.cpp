#include "app/map/uncertainty.hpp"

#include <algorithm>

#include <fmt/format.h>

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

std::optional<MapCertainty> map_uncertainty(const MapRecord& record,
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

std::optional<MapCertainty> pair_map_uncertainty(const MapRecord& record, const DetectionLog& log,
                                                 const CertaintyFrame& frame,
                                                 const PairCertaintyOptions& options,
                                                 std::vector<std::string>& remarks) {
  if (is_empty(record, remarks)) return std::nullopt;
  MapCertainty certainty = pair_certainty(log, frame, options);
  remark_without(certainty, remarks);
  return certainty;
}

}  // namespace mapproof
