#include "core/labels/mixed_fault.hpp"

namespace mapproof {
namespace {

/// Whether a scan holds a detection of a landmark.
bool seen_in_scan(const DetectionLog& log, const std::vector<int>& labels, std::size_t row,
                  int landmark) {
  const int step = log.detections[row].step;
  while (row > 0 && log.detections[row - 1].step == step) --row;
  for (; row < labels.size() && log.detections[row].step == step; ++row)
    if (labels[row] == landmark) return true;
  return false;
}

/// What each detection costs in a map under each label in its place, its scan's others keeping
/// theirs: detections x landmarks, nothing but of those that bear `label`.
Eigen::MatrixXd label_costs(const LabelledScans& scans, const std::vector<int>& labels,
                            const RobustMap& map, int label) {
  const Eigen::Index M = map.positions_m.rows();
  Eigen::MatrixXd costs = Eigen::MatrixXd::Zero(std::ssize(labels), M);
  for (const ScanPair& pair : scans.pairs)
    for (const auto& [own, other] :
         {std::pair(pair.first, pair.second), std::pair(pair.second, pair.first)}) {
      if (labels[own] != label) continue;
      const Eigen::RowVector2d partner = map.positions_m.row(labels[other]);
      for (Eigen::Index k = 0; k < M; ++k)
        costs(static_cast<Eigen::Index>(own), k) +=
            huber_cost(pair.distance_m - (map.positions_m.row(k) - partner).norm(), map.width_m);
    }
  return costs;
}

}  // namespace

std::optional<FaultTrial> mixed_trial(const LabelledScans& scans, const std::vector<int>& labels,
                                      const RobustMap& map) {
  const double much = 8.0 * residual_variance(map);
  const auto M = static_cast<int>(map.positions_m.rows());
  FaultTrial best;
  double greatest = 0.0;
  for (int a = 0; a < M && map.positions_m.row(a).allFinite(); ++a) {
    const Eigen::MatrixXd costs = label_costs(scans, labels, map, a);
    Eigen::VectorXd gains = Eigen::VectorXd::Zero(M);
    const auto mistaken = [&](Eigen::Index row, int b) {
      return costs(row, a) > much && costs(row, b) < 0.5 * costs(row, a);
    };
    for (Eigen::Index row = 0; row < costs.rows(); ++row)
      for (int b = 0; b < M; ++b)
        if (mistaken(row, b)) gains(b) += costs(row, a) - costs(row, b);
    Eigen::Index other = 0;
    if (gains.maxCoeff(&other) <= greatest) continue;
    greatest = gains(other);
    const auto b = static_cast<int>(other);
    best.fault = {.fault = LabelFault::kInPart, .first = a, .second = b};
    best.stretch = {0, 0, scans.places.front().size()};
    best.labels = labels;
    for (std::size_t row = 0; row < labels.size(); ++row)
      if (labels[row] == a && mistaken(static_cast<Eigen::Index>(row), b) &&
          !seen_in_scan(scans.log, labels, row, b))
        best.labels[row] = b;
  }
  if (greatest == 0.0) return std::nullopt;
  best.map =
      lowered_map(pair_items(scans.pairs, best.labels, scans.blocks), map.positions_m, map.width_m);
  return best;
}

}  // namespace mapproof
