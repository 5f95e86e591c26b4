#include "core/observe/features.hpp"

#include <fmt/format.h>

#include "core/base/errors.hpp"

namespace mapproof {
namespace {

using Mask = Eigen::Array<bool, Eigen::Dynamic, Eigen::Dynamic>;

/// `rows` less the mean of the observed entries of each; unobserved entries stay zero.
Eigen::MatrixXd centered_rows(const Eigen::MatrixXd& rows, const Mask& missing) {
  const Eigen::ArrayXd counts =
      (static_cast<double>(rows.cols()) - missing.cast<double>().rowwise().sum()).max(1.0);
  const Eigen::VectorXd means = (rows.rowwise().sum().array() / counts).matrix();
  return missing.select(0.0, rows.colwise() - means);
}

}  // namespace

void require_steps(const ObservationHistory& history, Eigen::Index steps) {
  if (steps < 1 || steps > history.steps())
    throw InvalidInput(
        fmt::format("{} observations requested, 1 to {} are available", steps, history.steps()));
}

Features features(const ObservationHistory& history, Eigen::Index steps) {
  require_steps(history, steps);
  const auto raw = history.values.leftCols(steps);
  const Mask missing = raw.array().isNaN();
  const Eigen::MatrixXd known = missing.select(0.0, raw);
  Features result;
  switch (history.sensor) {
    case Sensor::kVisibility:
      result.values = known;
      break;
    case Sensor::kBearing:
      result.values.resize(raw.rows(), 2 * steps);
      result.values << missing.select(0.0, known.array().cos()).matrix(),
          known.array().sin().matrix();
      break;
    case Sensor::kRange:
      result.values = centered_rows(known.array().square().matrix(), missing);
      break;
  }
  if (missing.any()) {
    const Eigen::MatrixXd observed = 1.0 - missing.cast<double>();
    result.observed = observed.replicate(1, result.values.cols() / steps);
  }
  return result;
}

}  // namespace mapproof
