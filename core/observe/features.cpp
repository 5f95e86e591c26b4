#include "core/observe/features.hpp"

#include <bit>
#include <cstddef>
#include <cstdint>
#include <numbers>

#include <fmt/format.h>

#include "core/base/errors.hpp"
#include "core/base/vectorised.hpp"

namespace mapproof {
namespace {

using Mask = Eigen::Array<bool, Eigen::Dynamic, Eigen::Dynamic>;

// Cody and Waite's reduction to |r| <= pi / 4: pi / 2 in two parts of which the first has 33 bits,
// so that its product with a quarter's number is exact. The polynomials are those of minimax
// approximation in Sun's fdlibm (k_sin.c, k_cos.c).
constexpr double kQuarterHead = 1.57079632673412561417e+00;
constexpr double kQuarterTail = 6.07710050650619224932e-11;
constexpr double kToInteger = 6755399441055744.0;  // 1.5 * 2^52: adding it rounds to an integer.

double sine_near_zero(double r, double z) {
  constexpr double kS1 = -1.66666666666666324348e-01, kS2 = 8.33333333332248946124e-03,
                   kS3 = -1.98412698298579493134e-04, kS4 = 2.75573137070700676789e-06,
                   kS5 = -2.50507602534068634195e-08, kS6 = 1.58969099521155010221e-10;
  const double rest = kS2 + z * (kS3 + z * (kS4 + z * (kS5 + z * kS6)));
  return r + z * r * (kS1 + z * rest);
}

double cosine_near_zero(double z) {
  constexpr double kC1 = 4.16666666666666019037e-02, kC2 = -1.38888888888741095749e-03,
                   kC3 = 2.48015872894767294178e-05, kC4 = -2.75573143513906633035e-07,
                   kC5 = 2.08757232129817482790e-09, kC6 = -1.13596475577881948265e-11;
  const double rest = kC1 + z * (kC2 + z * (kC3 + z * (kC4 + z * (kC5 + z * kC6))));
  const double half = 0.5 * z;
  const double w = 1.0 - half;
  return w + ((1.0 - w - half) + z * z * rest);
}

}  // namespace

void require_steps(const HistoryBlocks& history, Eigen::Index steps) {
  if (steps < 1 || steps > history.steps())
    throw InvalidInput(
        fmt::format("{} observations requested, 1 to {} are available", steps, history.steps()));
}

Eigen::VectorXd mean_squared_ranges(const HistoryBlocks& history, Eigen::Index steps) {
  Eigen::VectorXd sums = Eigen::VectorXd::Zero(history.landmarks());
  Eigen::VectorXd counts = sums;
  for_blocks(history, steps, [&](Eigen::Index, const Eigen::MatrixXd& values) {
    const Mask missing = values.array().isNaN();
    const Eigen::MatrixXd squares = missing.select(0.0, values).array().square();
    sums += squares.rowwise().sum();
    counts.array() += static_cast<double>(values.cols()) - missing.cast<double>().rowwise().sum();
  });
  return sums.cwiseQuotient(counts.cwiseMax(1.0));
}

Features features_of(const Eigen::MatrixXd& values, Sensor sensor,
                     const Eigen::VectorXd& mean_squares) {
  const Mask missing = values.array().isNaN();
  const Eigen::MatrixXd known = missing.select(0.0, values);
  Features result;
  switch (sensor) {
    case Sensor::kVisibility:
      result.values = known;
      break;
    case Sensor::kBearing:
      result.values.resize(values.rows(), 2 * values.cols());
      result.values << missing.select(0.0, known.array().cos()).matrix(),
          known.array().sin().matrix();
      break;
    case Sensor::kRange:
      result.values = known.array().square().matrix();
      result.values = missing.select(0.0, result.values.colwise() - mean_squares);
      break;
  }
  if (missing.any()) {
    const Eigen::MatrixXd observed = 1.0 - missing.cast<double>();
    result.observed = observed.replicate(1, result.values.cols() / values.cols());
  }
  return result;
}

Features features(const ObservationHistory& history, Eigen::Index steps) {
  require_steps(history, steps);
  Eigen::VectorXd means;
  if (history.sensor == Sensor::kRange) means = mean_squared_ranges(history, steps);
  return features_of(history.values.leftCols(steps), history.sensor, means);
}

MAPPROOF_VECTORISED_WIDE void directions_of(std::span<const double> angles_rad,
                                            std::span<double> cosines, std::span<double> sines) {
  const std::size_t count = angles_rad.size();
  const double* in = angles_rad.data();
  double* __restrict__ cosine = cosines.data();
  double* __restrict__ sine = sines.data();
  for (std::size_t i = 0; i < count; ++i) {
    const double shifted = in[i] * (2.0 * std::numbers::inv_pi) + kToInteger;
    const double quarters = shifted - kToInteger;
    const auto quadrant = std::bit_cast<std::uint64_t>(shifted);  // In its last two bits.
    const double r = (in[i] - quarters * kQuarterHead) - quarters * kQuarterTail;
    const double z = r * r;
    const auto s = std::bit_cast<std::uint64_t>(sine_near_zero(r, z));
    const auto c = std::bit_cast<std::uint64_t>(cosine_near_zero(z));
    // Odd quadrants exchange both; the signs are those of the quadrant.
    const std::uint64_t exchanged = (s ^ c) & (0 - (quadrant & 1));
    sine[i] = std::bit_cast<double>((s ^ exchanged) ^ ((quadrant & 2) << 62));
    cosine[i] = std::bit_cast<double>((c ^ exchanged) ^ (((quadrant + 1) & 2) << 62));
  }
}

Features directions(const Eigen::MatrixXd& bearings_rad) {
  Features result;
  result.values.resize(bearings_rad.rows(), 2 * bearings_rad.cols());
  const auto size = static_cast<std::size_t>(bearings_rad.size());
  directions_of({bearings_rad.data(), size}, {result.values.data(), size},
                {result.values.data() + size, size});
  return result;
}

}  // namespace mapproof
