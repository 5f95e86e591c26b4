#include "core/range_slam/refinement/refine_options.hpp"

#include <fmt/format.h>

namespace mapproof {
namespace {

constexpr Eigen::Index kMostWithCovariances = 500;  ///< Landmarks.

}  // namespace

std::string RefineOptions::problem(Eigen::Index n) const {
  if (std::string problem = odometry.problem(); !problem.empty()) return problem;
  if (!(range_sigma_m > 0.0)) return "the standard deviation of ranges must be positive";
  if (!(huber > 0.0)) return "Huber's bound must be positive";
  if (!(offset_sigma_m >= 0.0)) return "the standard deviation of offsets cannot be negative";
  if (!(spacing_m >= 0.0 && coarse_spacing_m >= 0.0))
    return "the spacing of poses cannot be negative";
  if (most_iterations < 1) return "a refinement needs an iteration";
  if (covariances < 0) return "the number of covariances cannot be negative";
  if (covariances > 0 && n > kMostWithCovariances)
    return fmt::format("covariances are for at most {} landmarks", kMostWithCovariances);
  if (!known) return "";
  if (known->rows.size() < 2) return "known landmarks are two or more, or none";
  return known_problem(*known, n);
}

}  // namespace mapproof
