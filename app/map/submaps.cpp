#include <algorithm>

#include <fmt/format.h>

#include "app/map/pipeline.hpp"
#include "core/base/text/words.hpp"
#include "core/submaps/submap_embedding.hpp"
#include "render/figures/maps/submaps.hpp"

namespace mapproof {
namespace {

constexpr std::string_view kSubmapsFigure = "submaps";

std::string remark_on(const SubmapEmbedding& parts, Method method) {
  const auto in_tree = std::ranges::count(parts.joined.joins, true, &SubmapJoin::in_tree);
  return fmt::format(
      "Joined from {} by {}, {} of their {} in the spanning tree; the median residual of a join is "
      "{:.1f} % of its radius.",
      counted(std::ssize(parts.joined.submaps), "sub-map"),
      joined_by_affine(method) ? "affine maps" : "similarities", in_tree,
      counted(std::ssize(parts.joined.joins), "overlap"), 100.0 * parts.median_residual);
}

/// Embeds overlapping groups of landmarks, and joins them.
MapDraft embed_groups(MapDraft draft, const MapJob& job) {
  if (job.submaps == 0) return draft;
  hold_array(draft);
  const ObservationHistory& history = std::get<ObservationSource>(draft.observed).history;
  const Eigen::Index steps = draft.result.record.step;
  MethodSetting& setting = draft.setting;
  if (!setting.parameter)
    setting = HistoryEmbedder(history, steps, job.embedder).usual_setting(setting.method);
  DistanceNotes notes;
  SubmapOptions options{
      .groups = {}, .embedder = job.embedder, .rule = draft.distances.noting(notes)};
  options.groups.size = job.submaps;
  if (job.overlap) options.groups.overlap_share = *job.overlap;
  const SubmapEmbedding parts = embed_submaps(history, steps, setting, options);
  take_embedding(draft, parts.embedding, notes);
  MapResult& result = draft.result;
  if (parts.joined.submaps.size() > 1) result.remarks.push_back(remark_on(parts, setting.method));
  if (!parts.joined.submaps.empty())
    result.figures.push_back(
        submaps_figure(parts.joined, history.names, std::string(kSubmapsFigure)));
  return draft;
}

}  // namespace

const MapStep kSubmaps{.take = embed_groups, .figure = kSubmapsFigure};

}  // namespace mapproof
