#include "app/map/known_so_far.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "core/base/not_finite.hpp"
#include "core/base/words.hpp"
#include "core/linalg/planarity.hpp"

namespace mapproof {
namespace {

/// Writes the positions of the landmarks that there are. @return Their rows, ascending.
std::vector<Eigen::Index> matched(const MapRecord& record, const NamedPoints& points,
                                  Points& positions_m) {
  std::vector<Eigen::Index> rows;
  for (std::size_t i = 0; i < points.names.size(); ++i) {
    const auto found = std::ranges::find(record.names, points.names[i]);
    if (found == record.names.end()) continue;
    rows.push_back(found - record.names.begin());
    positions_m.row(rows.back()) = points.positions_m.row(static_cast<Eigen::Index>(i));
  }
  std::ranges::sort(rows);
  return rows;
}

std::vector<std::string> never_seen(const MapRecord& record, const NamedPoints& points) {
  std::vector<std::string> names;
  for (const std::string& name : points.names)
    if (std::ranges::find(record.names, name) == record.names.end()) names.push_back(name);
  return names;
}

}  // namespace

Reference known_so_far(MapRecord& record, const std::optional<NamedPointsFile>& anchors,
                       const std::optional<NamedPointsFile>& truth) {
  const auto M = static_cast<Eigen::Index>(record.names.size());
  Reference known{.positions_m = Points::Constant(M, 2, kNaN), .has_truth = false, .anchors = {}};
  if (truth) known.has_truth = !matched(record, truth->points, known.positions_m).empty();
  if (!anchors) return known;
  known.anchors = matched(record, anchors->points, known.positions_m);
  std::erase_if(known.anchors,
                [&](Eigen::Index row) { return !record.estimate.row(row).allFinite(); });
  if (known.anchors.size() >= 3 &&
      planarity(known.positions_m(known.anchors, Eigen::all)) > kFlatPlanarity)
    return known;
  record.statuses.push_back(status_of<StatusReason::kFewAnchorsSoFar>(known.anchors.size()));
  known.anchors.clear();
  return known;
}

std::vector<std::string> remarks_of_reference(const MapRecord& record,
                                              const std::optional<NamedPointsFile>& anchors,
                                              const std::optional<NamedPointsFile>& truth) {
  std::vector<std::string> remarks;
  const auto add = [&](const std::optional<NamedPointsFile>& file, const char* what) {
    if (!file) return;
    if (const auto names = never_seen(record, file->points); !names.empty())
      remarks.push_back(fmt::format("{} of landmarks that were not observed, not used: {}.", what,
                                    listed(names, 11)));
  };
  add(anchors, "Anchors");
  add(truth, "True positions");
  if (!truth) return remarks;
  const std::ptrdiff_t known =
      std::ssize(truth->points.names) - std::ssize(never_seen(record, truth->points));
  if (const std::ptrdiff_t left = std::ssize(record.names) - known; left > 0)
    remarks.push_back(
        fmt::format("The true position of {} is not known.", counted(left, "landmark")));
  return remarks;
}

}  // namespace mapproof
