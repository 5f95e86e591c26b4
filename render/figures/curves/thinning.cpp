#include "render/figures/curves/thinning.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <utility>

#include "core/base/errors.hpp"
#include "core/base/median.hpp"
#include "core/base/not_finite.hpp"

namespace mapproof {
namespace {

using Eigen::Index;

constexpr double kLongPause = 10.0;  // Usual steps of time.
constexpr double kFarthest = 1e100;  // Beyond, a position is not a number to draw.

bool is_position(const Points& points, Index row) {
  return points.row(row).cwiseAbs().maxCoeff<Eigen::PropagateNaN>() < kFarthest;
}

/// Distance of a point from the piece of line between two others.
double distance_m(const Points& points, Index row, Index from, Index to) {
  const Eigen::RowVector2d along = points.row(to) - points.row(from);
  const Eigen::RowVector2d off = points.row(row) - points.row(from);
  const double length2 = along.squaredNorm();
  const double share = length2 > 0.0 ? std::clamp(off.dot(along) / length2, 0.0, 1.0) : 0.0;
  return (off - share * along).norm();
}

/// Which rows of [first, last] stay. A stack of our own: recursion could be as deep as the path.
void mark_kept(const Points& points, Index first, Index last, double tolerance_m,
               std::vector<bool>& kept) {
  kept[first] = kept[last] = true;
  std::vector<std::pair<Index, Index>> open{{first, last}};
  while (!open.empty()) {
    const auto [from, to] = open.back();
    open.pop_back();
    Index farthest = from;
    double most = tolerance_m;
    for (Index i = from + 1; i < to; ++i)
      if (const double d = distance_m(points, i, from, to); d > most) most = d, farthest = i;
    if (farthest == from) continue;
    kept[farthest] = true;
    open.emplace_back(from, farthest);
    open.emplace_back(farthest, to);
  }
}

void add(ThinLine& line, double x, double y) {
  line.x.push_back(x);
  line.y.push_back(y);
}

void add_break(ThinLine& line) {
  if (!line.x.empty() && !std::isnan(line.x.back())) add(line, kNaN, kNaN);
}

}  // namespace

double longest_step(const Eigen::VectorXd& time_s) {
  std::vector<double> steps;
  for (Index i = 1; i < time_s.size(); ++i) steps.push_back(time_s(i) - time_s(i - 1));
  if (steps.empty()) return kInfinity;
  const double middle = upper_median(std::move(steps));
  return middle > 0.0 ? kLongPause * middle : kInfinity;
}

ThinLine thin_path(const Trajectory& path, double tolerance_m) {
  if (path.positions_m.rows() != path.size())
    throw InvalidInput("thin_path: times and positions differ in number");
  if (!(tolerance_m >= 0.0)) throw InvalidInput("thin_path: the tolerance is negative");
  const Index size = path.size();
  const double longest = longest_step(path.time_s);
  std::vector<bool> kept(static_cast<std::size_t>(size), false);
  ThinLine line;
  for (Index first = 0; first < size;) {
    if (!is_position(path.positions_m, first)) {
      ++first;
      continue;
    }
    Index last = first;
    while (last + 1 < size && is_position(path.positions_m, last + 1) &&
           path.time_s(last + 1) - path.time_s(last) <= longest)
      ++last;
    mark_kept(path.positions_m, first, last, tolerance_m, kept);
    add_break(line);
    for (Index i = first; i <= last; ++i)
      if (kept[i]) add(line, path.positions_m(i, 0), path.positions_m(i, 1));
    first = last + 1;
  }
  return line;
}

namespace {

/// Calls `use` with each piece of time that has numbers, first row and end, and `skip` where there
/// are none.
template <typename Use, typename Skip>
void for_pieces(const Eigen::VectorXd& time_s, const std::vector<double>& values, int bins, Use use,
                Skip skip) {
  if (time_s.size() != std::ssize(values))
    throw InvalidInput("thin_curve: times and values differ in number");
  if (bins < 1) throw InvalidInput("thin_curve: no bins");
  const Index size = time_s.size();
  const double span = size > 0 ? time_s(size - 1) - time_s(0) : 0.0;
  const auto bin_of = [&](Index i) {
    return span > 0.0 ? std::min(static_cast<int>((time_s(i) - time_s(0)) / span * bins), bins - 1)
                      : 0;
  };
  for (Index first = 0; first < size;) {
    if (!std::isfinite(values[first])) {
      skip();
      ++first;
      continue;
    }
    Index end = first + 1;
    while (end < size && bin_of(end) == bin_of(first) && std::isfinite(values[end])) ++end;
    use(first, end);
    first = end;
  }
}

}  // namespace

ThinLine thin_curve(const Eigen::VectorXd& time_s, const std::vector<double>& values, int bins) {
  ThinLine line;
  const auto add_ends = [&](Index first, Index end) {
    const auto range = std::pair{values.begin() + first, values.begin() + end};
    const auto [least, greatest] = std::minmax_element(range.first, range.second);
    std::array<Index, 4> rows{first, least - values.begin(), greatest - values.begin(), end - 1};
    std::ranges::sort(rows);
    const auto* last = std::unique(rows.begin(), rows.end());
    for (const auto* row = rows.begin(); row != last; ++row) add(line, time_s(*row), values[*row]);
  };
  for_pieces(time_s, values, bins, add_ends, [&] { add_break(line); });
  return line;
}

ThinLine median_curve(const Eigen::VectorXd& time_s, const std::vector<double>& values, int bins) {
  if (time_s.size() < 2 * bins) return thin_curve(time_s, values, bins);
  ThinLine line;
  const auto add_median = [&](Index first, Index end) {
    add(line, (time_s(first) + time_s(end - 1)) / 2.0,
        median(std::span(values).subspan(static_cast<std::size_t>(first),
                                         static_cast<std::size_t>(end - first))));
  };
  for_pieces(time_s, values, bins, add_median, [&] { add_break(line); });
  return line;
}

}  // namespace mapproof
