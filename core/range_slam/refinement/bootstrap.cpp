#include "core/range_slam/refinement/bootstrap.hpp"

#include <algorithm>

#include "core/align/aligned_to.hpp"
#include "core/base/errors.hpp"
#include "core/range_slam/factors/metric_upgrade.hpp"
#include "core/statistics/block_bootstrap.hpp"

namespace mapproof {
LandmarkBootstrap bootstrap_landmarks(const Eigen::MatrixXd& Y, const Points& landmarks_m,
                                      const std::optional<KnownLandmarks>& known,
                                      const BootstrapOptions& options) {
  const Eigen::Index N = Y.rows(), T = Y.cols();
  if (landmarks_m.rows() != N || N < 4 || T < 8)
    throw InvalidInput("a bootstrap needs the map's landmarks, 4 or more, and 8 steps or more");
  if (!Y.allFinite() || !landmarks_m.allFinite())
    throw InvalidInput("a bootstrap needs finite ranges and landmarks");
  if (options.replicates < 2 || options.replicates > 100000 || options.block < 1)
    throw InvalidInput("a bootstrap needs 2 to 100,000 replicates of blocks of 1 step or more");

  std::vector<Points> maps;
  for (int i = 0; i < options.replicates; ++i) {
    Random random(derive_seed(options.seed, {static_cast<std::uint64_t>(i)}));
    const auto steps = block_resample(T, std::min(options.block, T), BlockEnds::kInside, random);
    const Factorization factors = factorize(Y(Eigen::all, steps), 4);
    const SpectralMap map =
        known ? map_from_known_landmarks(factors, *known) : metric_upgrade(factors).map;
    if (map.empty()) continue;
    const Points landmarks = landmarks_of(map.C);
    maps.push_back(known ? landmarks : *aligned_to(landmarks, landmarks_m));
  }
  LandmarkBootstrap result{.covariances_m2 = {}, .maps = static_cast<int>(maps.size())};
  if (maps.size() < 2) return result;
  Points mean = Points::Zero(N, 2);
  for (const Points& map : maps) mean += map / double(maps.size());
  result.covariances_m2.assign(static_cast<std::size_t>(N), Eigen::Matrix2d::Zero());
  for (const Points& map : maps)
    for (Eigen::Index n = 0; n < N; ++n) {
      const Eigen::Vector2d offset = (map.row(n) - mean.row(n)).transpose();
      result.covariances_m2[static_cast<std::size_t>(n)] +=
          offset * offset.transpose() / double(maps.size() - 1);
    }
  return result;
}

}  // namespace mapproof
