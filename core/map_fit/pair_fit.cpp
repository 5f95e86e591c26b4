#include "core/map_fit/pair_fit.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <functional>
#include <map>
#include <numeric>
#include <set>
#include <utility>

#include "core/align/rigid.hpp"
#include "core/association/log_blocks.hpp"
#include "core/base/median.hpp"
#include "core/base/not_finite.hpp"
#include "core/linalg/decompositions.hpp"
#include "core/pairs/pair_distances.hpp"
#include "core/pairs/pair_graph.hpp"

namespace mapproof {
namespace {

constexpr double kClearTurn = 0.8;  ///< Of SeenOrientation::direction.

using Body = std::set<int>;

/// Firm pairs and triples of landmarks.
class Bars {
 public:
  Bars(const std::vector<MeasuredPair>& pairs, const std::vector<SeenOrientation>& turns,
       const std::vector<bool>& is_mapped)
      : next_(is_mapped.size()) {
    for (const MeasuredPair& pair : pairs) {
      const auto a = static_cast<int>(pair.first);
      const auto b = static_cast<int>(pair.second);
      if (pair.scans < kFirmScans || !is_mapped[static_cast<std::size_t>(a)] ||
          !is_mapped[static_cast<std::size_t>(b)])
        continue;
      next_[static_cast<std::size_t>(a)].insert(b);
      next_[static_cast<std::size_t>(b)].insert(a);
    }
    for (const SeenOrientation& turn : turns)
      if (turn.scans >= kFirmScans && std::abs(turn.direction) > kClearTurn)
        triples_.insert({turn.first, turn.second, turn.third});
  }

  const std::set<int>& next(int landmark) const {
    return next_[static_cast<std::size_t>(landmark)];
  }

  /// How many firm pairs a landmark has with a body.
  int to(int landmark, const Body& body) const {
    return static_cast<int>(
        std::ranges::count_if(next(landmark), [&](int other) { return body.contains(other); }));
  }

  /// Whether a triple of the landmark and two of the body was seen, both paired with it.
  bool is_turned(int landmark, const Body& body) const {
    for (const int a : next(landmark))
      for (const int b : next(landmark)) {
        if (a >= b || !body.contains(a) || !body.contains(b)) continue;
        std::array<int, 3> triple = {landmark, a, b};
        std::ranges::sort(triple);
        if (triples_.contains(triple)) return true;
      }
    return false;
  }

  bool holds(int landmark, const Body& body) const {
    const int pairs = to(landmark, body);
    return pairs >= 3 || (pairs == 2 && (body.size() == 2 || is_turned(landmark, body)));
  }

 private:
  std::vector<std::set<int>> next_;
  std::set<std::array<int, 3>> triples_;
};

/// The body that grows from two landmarks. A third one needs two pairs: a triangle has one shape.
Body grown(const Bars& bars, int first, int second) {
  Body body = {first, second};
  for (bool grows = true; grows;) {
    grows = false;
    std::set<int> near;
    for (const int one : body)
      for (const int other : bars.next(one))
        if (!body.contains(other)) near.insert(other);
    for (const int one : near)
      if (bars.holds(one, body)) {
        body.insert(one);
        grows = true;
      }
  }
  return body;
}

bool are_joined(const Bars& bars, const Body& one, const Body& other) {
  int shared = 0;
  int pairs = 0;
  bool is_turned = false;
  for (const int k : one) {
    if (other.contains(k)) {
      ++shared;
      continue;
    }
    for (const int next : bars.next(k)) pairs += other.contains(next) && !one.contains(next);
    is_turned = is_turned || bars.is_turned(k, other);
  }
  constexpr std::array kNeeded = {4, 2, 1, 0};
  return pairs >= kNeeded[static_cast<std::size_t>(std::min(shared, 3))] ||
         (shared == 2 && is_turned);
}

/// Joins bodies as long as any two hold together.
void join(const Bars& bars, std::vector<Body>& bodies) {
  for (bool joins = true; joins;) {
    joins = false;
    for (std::size_t a = 0; a < bodies.size() && !joins; ++a)
      for (std::size_t b = a + 1; b < bodies.size() && !joins; ++b)
        if (are_joined(bars, bodies[a], bodies[b])) {
          bodies[a].insert(bodies[b].begin(), bodies[b].end());
          bodies.erase(bodies.begin() + static_cast<std::ptrdiff_t>(b));
          joins = true;
        }
  }
}

std::vector<Body> bodies_of(const Bars& bars, const std::vector<bool>& is_mapped) {
  std::vector<Body> bodies;
  for (std::size_t i = 0; i < is_mapped.size(); ++i)
    for (const int j : bars.next(static_cast<int>(i))) {
      const int first = static_cast<int>(i);
      if (j < first || std::ranges::any_of(bodies, [&](const Body& body) {
            return body.contains(first) && body.contains(j);
          }))
        continue;
      bodies.push_back(grown(bars, first, j));
      join(bars, bodies);
    }
  return bodies;
}

constexpr double kDeviations = 1.4826;  ///< Standard deviation over median of absolute values.
constexpr double kGross = 6.0;          ///< Standard deviations of a gross residual.
constexpr double kLeastSigma = 0.005;   ///< Of the median distance: rounding of stored values.
constexpr double kLeastOfHalf = 0.3;    ///< The constant part of sigma, of the smaller half's.
constexpr int kFewestOfRobot = 30;      ///< Pairs or triples of a robot that is compared.
constexpr std::size_t kNamed = 4;
constexpr Eigen::Index kMostLandmarks = 300;
constexpr double kClearTriangle = 0.2;  ///< Area of a triple, of the square of its longest side.

/// One pair of detections, compared with the map.
struct Residual {
  int first = 0;
  int second = 0;
  int robot = 0;
  double mapped_m = 0.0;
  double measured_m = 0.0;
  double normal = 0.0;  ///< In standard deviations, absolute.

  double size_m() const { return std::abs(measured_m - mapped_m); }
};

int robot_of(const DetectionLog& log, int step) {
  return log.scans.empty() ? 0 : log.scans[static_cast<std::size_t>(step)].robot;
}

std::vector<Residual> residuals_of(const DetectionLog& log, const Points& map) {
  std::vector<Residual> residuals;
  for (const ScanPair& pair : scan_pairs(log)) {
    const int a = log.detections[pair.first].landmark;
    const int b = log.detections[pair.second].landmark;
    const double mapped = (map.row(a) - map.row(b)).norm();
    if (std::isfinite(mapped))
      residuals.push_back({a, b, robot_of(log, pair.step), mapped, pair.distance_m});
  }
  return residuals;
}

/// sigma^2 = constant + slope d^2.
struct SigmaLine {
  double constant = 0.0;
  double slope = 0.0;
  double least = 0.0;

  double at(double distance) const {
    return std::max(least, std::sqrt(constant + slope * distance * distance));
  }
};

SigmaLine sigma_line(std::vector<Residual> residuals) {
  std::ranges::sort(residuals, {}, &Residual::mapped_m);
  const std::size_t half = residuals.size() / 2;
  const auto robust = [&](std::size_t begin, std::size_t end) {
    std::vector<double> sizes;
    std::vector<double> distances;
    for (std::size_t k = begin; k < end; ++k) {
      sizes.push_back(residuals[k].size_m());
      distances.push_back(residuals[k].mapped_m);
    }
    return std::pair(kDeviations * median(sizes), median(distances));
  };
  const auto [near, near_m] = robust(0, half);
  const auto [far, far_m] = robust(half, residuals.size());
  SigmaLine line;
  const double span = far_m * far_m - near_m * near_m;
  if (span > 0.0) line.slope = std::max(0.0, (far * far - near * near) / span);
  line.constant = std::max(near * near - line.slope * near_m * near_m,
                           std::pow(kLeastOfHalf * std::min(near, far), 2));
  line.least = kLeastSigma * residuals[half].mapped_m;
  return line;
}

/// The landmarks with the greatest values, at most kNamed, those above `least`.
std::vector<int> greatest(const std::vector<double>& values, double least) {
  std::vector<int> order(values.size());
  std::iota(order.begin(), order.end(), 0);
  std::ranges::stable_sort(order, std::greater<>(),
                           [&](int k) { return values[static_cast<std::size_t>(k)]; });
  std::erase_if(order, [&](int k) { return !(values[static_cast<std::size_t>(k)] > least); });
  if (order.size() > kNamed) order.resize(kNamed);
  return order;
}

ScatterFit scatter_of(std::vector<Residual>& residuals, std::size_t landmarks) {
  ScatterFit fit{.pairs = static_cast<int>(residuals.size())};
  if (residuals.size() < 4) return fit;
  const SigmaLine line = sigma_line(residuals);
  std::vector<double> mapped;
  std::vector<double> normal;
  std::vector<double> gross(landmarks, 0.0);
  std::vector<double> all(landmarks, 0.0);
  int beyond = 0;
  for (Residual& one : residuals) {
    one.normal = one.size_m() / line.at(one.mapped_m);
    mapped.push_back(one.mapped_m);
    normal.push_back(one.normal);
    beyond += one.normal > kGross ? 1 : 0;
    for (const int k : {one.first, one.second}) {
      all[static_cast<std::size_t>(k)] += 1.0;
      gross[static_cast<std::size_t>(k)] += one.normal > kGross ? 1.0 : 0.0;
    }
  }
  fit.median_m = median(mapped);
  fit.sigma_m = line.at(fit.median_m);
  fit.relative = fit.sigma_m / fit.median_m;
  fit.gross = static_cast<double>(beyond) / static_cast<double>(residuals.size());
  std::ranges::sort(normal);
  const double middle = upper_median(normal);
  fit.tail = middle > 0.0 ? normal[normal.size() * 9 / 10] / middle : 0.0;
  for (std::size_t k = 0; k < landmarks; ++k)
    gross[k] = all[k] >= kFewestOfRobot ? gross[k] / all[k] : 0.0;
  fit.worst = greatest(gross, 2.0 * fit.gross);
  return fit;
}

/// Twice the area of a triple by rows, over the square of its longest side.
double shape_of(const Eigen::RowVector2d& a, const Eigen::RowVector2d& b,
                const Eigen::RowVector2d& c) {
  const double longest =
      std::max({(b - a).squaredNorm(), (c - a).squaredNorm(), (c - b).squaredNorm()});
  return longest > 0.0 ? cross(b - a, c - a) / longest : 0.0;
}

/// Adds the orientations of the triples of one scan to those of its robot.
void add_triples(const std::vector<const Detection*>& scan, const Points& map, RobotFit& robot) {
  constexpr std::size_t kMost = 6;
  const std::size_t count = std::min(scan.size(), kMost);
  for (std::size_t i = 0; i < count; ++i)
    for (std::size_t j = i + 1; j < count; ++j)
      for (std::size_t k = j + 1; k < count; ++k) {
        const double seen = shape_of(position_observed(*scan[i]), position_observed(*scan[j]),
                                     position_observed(*scan[k]));
        const double mapped = shape_of(map.row(scan[i]->landmark), map.row(scan[j]->landmark),
                                       map.row(scan[k]->landmark));
        if (!(std::abs(seen) > kClearTriangle && std::abs(mapped) > kClearTriangle)) continue;
        ++robot.triples;
        robot.mirrored += seen * mapped < 0.0 ? 1.0 : 0.0;
      }
}

void add_orientations(const DetectionLog& log, const Points& map, std::vector<RobotFit>& robots) {
  std::vector<const Detection*> scan;
  const auto take = [&] {
    if (scan.size() >= 3)
      add_triples(scan, map, robots[static_cast<std::size_t>(robot_of(log, scan.front()->step))]);
    scan.clear();
  };
  for (const Detection& seen : log.detections) {
    if (!scan.empty() && scan.front()->step != seen.step) take();
    if (is_located(seen) && map.row(seen.landmark).allFinite()) scan.push_back(&seen);
  }
  take();
  for (RobotFit& robot : robots)
    if (robot.triples > 0) robot.mirrored /= robot.triples;
}

std::vector<RobotFit> robots_of(const DetectionLog& log, const Points& map,
                                const std::vector<Residual>& residuals) {
  int most = 0;
  for (const ScanKey& scan : log.scans) most = std::max(most, scan.robot);
  std::vector<RobotFit> robots(static_cast<std::size_t>(most) + 1);
  std::vector<std::vector<double>> ratios(robots.size());
  std::vector<double> all;
  for (const Residual& one : residuals) {
    if (one.mapped_m <= 0.0) continue;
    ratios[static_cast<std::size_t>(one.robot)].push_back(one.measured_m / one.mapped_m);
  }
  for (std::size_t r = 0; r < robots.size(); ++r) {
    robots[r].robot = static_cast<int>(r);
    robots[r].pairs = static_cast<int>(ratios[r].size());
    if (robots[r].pairs < kFewestOfRobot) continue;
    robots[r].ratio = median(ratios[r]);
    all.push_back(robots[r].ratio);
  }
  const double usual = all.empty() ? 1.0 : median(all);
  for (RobotFit& robot : robots)
    if (robot.pairs >= kFewestOfRobot && usual > 0.0) robot.ratio /= usual;
  add_orientations(log, map, robots);
  return robots;
}

/// The weakest mode of the pairs' springs: the Hessian of the stress at its minimum.
WeakMode weakest_mode(const std::vector<MeasuredPair>& pairs, const Points& map, double spread) {
  std::vector<Eigen::Index> row(static_cast<std::size_t>(map.rows()), -1);
  std::vector<int> landmarks;
  for (Eigen::Index k = 0; k < map.rows(); ++k)
    if (map.row(k).allFinite()) {
      row[static_cast<std::size_t>(k)] = std::ssize(landmarks);
      landmarks.push_back(static_cast<int>(k));
    }
  const auto n = static_cast<Eigen::Index>(landmarks.size());
  if (n < 3 || n > kMostLandmarks) return {};
  Eigen::MatrixXd hessian = Eigen::MatrixXd::Zero(2 * n, 2 * n);
  for (const MeasuredPair& pair : pairs) {
    const Eigen::Index i = row[static_cast<std::size_t>(pair.first)];
    const Eigen::Index j = row[static_cast<std::size_t>(pair.second)];
    if (i < 0 || j < 0 || pair.scans < kFirmScans) continue;
    const Eigen::Vector2d along =
        (map.row(pair.first) - map.row(pair.second)).normalized().transpose();
    const Eigen::Matrix2d spring = pair.precision * along * along.transpose();
    hessian.block<2, 2>(2 * i, 2 * i) += spring;
    hessian.block<2, 2>(2 * j, 2 * j) += spring;
    hessian.block<2, 2>(2 * i, 2 * j) -= spring;
    hessian.block<2, 2>(2 * j, 2 * i) -= spring;
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(hessian);
  if (solver.info() != Eigen::Success) return {};
  // The first three are the translations and the rotation.
  const double stiffness = solver.eigenvalues()(3);
  const double greatest_stiffness = solver.eigenvalues()(2 * n - 1);
  std::vector<double> moves(static_cast<std::size_t>(map.rows()), 0.0);
  double most = 0.0;
  for (Eigen::Index i = 0; i < n; ++i) {
    const double move = solver.eigenvectors().col(3).segment<2>(2 * i).norm();
    moves[static_cast<std::size_t>(landmarks[static_cast<std::size_t>(i)])] = move;
    most = std::max(most, move);
  }
  WeakMode mode{.sigma_m = stiffness > 1e-12 * greatest_stiffness
                               ? spread * most / std::sqrt(stiffness)
                               : kInfinity,
                .landmarks = greatest(moves, 0.5 * most)};
  return mode;
}

double misfit(const Points& from, const Points& to, Alignment alignment) {
  const Points off = fit_similarity(from, to, alignment)(from) - to;
  return std::sqrt(off.squaredNorm() / static_cast<double>(off.rows()));
}

Points without(const Points& points, Eigen::Index row) {
  Points others(points.rows() - 1, 2);
  others.topRows(row) = points.topRows(row);
  others.bottomRows(points.rows() - row - 1) = points.bottomRows(points.rows() - row - 1);
  return others;
}

}  // namespace

RigidParts rigid_parts(const std::vector<MeasuredPair>& pairs,
                       const std::vector<SeenOrientation>& turns,
                       const std::vector<bool>& is_mapped) {
  const Bars bars(pairs, turns, is_mapped);
  std::vector<Body> bodies = bodies_of(bars, is_mapped);
  std::ranges::stable_sort(bodies, std::ranges::greater(), &Body::size);
  RigidParts result;
  std::vector<int> part(is_mapped.size(), -1);
  const auto add = [&](const std::vector<int>& landmarks) {
    for (const int k : landmarks)
      part[static_cast<std::size_t>(k)] = static_cast<int>(result.parts.size());
    result.parts.push_back({landmarks});
  };
  for (const Body& body : bodies) {
    std::vector<int> fresh;
    for (const int k : body)
      if (part[static_cast<std::size_t>(k)] < 0) fresh.push_back(k);
    // Two landmarks have one shape whatever else holds.
    if (fresh.size() > 2 || (!fresh.empty() && result.parts.empty())) add(fresh);
  }
  for (std::size_t k = 0; k < is_mapped.size(); ++k)
    if (is_mapped[k] && part[k] < 0) add({static_cast<int>(k)});
  std::ranges::stable_sort(result.parts, std::ranges::greater(),
                           [](const RigidPart& one) { return one.landmarks.size(); });
  for (std::size_t p = 0; p < result.parts.size(); ++p)
    for (const int k : result.parts[p].landmarks)
      part[static_cast<std::size_t>(k)] = static_cast<int>(p);
  for (const MeasuredPair& pair : pairs) {
    const int a = part[static_cast<std::size_t>(pair.first)];
    const int b = part[static_cast<std::size_t>(pair.second)];
    if (a < 0 || b < 0 || a == b) continue;
    for (const int p : {a, b}) {
      ++result.parts[static_cast<std::size_t>(p)].pairs;
      result.parts[static_cast<std::size_t>(p)].scans += pair.scans;
    }
  }
  return result;
}

PairFit pair_fit(const DetectionLog& log, const Points& map) {
  PairFit fit;
  std::vector<bool> is_mapped;
  for (Eigen::Index k = 0; k < map.rows(); ++k) {
    is_mapped.push_back(map.row(k).allFinite());
    fit.landmarks += is_mapped.back() ? 1 : 0;
  }
  const std::vector<MeasuredPair> pairs = measured_pairs(log);
  fit.measured = static_cast<int>(std::ranges::count_if(pairs, [&](const MeasuredPair& pair) {
    return is_mapped[static_cast<std::size_t>(pair.first)] &&
           is_mapped[static_cast<std::size_t>(pair.second)];
  }));
  fit.redundancy = fit.measured - std::max(0, 2 * fit.landmarks - 3);
  std::vector<Residual> residuals = residuals_of(log, map);
  fit.scatter = scatter_of(residuals, is_mapped.size());
  fit.robots = robots_of(log, map, residuals);
  if (map.rows() <= kMostLandmarks)
    fit.parts =
        rigid_parts(pairs, seen_turns(log), std::vector<bool>(is_mapped.size(), true)).parts;
  std::vector<double> off;
  for (const MeasuredPair& pair : pairs)
    if (const double mapped = (map.row(pair.first) - map.row(pair.second)).norm();
        std::isfinite(mapped))
      off.push_back(std::abs(pair.distance_m - mapped) * std::sqrt(pair.precision));
  const double spread = off.empty() ? 1.0 : std::max(1.0, kDeviations * median(off));
  fit.weakest = weakest_mode(pairs, map, spread);
  return fit;
}

KnownFit known_fit(const Points& map, const Points& known_m) {
  std::vector<Eigen::Index> rows;
  for (Eigen::Index k = 0; k < map.rows(); ++k)
    if (map.row(k).allFinite() && known_m.row(k).allFinite()) rows.push_back(k);
  KnownFit fit{.positions = static_cast<int>(rows.size())};
  if (rows.size() < 3) return fit;
  const Points from = map(rows, Eigen::all);
  const Points to = known_m(rows, Eigen::all);
  fit.misfit_m = misfit(from, to, Alignment::kRigid);
  Points mirrored = from;
  mirrored.col(0) *= -1.0;
  fit.mirrored_m = misfit(mirrored, to, Alignment::kRigid);
  fit.scale = fit_similarity(from, to, Alignment::kSimilarity).scale;
  fit.scaled_m = misfit(from, to, Alignment::kSimilarity);
  fit.without_worst_m = fit.second_without_m = kInfinity;
  if (rows.size() < 4) return fit;
  for (Eigen::Index k = 0; k < from.rows(); ++k) {
    const Points others = without(from, k);
    const Points targets = without(to, k);
    const double left = misfit(others, targets, Alignment::kRigid);
    if (left >= fit.without_worst_m) {
      fit.second_without_m = std::min(fit.second_without_m, left);
      continue;
    }
    fit.second_without_m = fit.without_worst_m;
    fit.without_worst_m = left;
    fit.worst = static_cast<int>(rows[static_cast<std::size_t>(k)]);
    const Points moved = fit_similarity(others, targets, Alignment::kRigid)(Points(from.row(k)));
    fit.worst_miss_m = (moved.row(0) - to.row(k)).norm();
  }
  return fit;
}

}  // namespace mapproof
