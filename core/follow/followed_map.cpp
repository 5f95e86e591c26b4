#include "core/follow/followed_map.hpp"

#include <algorithm>
#include <limits>

#include <fmt/format.h>

#include "core/align/laid_on.hpp"
#include "core/base/errors.hpp"
#include "core/embed/smacof.hpp"

namespace mapproof {
namespace {

/// One look puts all bearings on a circle, two on a torus: no map is told by so few.
constexpr Eigen::Index kFewestSteps = 3;

}  // namespace

FollowedMap::FollowedMap(Sensor sensor, FollowOptions options) : options_(options), sums_(sensor) {
  if (options_.whole_every < 1) throw InvalidInput("a followed map is begun anew every 1 or more");
}

/// SMACOF from the last map; empty where that would not be what the embedder does.
std::optional<Embedding> FollowedMap::warm(const Proximities& proximities,
                                           const std::vector<Eigen::Index>& seen) const {
  if (options_.setting.method != Method::kSmacof || !last_ || seen != last_seen_ ||
      !last_->allFinite() || !proximities.squared_distances.allFinite())
    return std::nullopt;
  return smacof(proximities.squared_distances.cwiseSqrt(), {}, *last_, options_.embedder.smacof);
}

FollowedUpdate FollowedMap::update(bool whole) {
  const std::vector<Eigen::Index> seen = sums_.seen();
  FollowedUpdate result{.embedding = {}, .setting = options_.setting, .gap = std::nullopt};
  const Proximities proximities = seen.empty() ? Proximities{} : sums_.proximities_of(seen);
  const std::optional<Embedding> went_on = warm(proximities, seen);
  result.whole = whole || !went_on || since_whole_ >= trusted_;
  if (result.whole) {
    Embedder embedder(proximities, options_.embedder);
    if (!result.setting.parameter) result.setting = embedder.usual_setting(options_.setting.method);
    result.embedding = embedder.embed(result.setting);
    if (went_on) result.gap = relative_gap(went_on->coordinates, result.embedding.coordinates);
    trusted_ = result.gap && *result.gap <= kFollowedWithin
                   ? std::min(2 * trusted_ + 1, options_.whole_every - 1)
                   : 0;
  } else {
    result.embedding = *went_on;
  }
  since_whole_ = result.whole ? 0 : since_whole_ + 1;
  last_ = result.embedding.coordinates;
  last_seen_ = seen;

  Points all = Points::Constant(landmarks(), 2, std::numeric_limits<double>::quiet_NaN());
  all(seen, Eigen::all) = *last_;
  result.embedding.coordinates = std::move(all);
  if (std::ssize(seen) < landmarks())
    result.embedding.statuses.push_back(
        {StatusCode::kLandmarkUnseen, fmt::format("{} of {} landmarks were not observed so far.",
                                                  landmarks() - std::ssize(seen), landmarks())});
  if (steps() < kFewestSteps)
    result.embedding.statuses.push_back(
        {StatusCode::kTooFewObservations,
         fmt::format("A map needs {} observations at least to mean anything.", kFewestSteps)});
  return result;
}

}  // namespace mapproof
