#include <algorithm>

#include <fmt/format.h>

#include "app/map/pipeline.hpp"
#include "core/base/errors.hpp"
#include "core/uncertainty/history_uncertainty.hpp"
#include "core/uncertainty/pair_uncertainty.hpp"
#include "reports/sections/map_report.hpp"

namespace mapproof {
namespace {

MapUncertainty uncertainty_of(const MapDraft& draft, const MapJob& job) {
  if (const auto* scans = std::get_if<DetectionSource>(&draft.observed))
    return pair_uncertainty(scans->log, draft.frame,
                            {.replicates = job.ellipse_replicates, .fit = job.affine_fit()});
  return history_uncertainty(std::get<ObservationSource>(draft.observed).history,
                             draft.result.record.step, draft.frame,
                             {.setting = draft.setting,
                              .embedder = job.embedder,
                              .rule = draft.distances.of_others,
                              .replicates = job.ellipse_replicates,
                              .fit = job.affine_fit()});
}

/// Ellipses of all landmarks, in the frame that the map is in, from bootstrap resamples of the
/// steps; a remark of those without one.
MapDraft estimate_uncertainty(MapDraft draft, const MapJob& job) {
  if (job.ellipse_replicates == 0) return draft;
  MapResult& result = draft.result;
  if (result.record.estimate.array().isNaN().all()) {
    result.remarks.emplace_back("There is no map, so there are no ellipses.");
    return draft;
  }
  hold_array(draft);
  MapUncertainty uncertainty;
  try {
    uncertainty = uncertainty_of(draft, job);
  } catch (const InvalidInput& problem) {
    result.warnings.push_back(fmt::format("There are no ellipses: {}.", problem.what()));
    return draft;
  }
  const auto without = std::ranges::count_if(
      uncertainty.covariances, [](const Eigen::Matrix2d& C) { return !C.allFinite(); });
  if (without > 0)
    result.remarks.push_back(fmt::format(
        "{} of {} landmarks have no ellipse: fewer than half of the {} maps of bootstrap "
        "resamples hold them.",
        without, uncertainty.covariances.size(), uncertainty.maps));
  result.sections.push_back(uncertainty_section(result.record, uncertainty));
  result.uncertainty = uncertainty;
  return draft;
}

}  // namespace

const MapStep kUncertainty{estimate_uncertainty};

}  // namespace mapproof
