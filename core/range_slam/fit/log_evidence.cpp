#include "core/range_slam/fit/log_evidence.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "core/base/median.hpp"
#include "core/linalg/decompositions.hpp"

namespace mapproof {
namespace {

using Eigen::Index;

constexpr double kLongGap = 10.0;     ///< Median steps of odometry.
constexpr double kUnknownTurn = 1.8;  ///< rad: about that of a heading of which nothing is known.
constexpr double kClip = 3.0;         ///< Residuals count up to so many sigmas.
constexpr double kClippedSquare = 0.98;  ///< Mean square of a normal that is clipped there.
constexpr Index kTimeBlocks = 16;
constexpr Index kRangeBlocks = 8;
/// Bounds of residual tests: sigmas of a mean square.
constexpr double kResidualBound = 8.0;

/// Steps of odometry: times, ways and turns, with the start.
struct Steps {
  std::vector<double> from_s, to_s, way_m, turn;
  double median_s = 0.0;
};

Steps steps_of(const RangeLog& log) {
  Steps steps;
  double before = log.start.time_s;
  std::vector<double> lengths;
  for (const Motion& motion : log.odometry) {
    steps.from_s.push_back(before);
    steps.to_s.push_back(motion.time_s);
    steps.way_m.push_back(std::hypot(motion.distance_m, motion.sideways_m));
    steps.turn.push_back(std::abs(motion.heading_change_rad));
    lengths.push_back(motion.time_s - before);
    before = motion.time_s;
  }
  steps.median_s = lengths.empty() ? 0.0 : median(lengths);
  return steps;
}

/// A stretch whose way could be any at the speed of the rest.
OdometryGap gap_at(const Steps& steps, double from_s, double to_s) {
  double way_m = 0.0, turn = 0.0, time_s = 0.0;
  for (std::size_t i = 0; i < steps.to_s.size(); ++i) {
    const double step_s = steps.to_s[i] - steps.from_s[i];
    if (step_s > kLongGap * steps.median_s) continue;
    if (steps.from_s[i] >= from_s && steps.to_s[i] <= to_s) continue;
    way_m += steps.way_m[i];
    turn += steps.turn[i];
    time_s += step_s;
  }
  const double length_s = to_s - from_s;
  const double share = time_s > 0.0 ? length_s / time_s : 0.0;
  return {.from_s = from_s,
          .to_s = to_s,
          .way_sigma_m = share * way_m,
          .heading_change_sigma_rad = std::min(kUnknownTurn, share * turn)};
}

/// Mean of clipped squares over the rows, as sigmas from what it should be.
double excess(const std::vector<double>& squares, double inflation) {
  if (squares.empty()) return 0.0;
  const double count = static_cast<double>(squares.size());
  const double mean = std::accumulate(squares.begin(), squares.end(), 0.0) / count;
  return (mean / kClippedSquare - 1.0) / std::sqrt(2.0 * inflation / count);
}

double clipped_square(double z) {
  const double clipped = std::clamp(z, -kClip, kClip);
  return clipped * clipped;
}

/// A landmark with a given position, and where the free map has it.
struct GivenLandmark {
  Index row;
  Eigen::Vector2d given, mapped;
};

/// A motion of given positions onto mapped ones, rigid but for the scale.
struct KnownMotion {
  Eigen::Vector2d from, to;  ///< Means.
  Eigen::Matrix2d R;
  double scale = 1.0;        ///< Mapped over given; 1 if it is held.
  double scale_sigma = 0.0;  ///< Its standard deviation, a share; 0 if it is held.
  double statistic = 0.0;    ///< Squared residuals by the covariances, the motion's part taken off.

  double distance_m(const GivenLandmark& p) const {
    return (to + scale * R * (p.given - from) - p.mapped).norm();
  }
};

/// Fits by the covariances of a map.
class KnownLandmarksFit {
 public:
  KnownLandmarksFit(const Eigen::MatrixXd& covariance, double survey_sigma_m)
      : covariance_(covariance), survey_sigma_m_(survey_sigma_m) {}

  KnownMotion operator()(const std::vector<GivenLandmark>& points) const {
    KnownMotion motion = about_means(points);
    weigh(points, 3, motion);
    return motion;
  }

  KnownMotion with_scale(const std::vector<GivenLandmark>& points) const {
    KnownMotion motion = about_means(points);
    double along = 0.0, spread = 0.0;
    for (const GivenLandmark& p : points) {
      along += (motion.R * (p.given - motion.from)).dot(p.mapped - motion.to);
      spread += (p.given - motion.from).squaredNorm();
    }
    if (along > 0.0 && spread > 0.0) motion.scale = along / spread;
    weigh(points, 4, motion);
    return motion;
  }

 private:
  static KnownMotion about_means(const std::vector<GivenLandmark>& points) {
    const auto count = std::ssize(points);
    KnownMotion motion{.from = Eigen::Vector2d::Zero(), .to = Eigen::Vector2d::Zero(), .R = {}};
    for (const GivenLandmark& p : points) {
      motion.from += p.given / double(count);
      motion.to += p.mapped / double(count);
    }
    double c = 0.0, s = 0.0;
    for (const GivenLandmark& p : points) {
      const Eigen::Vector2d a = p.given - motion.from, b = p.mapped - motion.to;
      c += a.dot(b);
      s += a(0) * b(1) - a(1) * b(0);
    }
    motion.R = Eigen::Rotation2Dd(std::atan2(s, c)).toRotationMatrix();
    return motion;
  }

  /// The best step of translation, rotation and, of four unknowns, scale; and what it leaves.
  void weigh(const std::vector<GivenLandmark>& points, Index unknowns, KnownMotion& motion) const {
    const auto count = std::ssize(points);
    Eigen::VectorXd r(2 * count);
    Eigen::MatrixXd G(2 * count, 4), C(2 * count, 2 * count);
    for (Index i = 0; i < count; ++i) {
      const GivenLandmark& p = points[static_cast<std::size_t>(i)];
      const Eigen::Vector2d turned = motion.scale * motion.R * (p.given - motion.from);
      r.segment<2>(2 * i) = p.mapped - motion.to - turned;
      G.middleRows<2>(2 * i) << 1.0, 0.0, -turned(1), turned(0), 0.0, 1.0, turned(0), turned(1);
      for (Index k = 0; k < count; ++k)
        C.block<2, 2>(2 * i, 2 * k) =
            covariance_.block<2, 2>(2 * p.row, 2 * points[static_cast<std::size_t>(k)].row);
    }
    C.diagonal().array() += survey_sigma_m_ * survey_sigma_m_;
    G.conservativeResize(2 * count, unknowns);
    const Eigen::LDLT<Eigen::MatrixXd> factor(C);
    const Eigen::VectorXd Cr = factor.solve(r);
    const Eigen::MatrixXd information = G.transpose() * factor.solve(G);
    const Eigen::VectorXd move = information.ldlt().solve(G.transpose() * Cr);
    motion.statistic = std::max(0.0, r.dot(Cr) - (G.transpose() * Cr).dot(move));
    if (unknowns < 4) return;
    motion.scale *= 1.0 + move(3);
    motion.scale_sigma = std::sqrt(std::max(0.0, information.inverse()(3, 3)));
  }

  const Eigen::MatrixXd& covariance_;
  double survey_sigma_m_;
};

double known_landmarks_bound(std::size_t count) {
  const double freedom = 2.0 * static_cast<double>(count) - 3.0;
  return freedom + 4.5 * std::sqrt(2.0 * freedom) + 10.0;
}

/// What would make the given positions fit.
struct KnownLandmarksCause {
  FitCode code;
  std::vector<Index> rows;
  double rest, bound, distance_m;
};

/// One landmark left out, or two exchanged: those that leave no contradiction, the best first.
std::vector<KnownLandmarksCause> causes_that_fit(const std::vector<GivenLandmark>& all,
                                                 const KnownLandmarksFit& fit) {
  std::vector<KnownLandmarksCause> found;
  if (all.size() >= 3)
    for (std::size_t k = 0; k < all.size(); ++k) {
      std::vector<GivenLandmark> rest = all;
      rest.erase(rest.begin() + static_cast<std::ptrdiff_t>(k));
      const KnownMotion motion = fit(rest);
      found.push_back({FitCode::kKnownLandmarkOff,
                       {all[k].row},
                       motion.statistic,
                       known_landmarks_bound(rest.size()),
                       motion.distance_m(all[k])});
    }
  for (std::size_t a = 0; a < all.size(); ++a)
    for (std::size_t b = a + 1; b < all.size(); ++b) {
      std::vector<GivenLandmark> swapped = all;
      std::swap(swapped[a].given, swapped[b].given);
      found.push_back({FitCode::kKnownLandmarksExchanged,
                       {all[a].row, all[b].row},
                       fit(swapped).statistic,
                       known_landmarks_bound(all.size()),
                       (all[a].given - all[b].given).norm()});
    }
  std::erase_if(found, [](const KnownLandmarksCause& f) { return f.rest > f.bound; });
  // Nearly the same rest: which one it is cannot be determined; an exchange needs no freedom.
  std::ranges::stable_sort(found, {}, [](const KnownLandmarksCause& f) {
    return f.rest / f.bound + (f.code == FitCode::kKnownLandmarkOff ? 0.5 : 0.0);
  });
  return found;
}

/// Whether the first of the causes can be distinguished from the second.
bool is_clear(const std::vector<KnownLandmarksCause>& found, std::size_t landmarks) {
  if (found.size() < 2) return found.size() == 1;
  return (landmarks > 3 || found[0].code == FitCode::kKnownLandmarksExchanged) &&
         (found[0].code != found[1].code || found[0].rest + 6.0 < found[1].rest);
}

}  // namespace

std::vector<OdometryGap> gaps_by_stamps(const RangeLog& log) {
  const Steps steps = steps_of(log);
  std::vector<OdometryGap> gaps;
  for (std::size_t i = 0; i < steps.to_s.size(); ++i)
    if (steps.to_s[i] - steps.from_s[i] > kLongGap * steps.median_s)
      gaps.push_back(gap_at(steps, steps.from_s[i], steps.to_s[i]));
  return gaps;
}

std::vector<double> breaks_of(const std::vector<OdometryGap>& gaps) {
  std::vector<double> breaks_s;
  for (const OdometryGap& gap : gaps) {
    breaks_s.push_back(gap.from_s);
    breaks_s.push_back(gap.to_s);
  }
  std::ranges::sort(breaks_s);
  return breaks_s;
}

std::vector<OdometryGap> frozen_stretches(const RangeLog& log, std::size_t most) {
  const Steps steps = steps_of(log);
  std::vector<OdometryGap> runs;
  for (std::size_t i = 0; i < steps.to_s.size();) {
    std::size_t end = i;
    while (end < steps.to_s.size() && steps.way_m[end] == 0.0 && steps.turn[end] == 0.0) ++end;
    if (static_cast<double>(end - i) >= kLongGap)
      runs.push_back(gap_at(steps, steps.from_s[i], steps.to_s[end - 1]));
    i = std::max(end, i + 1);
  }
  std::ranges::stable_sort(runs, std::greater<>(),
                           [](const OdometryGap& run) { return run.to_s - run.from_s; });
  if (runs.size() > most) runs.resize(most);
  return runs;
}

double odometry_error_percent(const LogProblem& problem, const LogState& state) {
  std::vector<double> shares;
  const std::vector<KeyMotion>& motions = problem.keys().motions();
  for (std::size_t i = 0; i < motions.size(); ++i) {
    const Eigen::Vector2d way = motions[i].step.head<2>();
    if (!(way.norm() > 0.0)) continue;
    const Eigen::Vector2d moved = Eigen::Rotation2Dd(-state.poses[i](2)) *
                                  Eigen::Vector2d((state.poses[i + 1] - state.poses[i]).head<2>());
    shares.push_back(100.0 * (moved - way).norm() / way.norm());
  }
  return shares.empty() ? 0.0 : median(shares);
}

double inflation_of(const LogProblem& problem, const LogProblem::Fit& fit) {
  // Each landmark's residuals in time, without outliers.
  std::vector<std::vector<double>> series(static_cast<std::size_t>(problem.landmarks()));
  double square = 0.0, count = 0.0;
  for (std::size_t i = 0; i < problem.ranges().size(); ++i) {
    const auto row = static_cast<Index>(i);
    if (problem.ranges()[i].in_gap || !(fit.inlier(row) > 0.5)) continue;
    const double z = fit.normalised(row);
    series[static_cast<std::size_t>(problem.ranges()[i].landmark)].push_back(z);
    square += z * z;
    count += 1.0;
  }
  if (!(count > 10.0) || !(square > 0.0)) return 1.0;
  const double each = count / static_cast<double>(series.size());
  const auto most = static_cast<std::size_t>(std::clamp(std::sqrt(each), 2.0, 25.0));
  double inflation = 1.0;
  for (std::size_t lag = 1; lag <= most; ++lag) {
    double product = 0.0, pairs = 0.0;
    for (const std::vector<double>& values : series)
      for (std::size_t i = lag; i < values.size(); ++i) {
        product += values[i] * values[i - lag];
        pairs += 1.0;
      }
    if (!(pairs > 0.0)) break;
    const double correlation = product / pairs / (square / count);
    inflation += 2.0 * (1.0 - double(lag) / double(most + 1)) * correlation;
  }
  return std::max(1.0, inflation);
}

std::vector<FitTest> residual_tests(const RangeLog& log, const LogProblem& problem,
                                    const LogProblem::Fit& fit, double inflation) {
  const auto& ranges = problem.ranges();
  std::vector<std::vector<double>> by_landmark(static_cast<std::size_t>(problem.landmarks()));
  std::vector<double> all;
  std::vector<std::pair<double, double>> by_time, by_range;
  for (std::size_t i = 0; i < ranges.size(); ++i) {
    const auto row = static_cast<Index>(i);
    if (ranges[i].in_gap) continue;
    const double square = clipped_square(fit.normalised(row));
    all.push_back(square);
    by_landmark[static_cast<std::size_t>(ranges[i].landmark)].push_back(square);
    by_time.emplace_back(ranges[i].time_s, square);
    by_range.emplace_back(ranges[i].range_m, square);
  }
  std::vector<FitTest> tests;
  const auto add = [&](FitCode code, std::vector<std::string> names, double statistic) {
    tests.push_back({.code = code,
                     .landmarks = std::move(names),
                     .statistic = std::max(0.0, statistic),
                     .bound = kResidualBound});
  };
  add(FitCode::kResiduals, {}, excess(all, inflation));
  for (std::size_t n = 0; n < by_landmark.size(); ++n)
    if (by_landmark[n].size() >= 10)
      add(FitCode::kLandmarkResiduals, {log.landmarks[n]}, excess(by_landmark[n], inflation));
  const auto over = [&](std::vector<std::pair<double, double>> values, Index blocks) {
    std::ranges::stable_sort(values);
    double greatest = 0.0;
    for (Index b = 0; b < blocks; ++b) {
      const auto first = values.size() * static_cast<std::size_t>(b) / std::size_t(blocks);
      const auto last = values.size() * static_cast<std::size_t>(b + 1) / std::size_t(blocks);
      std::vector<double> squares;
      for (std::size_t i = first; i < last; ++i) squares.push_back(values[i].second);
      if (squares.size() >= 10) greatest = std::max(greatest, excess(squares, inflation));
    }
    return greatest;
  };
  add(FitCode::kResidualsOverTime, {}, over(by_time, kTimeBlocks));
  add(FitCode::kResidualsOverRange, {}, over(by_range, kRangeBlocks));
  if (problem.estimates_way())
    tests.push_back({.code = FitCode::kOdometryResiduals,
                     .statistic = odometry_error_percent(problem, fit.state),
                     .bound = kOdometryErrorBound_percent});
  return tests;
}

Points range_positions(const LogProblem& problem, const LogState& state) {
  Points positions(std::ssize(problem.ranges()), 2);
  for (std::size_t i = 0; i < problem.ranges().size(); ++i) {
    const BetweenPoses& at = problem.ranges()[i].at;
    const auto before = static_cast<std::size_t>(at.before);
    positions.row(static_cast<Index>(i)) =
        at.pose(state.poses[before], state.poses[before + 1]).head<2>().transpose();
  }
  return positions;
}

Eigen::Vector2d located(const LogProblem& problem, const Points& positions_m,
                        const std::vector<std::size_t>& rows, const LogProblem::Fit& fit,
                        const Eigen::Vector2d& start) {
  if (rows.size() < 3) return Eigen::Vector2d::Constant(kNaN);
  const double sigma = 3.0 * fit.noise.range_m;
  const auto at = [&](std::size_t i) -> Eigen::Vector2d {
    return positions_m.row(static_cast<Index>(i)).transpose();
  };
  const auto range = [&](std::size_t i) { return problem.ranges()[i].range_m / fit.state.scale; };
  const auto misfit = [&](const Eigen::Vector2d& m) {
    double sum = 0.0;
    for (const std::size_t i : rows) {
      const double z = ((at(i) - m).norm() - range(i)) / sigma;
      sum += z * z / (1.0 + z * z);
    }
    return sum;
  };
  const auto polished = [&](Eigen::Vector2d m) {
    for (int round = 0; round < 20; ++round) {
      Eigen::Matrix2d H = 1e-9 * Eigen::Matrix2d::Identity();
      Eigen::Vector2d g = Eigen::Vector2d::Zero();
      for (const std::size_t i : rows) {
        const Eigen::Vector2d gap = m - at(i);
        const double distance = std::max(gap.norm(), 1e-12);
        const double z = (distance - range(i)) / sigma;
        const double weight = 1.0 / ((1.0 + z * z) * (1.0 + z * z));
        const Eigen::Vector2d slope = gap / distance;
        H += weight * slope * slope.transpose();
        g += weight * (distance - range(i)) * slope;
      }
      H.diagonal() *= 1.01;
      const Eigen::Vector2d step = H.inverse() * g;
      if (!step.allFinite()) break;
      m -= step;
      if (step.norm() < 1e-4 * sigma) break;
    }
    return m;
  };
  // |p - m|^2 = r^2 is linear in m and |m|^2.
  Eigen::Vector2d middle = Eigen::Vector2d::Zero();
  for (const std::size_t i : rows) middle += at(i) / static_cast<double>(rows.size());
  Eigen::Matrix3d A = Eigen::Matrix3d::Zero();
  Eigen::Vector3d b = Eigen::Vector3d::Zero();
  for (const std::size_t i : rows) {
    const Eigen::Vector2d p = at(i) - middle;
    const double weight = 1.0 / std::max(range(i), 0.1 * sigma);
    const Eigen::Vector3d a = weight * Eigen::Vector3d(-2.0 * p(0), -2.0 * p(1), 1.0);
    A += a * a.transpose();
    b += a * weight * (range(i) * range(i) - p.squaredNorm());
  }
  A.diagonal() *= 1.0 + 1e-9;
  const Eigen::Vector3d linear = A.ldlt().solve(b);
  Eigen::Vector2d best = polished(start);
  if (linear.allFinite()) {
    const Eigen::Vector2d other = polished(middle + linear.head<2>());
    if (other.allFinite() && (!best.allFinite() || misfit(other) < misfit(best))) best = other;
  }
  return best;
}

std::vector<Index> mirrored_landmarks(const LogProblem& problem, const LogProblem::Fit& fit,
                                      double inflation) {
  constexpr double kAlike = 9.0;  // Drops of -2 ln L below this do not tell two positions apart.
  const Points positions = range_positions(problem, fit.state);
  const Eigen::VectorXd costs = problem.range_costs({}, fit);
  std::vector<Index> mirrored;
  for (Index n = 0; n < problem.landmarks(); ++n) {
    std::vector<std::size_t> rows;
    Eigen::Vector2d middle = Eigen::Vector2d::Zero();
    for (std::size_t i = 0; i < problem.ranges().size(); ++i)
      if (problem.ranges()[i].landmark == n && !problem.ranges()[i].in_gap) {
        rows.push_back(i);
        middle += positions.row(static_cast<Index>(i)).transpose();
      }
    if (rows.size() < 3) continue;
    middle /= static_cast<double>(rows.size());
    Eigen::Matrix2d spread = Eigen::Matrix2d::Zero();
    for (const std::size_t i : rows) {
      const Eigen::Vector2d p = positions.row(static_cast<Index>(i)).transpose() - middle;
      spread += p * p.transpose();
    }
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> axes(spread);
    const Eigen::Vector2d across_way = axes.eigenvectors().col(0);
    const Eigen::Vector2d& own = fit.state.landmarks[static_cast<std::size_t>(n)];
    const Eigen::Vector2d image = own - 2.0 * across_way.dot(own - middle) * across_way;
    const double sigma = fit.noise.range_m;
    if ((image - own).norm() < 6.0 * sigma) continue;
    // The image polished by itself, without the start from linear least squares, which would find
    // the landmark's own position again.
    LogProblem::Fit other = fit;
    Eigen::Vector2d& m = other.state.landmarks[static_cast<std::size_t>(n)];
    m = image;
    for (int round = 0; round < 15; ++round) {
      Eigen::Matrix2d H = 1e-9 * Eigen::Matrix2d::Identity();
      Eigen::Vector2d g = Eigen::Vector2d::Zero();
      for (const std::size_t i : rows) {
        const Eigen::Vector2d gap = m - positions.row(static_cast<Index>(i)).transpose();
        const double distance = std::max(gap.norm(), 1e-12);
        const double error = fit.state.scale * distance - problem.ranges()[i].range_m;
        const double weight = 1.0 / (1.0 + error * error / (9.0 * sigma * sigma));
        H += weight * gap * gap.transpose() / (distance * distance);
        g += weight * error / fit.state.scale * gap / distance;
      }
      H.diagonal() *= 1.01;
      m -= H.inverse() * g;
    }
    if (!m.allFinite() || (m - own).norm() < 6.0 * sigma) continue;
    const Eigen::VectorXd others = problem.range_costs({}, other);
    double drop = 0.0;
    for (const std::size_t i : rows)
      drop += others(static_cast<Index>(i)) - costs(static_cast<Index>(i));
    if (drop / inflation < kAlike) mirrored.push_back(n);
  }
  return mirrored;
}

namespace {

constexpr std::size_t kFewestForScale = 4;
constexpr double kScaleBound = 20.0;  ///< As of other single numbers: 4.5 standard deviations.

/// The covariance of a map whose scale is uncertain by a share, too.
Eigen::MatrixXd with_scale(const Eigen::MatrixXd& covariance, double scale_sigma,
                           const std::vector<Eigen::Vector2d>& landmarks_m) {
  const auto count = std::ssize(landmarks_m);
  Eigen::VectorXd way(2 * count);
  Eigen::Vector2d middle = Eigen::Vector2d::Zero();
  for (const Eigen::Vector2d& m : landmarks_m) middle += m / double(count);
  for (Index n = 0; n < count; ++n)
    way.segment<2>(2 * n) = landmarks_m[static_cast<std::size_t>(n)] - middle;
  return covariance + scale_sigma * scale_sigma * way * way.transpose();
}

/// Adds the test of the scale. @return Whether the scale is off, and explains what is.
bool test_scale(const std::vector<GivenLandmark>& all, const KnownLandmarksNoise& noise,
                KnownLandmarksTest& test) {
  if (all.size() < kFewestForScale) return false;
  const KnownMotion scaled =
      KnownLandmarksFit(noise.covariance, noise.survey_sigma_m).with_scale(all);
  const double off = std::log(scaled.scale);
  const double sigma = std::hypot(scaled.scale_sigma, noise.scale_sigma);
  if (!(sigma > 0.0) || !std::isfinite(off)) return false;
  test.scale_statistic = off * off / (sigma * sigma);
  test.scale_bound = kScaleBound;
  if (!(test.scale_statistic > kScaleBound) || scaled.statistic > known_landmarks_bound(all.size()))
    return false;
  test.rows.emplace_back();
  test.causes.push_back({.code = FitCode::kKnownScale,
                         .values = {{.id = "ratio", .value = 1.0 / scaled.scale},
                                    {.id = "share_percent", .value = 100.0 * (scaled.scale - 1.0)}},
                         .statistic = test.scale_statistic,
                         .bound = test.scale_bound});
  return true;
}

}  // namespace

KnownLandmarksTest known_landmarks_test(const KnownLandmarks& known,
                                        const std::vector<Eigen::Vector2d>& landmarks_m,
                                        const KnownLandmarksNoise& noise) {
  // The scale of odometry is uncertain, whatever ranges say.
  const Eigen::MatrixXd covariance =
      with_scale(noise.covariance, 2.0 * noise.scale_sigma, landmarks_m);
  const KnownLandmarksFit fit(covariance, noise.survey_sigma_m);
  std::vector<GivenLandmark> all;
  for (std::size_t k = 0; k < known.rows.size(); ++k) {
    const Index row = known.rows[k];
    if (!std::isfinite(covariance(2 * row, 2 * row))) continue;
    all.push_back({row, known.positions_m.row(static_cast<Index>(k)).transpose(),
                   landmarks_m[static_cast<std::size_t>(row)]});
  }
  KnownLandmarksTest test;
  if (all.size() < 2) return test;
  test.bound = known_landmarks_bound(all.size());
  const KnownMotion whole = fit(all);
  test.statistic = whole.statistic;
  if (test_scale(all, noise, test) || !(test.statistic > test.bound)) return test;
  const auto add = [&](FitCode code, std::vector<Index> rows, double distance_m) {
    test.rows.push_back(std::move(rows));
    test.causes.push_back({.code = code,
                           .values = {{.id = "distance_m", .value = distance_m}},
                           .statistic = test.statistic,
                           .bound = test.bound});
  };
  const std::vector<KnownLandmarksCause> found = causes_that_fit(all, fit);
  if (is_clear(found, all.size())) {
    add(found[0].code, found[0].rows, found[0].distance_m);
    return test;
  }
  std::vector<Index> rows;
  double most_m = 0.0;
  for (const GivenLandmark& p : all) {
    rows.push_back(p.row);
    most_m = std::max(most_m, whole.distance_m(p));
  }
  add(FitCode::kKnownLandmarksAtOdds, std::move(rows), most_m);
  return test;
}

}  // namespace mapproof
