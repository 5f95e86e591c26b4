#include "render/figures/unit_scale.hpp"

#include <cmath>

#include "core/base/text/number_text.hpp"

namespace mapproof {
namespace {

constexpr double kGreatestInMm_m = 1e-3;  // Above, the numbers beside a figure are in metres, too.
constexpr double kLeastPpm = 1e-3;
constexpr int kStep = 3;

constexpr int kPpm = -6;

/// "10⁻¹⁵" of a greatest value of some 10⁻⁹ ppm: powers of 10³.
ScaledUnit power_unit(double greatest_ppm) {
  const int exponent = kStep * static_cast<int>(std::floor(std::log10(greatest_ppm) / kStep));
  return {ten_to_the(exponent + kPpm), std::pow(10.0, -exponent)};
}

}  // namespace

std::optional<int> power_of(const std::string& unit) {
  constexpr int kLeast = -324;
  for (int power = kLeast; power < 0; power += kStep)
    if (unit == ten_to_the(power)) return power;
  return std::nullopt;
}

ScaledUnit scaled_unit(const std::string& unit, double greatest) {
  if (!(greatest > 0.0) || std::isinf(greatest)) return {unit};
  if (unit == "m" && greatest < kGreatestInMm_m) return {"mm", 1e3};
  if (unit == "rad" && greatest < 1e-2) return {"mrad", 1e3};
  if (unit == "s" && greatest < 1e-3) return {"µs", 1e6};
  if (unit == "s" && greatest < 1.0) return {"ms", 1e3};
  if (unit == "ms" && greatest < 1.0) return {"µs", 1e3};
  if (unit == "µs" && greatest >= 1e6) return {"s", 1e-6};
  if (unit == "µs" && greatest >= 1e3) return {"ms", 1e-3};
  if (unit == "ms" && greatest >= 1e3) return {"s", 1e-3};
  if (unit == "ppm" && greatest < kLeastPpm) return power_unit(greatest);
  return {unit};
}

ScaledUnit scaled_unit(const Quantity& quantity, double greatest) {
  return quantity.label == "MPE" ? ScaledUnit{quantity.unit} : scaled_unit(quantity.unit, greatest);
}

Quantity in_unit(Quantity quantity, const ScaledUnit& unit) {
  quantity.unit = unit.unit;
  return quantity;
}

}  // namespace mapproof
