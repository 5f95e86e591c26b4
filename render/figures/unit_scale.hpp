#pragma once

#include <optional>
#include <string>

#include "core/results/quantity.hpp"

namespace mapproof {

/// The unit in which values of a figure are written, such as "mm" for "m".
struct ScaledUnit {
  std::string unit;
  double factor = 1.0;  ///< From the values' own unit.
};

/// The unit in which the greatest of some values is written without a power of ten and with few
/// zeros: below 1 mm it is "mm", below 0.01 rad "mrad", below 1 s "ms", below 1 ms "µs", whether
/// they are in s, ms or µs, and below 0.001 ppm a power of ten, "10⁻¹⁵" for 10⁻⁹ ppm. Any other
/// unit stays.
ScaledUnit scaled_unit(const std::string& unit, double greatest);

/// The same of a quantity; an MPE is in m everywhere.
ScaledUnit scaled_unit(const Quantity& quantity, double greatest);

/// The quantity with that unit.
Quantity in_unit(Quantity quantity, const ScaledUnit& unit);

/// −15 of "10⁻¹⁵", where that is the unit of a scaled_unit().
std::optional<int> power_of(const std::string& unit);

}  // namespace mapproof
