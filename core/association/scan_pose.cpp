#include "core/association/scan_pose.hpp"

#include <cmath>

#include "core/pairs/pair_graph.hpp"

namespace mapproof {

ScanPose::ScanPose(const std::vector<Eigen::RowVector2d>& mapped_m,
                   const std::vector<Eigen::RowVector2d>& seen_m) {
  const auto count = static_cast<double>(seen_m.size());
  for (std::size_t k = 0; k < seen_m.size(); ++k) {
    seen_mean_m_ += seen_m[k] / count;
    mapped_mean_m_ += mapped_m[k] / count;
  }
  double sine = 0.0;
  double cosine = 0.0;
  double squares = 0.0;
  for (std::size_t k = 0; k < seen_m.size(); ++k) {
    const Eigen::RowVector2d seen = seen_m[k] - seen_mean_m_;
    const Eigen::RowVector2d mapped = mapped_m[k] - mapped_mean_m_;
    sine += cross(mapped, seen);
    cosine += mapped.dot(seen);
    squares += mapped.squaredNorm();
  }
  extent_m_ = std::sqrt(squares / count);
  const double length = std::hypot(sine, cosine);
  if (length > 0.0) turn_ << cosine / length, sine / length, -sine / length, cosine / length;
}

}  // namespace mapproof
