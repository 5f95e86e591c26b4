#include "core/range_slam/known_landmarks.hpp"

#include <cmath>
#include <set>

#include <fmt/format.h>

#include "core/base/errors.hpp"
#include "core/base/not_finite.hpp"
#include "core/linalg/decompositions.hpp"
#include "core/range_slam/factors/squared_ranges.hpp"
#include "core/range_slam/log_checks.hpp"

namespace mapproof {
namespace {

void check(const Factorization& factors, const std::vector<Eigen::Index>& rows,
           const Eigen::MatrixXd& positions_m) {
  const Eigen::Index rank = positions_m.cols() + 2;
  if (factors.U.cols() < rank || factors.V.rows() != factors.U.cols() || factors.V.cols() < rank)
    throw InvalidInput(fmt::format("a map needs a factorisation of rank {} or more", rank));
  const std::string problem = known_problem(rows, positions_m, factors.U.rows());
  if (!problem.empty()) throw InvalidInput(problem);
}

/// Takes X of points moved by -center and divided by `unit` to X of the points.
Eigen::MatrixXd to_metres(const Eigen::RowVectorXd& center, double unit) {
  const Eigen::Index d = center.size();
  Eigen::MatrixXd change = Eigen::MatrixXd::Identity(d + 2, d + 2);
  change.col(0).segment(1, d) = -center.transpose();
  change.block(1, 1, d, d) *= unit;
  change.row(d + 1) << 0.5 * center.squaredNorm(), -unit * center, unit * unit;
  return change;
}

}  // namespace

SpectralMap map_from_known_landmarks(const Factorization& factors, const KnownLandmarks& known) {
  return map_from_known_positions(factors, known.rows, known.positions_m);
}

SpectralMap map_from_known_positions(const Factorization& factors,
                                     const std::vector<Eigen::Index>& rows,
                                     const Eigen::MatrixXd& positions_m) {
  check(factors, rows, positions_m);
  const Eigen::Index rank = positions_m.cols() + 2;
  const bool in_plane = rank == 4;
  SpectralMap map;
  map.statuses = factors.statuses;
  if (std::ssize(rows) < rank) {
    map.statuses.push_back(status_of<StatusReason::kFewKnownLandmarks>(rows.size(), rank));
    return map;
  }

  // In units of their spread about their centre the condition is one of shape alone.
  const Eigen::RowVectorXd center = positions_m.colwise().mean();
  const Eigen::MatrixXd offsets = positions_m.rowwise() - center;
  const double unit = std::sqrt(offsets.squaredNorm() / static_cast<double>(offsets.rows()));
  const Eigen::MatrixXd shape = unit > 0.0 ? Eigen::MatrixXd(offsets / unit) : offsets;
  const Eigen::JacobiSVD<Eigen::MatrixXd> svd(landmark_states(shape),
                                              Eigen::ComputeThinU | Eigen::ComputeThinV);
  const Eigen::VectorXd& s = svd.singularValues();
  const double least = s(rank - 1);
  map.condition = least > 0.0 ? s(0) / least : kInfinity;
  if (!(*map.condition < kDegenerateCondition)) {
    map.statuses.push_back(
        status_of<StatusReason::kKnownDegenerate>(in_plane ? 2 : 3, *map.condition));
    return map;
  }

  // U = C S^-1 on the known rows, so X = S^-1 V; longer ranges lengthen all of X.
  const Eigen::MatrixXd small_X =
      svd.solve(factors.U(rows, Eigen::all)) / (unit * unit) * factors.V;
  const Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr(small_X.transpose());
  const Eigen::MatrixXd change = to_metres(center, unit);
  const double squared_scale = small_X.row(0).mean();
  if (!(squared_scale > 0.0) || qr.rank() < rank) {
    map.statuses.push_back(status_of<StatusReason::kRankOfPath>(in_plane ? 2 : 3));
    return map;
  }
  map.X = change * small_X / squared_scale;
  map.range_scale = std::sqrt(squared_scale);
  // C = U S, by regression of U V on X.
  const Eigen::MatrixXd S = qr.solve(factors.V.transpose()).transpose();
  map.C = factors.U * S * change.inverse();
  return map;
}

std::string known_problem(const KnownLandmarks& known, Eigen::Index n) {
  return known_problem(known.rows, known.positions_m, n);
}

std::string known_problem(const std::vector<Eigen::Index>& rows, const Eigen::MatrixXd& positions_m,
                          Eigen::Index n) {
  if (positions_m.rows() != std::ssize(rows) || !positions_m.allFinite())
    return "known landmarks need a finite position each";
  for (const Eigen::Index row : rows)
    if (row < 0 || row >= n) return fmt::format("no landmark is number {}", row);
  if (std::set(rows.begin(), rows.end()).size() != rows.size())
    return "a known landmark is there twice";
  return "";
}

}  // namespace mapproof
