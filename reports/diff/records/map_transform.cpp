#include "reports/diff/records/map_transform.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "core/align/rigid.hpp"
#include "core/base/text/words.hpp"

namespace mapproof {
namespace {

/// The share of a movement that a transformation may leave. Coordinates in figures and maps of
/// three digits leave less than that.
constexpr double kLeft = 0.01;

/// The least change of a rotation or scale that is named, as a share of the spread.
constexpr double kNamed = 1e-6;

/// The rows that are finite in both.
std::pair<Points, Points> finite_rows(const Points& from, const Points& to) {
  std::vector<Eigen::Index> rows;
  for (Eigen::Index row = 0; row < std::min(from.rows(), to.rows()); ++row)
    if (from.row(row).allFinite() && to.row(row).allFinite()) rows.push_back(row);
  return {from(rows, Eigen::all), to(rows, Eigen::all)};
}

double mean_square(const Points& differences) { return differences.rowwise().squaredNorm().mean(); }

}  // namespace

std::optional<MapTransform> map_transform(const Points& from, const Points& to) {
  if (from.rows() != to.rows()) return std::nullopt;
  const auto [a, b] = finite_rows(from, to);
  if (a.rows() < 3) return std::nullopt;
  const double moved = mean_square(b - a);
  const Eigen::RowVector2d centre = a.colwise().mean();
  const Points own = a.rowwise() - centre;
  const double spread = std::sqrt(mean_square(own));
  if (!(moved > 0.0) || !(spread > 0.0)) return std::nullopt;
  MapTransform found{.points = a.rows(), .spread = spread};
  found.shift = (b.colwise().mean() - centre).norm();
  double least = kLeft * kLeft * moved;
  bool explains = false;
  for (const bool mirrored : {false, true}) {
    Points turned = own;
    if (mirrored) turned.col(0) *= -1.0;
    const Similarity fit = fit_similarity(turned, b, Alignment::kSimilarity);
    const double left = mean_square(fit(turned) - b);
    if (left > least) continue;
    explains = true;
    least = left;
    found.is_mirrored = mirrored;
    found.angle_rad = std::atan2(fit.rotation(1, 0), fit.rotation(0, 0));
    found.scale = fit.scale;
  }
  return explains ? std::optional(found) : std::nullopt;
}

std::string transform_text(const MapTransform& transform, std::string_view noun,
                           std::string_view unit) {
  std::vector<std::string> words;
  if (transform.is_mirrored)
    words.emplace_back("mirrored");
  else if (std::abs(transform.angle_rad) > kNamed)
    words.push_back(
        fmt::format("rotated by {:.3g}\u00B0", transform.angle_rad * 180.0 / std::numbers::pi));
  if (std::abs(transform.scale - 1.0) > kNamed)
    words.push_back(fmt::format("scaled by {:.4g}", transform.scale));
  if (words.empty())
    words.push_back(
        fmt::format("shifted by {:.3g}{}{}", transform.shift, unit.empty() ? "" : " ", unit));
  const std::string points = counted(transform.points, noun);
  return fmt::format("{} {}",
                     noun == "landmark" ? "the map of " + points + " is" : "all " + points + " are",
                     listed(words, words.size() + 1));
}

}  // namespace mapproof
