#include <algorithm>

#include <fmt/format.h>

#include "app/map/pipeline.hpp"
#include "core/base/errors.hpp"
#include "core/certainty/history_certainty.hpp"
#include "core/certainty/pair_certainty.hpp"
#include "reports/sections/map_report.hpp"

namespace mapproof {
namespace {

MapCertainty certainty_of(const MapDraft& draft, const MapJob& job) {
  if (const auto* scans = std::get_if<DetectionSource>(&draft.observed))
    return pair_certainty(scans->log, draft.frame,
                          {.replicates = job.ellipse_replicates, .fit = job.affine_fit()});
  return history_certainty(std::get<ObservationSource>(draft.observed).history,
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
  MapCertainty certainty;
  try {
    certainty = certainty_of(draft, job);
  } catch (const InvalidInput& problem) {
    result.warnings.push_back(fmt::format("There are no ellipses: {}.", problem.what()));
    return draft;
  }
  const auto without = std::ranges::count_if(
      certainty.covariances, [](const Eigen::Matrix2d& C) { return !C.allFinite(); });
  if (without > 0)
    result.remarks.push_back(fmt::format(
        "{} of {} landmarks have no ellipse: fewer than half of the {} maps of bootstrap "
        "resamples hold them.",
        without, certainty.covariances.size(), certainty.maps));
  result.sections.push_back(certainty_section(result.record, certainty));
  result.certainty = certainty;
  return draft;
}

}  // namespace

const MapStep kUncertainty{estimate_uncertainty};

}  // namespace mapproof
