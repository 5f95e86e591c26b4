#include "app/map/submaps.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "core/base/words.hpp"
#include "core/submaps/submap_embedding.hpp"

namespace mapproof {
namespace {

std::string remark_on(const SubmapEmbedding& parts, Method method) {
  const auto in_tree = std::ranges::count(parts.joined.joins, true, &SubmapJoin::in_tree);
  return fmt::format(
      "Joined from {} by {}, {} of their {} in the spanning tree; the median residual of a join is "
      "{:.1f} % of its radius.",
      counted(std::ssize(parts.joined.submaps), "sub-map"),
      joined_by_affine(method) ? "affine maps" : "similarities", in_tree,
      counted(std::ssize(parts.joined.joins), "overlap"), 100.0 * parts.median_residual);
}

}  // namespace

MapEmbedding embed_observations(const ObservationHistory& history, Eigen::Index steps,
                                MethodSetting setting, const EmbedderOptions& options,
                                const ProximityRule& rule, int submaps,
                                std::optional<double> overlap) {
  if (submaps == 0) {
    HistoryEmbedder embedder(history, steps, options, rule);
    if (!setting.parameter) setting = embedder.usual_setting(setting.method);
    return {.embedding = embedder.embed(setting), .setting = setting, .joined = {}, .remarks = {}};
  }
  if (!setting.parameter)
    setting = HistoryEmbedder(history, steps, options).usual_setting(setting.method);
  SubmapOptions parts_options{.groups = {}, .embedder = options, .rule = rule};
  parts_options.groups.size = submaps;
  if (overlap) parts_options.groups.overlap_share = *overlap;
  SubmapEmbedding parts = embed_submaps(history, steps, setting, parts_options);
  MapEmbedding made{.embedding = {}, .setting = setting, .joined = {}, .remarks = {}};
  if (parts.joined.submaps.size() > 1) made.remarks.push_back(remark_on(parts, setting.method));
  made.embedding = std::move(parts.embedding);
  if (!parts.joined.submaps.empty()) made.joined = std::move(parts.joined);
  return made;
}

}  // namespace mapproof
