#include "core/uncertainty/block_length.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/observe/features.hpp"

namespace mapproof {
namespace {

/// Autocovariances of a centred series at lags 0 to `lags`.
Eigen::VectorXd autocovariances(const Eigen::VectorXd& centred, Eigen::Index lags) {
  const Eigen::Index n = centred.size();
  Eigen::VectorXd R(lags + 1);
  for (Eigen::Index k = 0; k <= lags; ++k)
    R(k) = centred.head(n - k).dot(centred.tail(n - k)) / static_cast<double>(n);
  return R;
}

/// The lag beyond which `run` correlations in a row are within the noise's bound.
Eigen::Index last_correlated_lag(const Eigen::VectorXd& R, Eigen::Index run, double bound) {
  Eigen::Index quiet = 0;
  for (Eigen::Index k = 1; k < R.size(); ++k) {
    quiet = std::abs(R(k)) < bound * R(0) ? quiet + 1 : 0;
    if (quiet == run) return k - run;
  }
  return R.size() - 1;
}

/// What step t adds to the squared distance of two landmarks; steps that miss either are left out.
Eigen::VectorXd pair_series(const Features& rows, Sensor sensor, Eigen::Index steps, Eigen::Index i,
                            Eigen::Index j) {
  const Eigen::VectorXd a = rows.values.row(i).transpose();
  const Eigen::VectorXd b = rows.values.row(j).transpose();
  Eigen::VectorXd added;
  if (sensor == Sensor::kVisibility) {
    // The linear part of the cosine a'b / sqrt(a'a b'b) in what one step adds to its three sums.
    const double aa = a.squaredNorm();
    const double bb = b.squaredNorm();
    const double cosine = aa * bb > 0.0 ? a.dot(b) / std::sqrt(aa * bb) : 0.0;
    const double share_a = aa > 0.0 ? cosine * std::sqrt(bb / aa) / 2.0 : 0.0;
    const double share_b = bb > 0.0 ? cosine * std::sqrt(aa / bb) / 2.0 : 0.0;
    added = a.cwiseProduct(b) - share_a * a.cwiseAbs2() - share_b * b.cwiseAbs2();
  } else {
    const Eigen::VectorXd squares = (a - b).cwiseAbs2();
    added = squares.head(steps);
    if (squares.size() > steps) added += squares.tail(steps);
  }
  if (rows.observed.size() == 0) return added;
  std::vector<Eigen::Index> common;
  for (Eigen::Index t = 0; t < steps; ++t)
    if (rows.observed(i, t) > 0.0 && rows.observed(j, t) > 0.0) common.push_back(t);
  return added(common);
}

}  // namespace

double best_block_length(const Eigen::VectorXd& series) {
  const Eigen::Index n = series.size();
  if (n < 9) return 1.0;
  const Eigen::VectorXd centred = series.array() - series.mean();
  const double size = static_cast<double>(n);
  const double longest = std::ceil(std::min(3.0 * std::sqrt(size), size / 3.0));
  const auto run = static_cast<Eigen::Index>(std::max(5.0, std::sqrt(std::log10(size))));
  const Eigen::Index lags =
      std::min<Eigen::Index>(n - 1, static_cast<Eigen::Index>(std::ceil(std::sqrt(size))) + run);
  const Eigen::VectorXd R = autocovariances(centred, lags);
  if (!(R(0) > 1e-24 * series.squaredNorm() / size)) return 1.0;
  const Eigen::Index last = last_correlated_lag(R, run, 2.0 * std::sqrt(std::log10(size) / size));
  const Eigen::Index window = std::min(2 * std::max<Eigen::Index>(last, 1), lags);

  // Sums over the lags, tapered by the flat-top window of Politis and Romano.
  double spectrum = R(0);
  double slope = 0.0;
  for (Eigen::Index k = 1; k <= window; ++k) {
    const double share = static_cast<double>(k) / static_cast<double>(window);
    const double weight = share <= 0.5 ? 1.0 : 2.0 * (1.0 - share);
    spectrum += 2.0 * weight * R(k);
    slope += 2.0 * weight * static_cast<double>(k) * R(k);
  }
  const double variance = 4.0 / 3.0 * spectrum * spectrum;
  if (!(variance > 0.0)) return 1.0;
  return std::clamp(std::cbrt(2.0 * slope * slope / variance * size), 1.0, longest);
}

Eigen::Index map_block_length(const ObservationHistory& history, Eigen::Index steps) {
  constexpr Eigen::Index kPairs = 60;
  const Features rows = features(history, steps);
  const Eigen::Index M = history.landmarks();
  const Eigen::Index stride = std::max<Eigen::Index>(1, M * (M - 1) / 2 / kPairs);
  double sum = 0.0;
  Eigen::Index count = 0;
  Eigen::Index pair = 0;
  for (Eigen::Index j = 0; j < M; ++j)
    for (Eigen::Index i = j + 1; i < M; ++i)
      if (pair++ % stride == 0) {
        const Eigen::VectorXd series = pair_series(rows, history.sensor, steps, i, j);
        // A pair never seen together has no information on how long steps are correlated.
        if (series.size() == 0 || series.maxCoeff() == series.minCoeff()) continue;
        sum += best_block_length(series);
        ++count;
      }
  const double mean = count > 0 ? sum / static_cast<double>(count) : 1.0;
  return std::clamp<Eigen::Index>(std::llround(mean), 1, (steps + 2) / 3);
}

}  // namespace mapproof
