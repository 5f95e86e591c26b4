#include "core/follow/incremental_map.hpp"

#include <limits>
#include <vector>

namespace mapproof {
namespace {

/// One scan puts all bearings on a circle, two on a torus: no map is told by so few.
constexpr Eigen::Index kFewestSteps = 3;

}  // namespace

FollowedUpdate IncrementalMap::update() const {
  const std::vector<Eigen::Index> seen = sums_.seen();
  FollowedUpdate result{.embedding = {}, .setting = options_.setting};
  Embedder embedder(seen.empty() ? Proximities{} : sums_.proximities_of(seen), options_.embedder);
  if (!result.setting.parameter) result.setting = embedder.usual_setting(options_.setting.method);
  result.embedding = embedder.embed(result.setting);

  Points all = Points::Constant(landmarks(), 2, std::numeric_limits<double>::quiet_NaN());
  all(seen, Eigen::all) = result.embedding.coordinates;
  result.embedding.coordinates = std::move(all);
  if (std::ssize(seen) < landmarks())
    result.embedding.statuses.push_back(
        status_of<StatusReason::kNotObservedSoFar>(landmarks() - std::ssize(seen), landmarks()));
  if (steps() < kFewestSteps)
    result.embedding.statuses.push_back(status_of<StatusReason::kFewSteps>(steps(), kFewestSteps));
  return result;
}

}  // namespace mapproof
