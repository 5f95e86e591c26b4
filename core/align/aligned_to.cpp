#include "core/align/aligned_to.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/align/rigid.hpp"
#include "core/base/errors.hpp"

namespace mapproof {
namespace {

std::vector<Eigen::Index> rows_of_both(const Points& a, const Points& b) {
  if (a.rows() != b.rows()) throw InvalidInput("the two maps have different numbers of landmarks");
  std::vector<Eigen::Index> both;
  for (Eigen::Index i = 0; i < a.rows(); ++i)
    if (a.row(i).allFinite() && b.row(i).allFinite()) both.push_back(i);
  return both;
}

}  // namespace

std::optional<Points> aligned_to(const Points& points, const Points& onto) {
  const std::vector<Eigen::Index> both = rows_of_both(points, onto);
  if (both.size() < 3) return std::nullopt;
  const Points goal = onto(both, Eigen::all);
  const Similarity mirror =
      fit_similarity(points(both, Eigen::all), goal, Alignment::kRigidWithReflection);
  const Points turned = mirror(points);
  return fit_similarity(turned(both, Eigen::all), goal, Alignment::kSimilarity)(turned);
}

std::optional<Points> aligned_rigidly_to(const Points& points, const Points& onto) {
  const std::vector<Eigen::Index> both = rows_of_both(points, onto);
  if (both.size() < 3) return std::nullopt;
  return fit_similarity(points(both, Eigen::all), onto(both, Eigen::all),
                        Alignment::kRigidWithReflection)(points);
}

double relative_gap(const Points& points, const Points& onto) {
  const std::optional<Points> laid = aligned_to(points, onto);
  if (!laid) return 1.0;
  const std::vector<Eigen::Index> both = rows_of_both(*laid, onto);
  const Points goal = onto(both, Eigen::all);
  const double gap = ((*laid)(both, Eigen::all) - goal).squaredNorm();
  const double size = (goal.rowwise() - goal.colwise().mean()).squaredNorm();
  return gap < size ? std::sqrt(gap / size) : 1.0;
}

}  // namespace mapproof
