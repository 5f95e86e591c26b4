#pragma once

#include <optional>
#include <string>
#include <vector>

#include "render/plot/figure.hpp"

namespace mapproof {

/// One method's errors, one a run in the order of OcclusionSpec::hidden_share.
struct OcclusionMethod {
  std::string label;
  std::string key;                                   ///< [a-z0-9-]+, unique in the figure.
  std::vector<double> mpe_m;                         ///< NaN: no score.
  std::optional<std::size_t> series = std::nullopt;  ///< As of ErrorLine.
};

struct OcclusionSpec {
  std::string id;  ///< [a-z][a-z0-9-]*.
  std::string title;
  std::vector<double>
      hidden_share;  ///< Of observations of landmarks within reach, 0 to 1, one per run.
  std::vector<OcclusionMethod> methods;
  std::vector<std::string> record_ids;
};

/// How far visibility decomposes into pairs of robot and landmark [yairi2007, eq. 4]: on how many
/// runs which share of the scans within reach is decided by a third thing, occlusion; and the error
/// of methods against that share.
/// @throws InvalidInput unless shares are in 0 to 1 and methods have an error for each.
Figure occlusion_figure(const OcclusionSpec& spec);

/// Pearson's correlation of the pairs without a NaN; NaN if there are fewer than three or one side
/// does not vary.
double correlation(const std::vector<double>& x, const std::vector<double>& y);

}  // namespace mapproof
