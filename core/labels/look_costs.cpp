#include "core/labels/look_costs.hpp"

#include <cmath>

namespace mapproof {
namespace {

/// Others that stand closer together tell the turn, and so a bearing, too badly: of the distance of
/// the sighting from their mean.
constexpr double kLeastExtent = 0.15;

bool located(const Sighting& seen) {
  return !std::isnan(seen.range_m) && !std::isnan(seen.bearing_rad);
}

Eigen::RowVector2d place_of(const Sighting& seen) {
  return seen.range_m * Eigen::RowVector2d(std::cos(seen.bearing_rad), std::sin(seen.bearing_rad));
}

double cross(const Eigen::RowVector2d& a, const Eigen::RowVector2d& b) {
  return a.x() * b.y() - a.y() * b.x();
}

}  // namespace

Points turned_as_seen(const LabelledLooks& looks, const std::vector<int>& labels, Points map) {
  const std::vector<Sighting>& rows = looks.log.sightings;
  double agreement = 0.0;
  for (std::size_t k = 2; k < rows.size(); ++k) {
    if (rows[k - 2].step != rows[k].step) continue;
    if (!located(rows[k]) || !located(rows[k - 1]) || !located(rows[k - 2])) continue;
    const Eigen::RowVector2d seen = place_of(rows[k - 2]);
    const Eigen::RowVector2d mapped = map.row(labels[k - 2]);
    const double turn = cross(place_of(rows[k - 1]) - seen, place_of(rows[k]) - seen) *
                        cross(map.row(labels[k - 1]) - mapped, map.row(labels[k]) - mapped);
    if (std::isfinite(turn)) agreement += std::copysign(std::sqrt(std::abs(turn)), turn);
  }
  if (agreement < 0.0) map.col(0) *= -1.0;
  return map;
}

LookCosts::LookCosts(const LabelledLooks& looks, const Points& map, double width_m)
    : looks_(looks), map_(map), width_m_(width_m) {}

std::size_t LookCosts::take(const std::vector<int>& labels, std::size_t row, int first,
                            int second) {
  const std::vector<Sighting>& rows = looks_.log.sightings;
  others_.clear();
  std::size_t end = row;
  for (; end < rows.size() && rows[end].step == rows[row].step; ++end)
    if (labels[end] != first && labels[end] != second && located(rows[end]) &&
        map_.row(labels[end]).allFinite())
      others_.emplace_back(end, labels[end]);
  if (has_pose()) set_pose();
  return end;
}

/// The rigid motion of least squares from the map to what was seen, in closed form.
void LookCosts::set_pose() {
  seen_mean_m_.setZero();
  map_mean_m_.setZero();
  const auto count = static_cast<double>(others_.size());
  for (const auto& [row, label] : others_) {
    seen_mean_m_ += place_of(looks_.log.sightings[row]) / count;
    map_mean_m_ += map_.row(label) / count;
  }
  double sine = 0.0;
  double cosine = 0.0;
  double squares = 0.0;
  for (const auto& [row, label] : others_) {
    const Eigen::RowVector2d seen = place_of(looks_.log.sightings[row]) - seen_mean_m_;
    const Eigen::RowVector2d mapped = map_.row(label) - map_mean_m_;
    sine += cross(mapped, seen);
    cosine += mapped.dot(seen);
    squares += mapped.squaredNorm();
  }
  extent_m_ = std::sqrt(squares / count);
  const double length = std::hypot(sine, cosine);
  if (length > 0.0)
    turn_ << cosine / length, sine / length, -sine / length, cosine / length;
  else
    turn_.setIdentity();
}

double LookCosts::operator()(std::size_t row, int landmark) const {
  const Sighting& sighting = looks_.log.sightings[row];
  if (others_.empty() || !located(sighting) || !map_.row(landmark).allFinite()) return 0.0;
  const Eigen::RowVector2d seen = place_of(sighting);
  if (has_pose() && extent_m_ >= kLeastExtent * (seen - seen_mean_m_).norm()) {
    const Eigen::RowVector2d expected = (map_.row(landmark) - map_mean_m_) * turn_ + seen_mean_m_;
    const Eigen::RowVector2d ahead(std::cos(sighting.bearing_rad), std::sin(sighting.bearing_rad));
    return huber_cost((seen - expected).dot(ahead), width_m_) +
           huber_cost(cross(ahead, seen - expected), width_m_);
  }
  double sum = 0.0;
  for (const auto& [other, label] : others_) {
    const double measured = (seen - place_of(looks_.log.sightings[other])).norm();
    sum += huber_cost(measured - (map_.row(landmark) - map_.row(label)).norm(), width_m_);
  }
  return sum / static_cast<double>(others_.size());
}

}  // namespace mapproof
