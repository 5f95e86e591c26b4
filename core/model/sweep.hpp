#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/model/sensor.hpp"
#include "core/model/variation.hpp"

namespace mapproof {

/// A factor that a sweep can take, as files and tables of results name it.
struct SweptFactor {
  std::string_view name;   ///< With its unit: "bearing_noise_deg".
  std::string_view label;  ///< "noise of bearings".
  std::string_view unit;   ///< "°".
  Factor factor;
  double scale = 1.0;                     ///< From this unit to the factor's own.
  std::optional<Sensor> sensor = {};      ///< The only one that has it; empty: all do.
  double maximum = info(factor).maximum;  ///< In this unit, inclusive.

  double minimum() const { return info(factor).minimum / scale; }
};

/// All of them, in the order in which they are set: the reach of visibility goes by the diameter.
std::span<const SweptFactor> swept_factors();

/// The factor of that name; null if there is none.
const SweptFactor* swept_factor_named(std::string_view name);

/// A factor and the levels that a sweep gives it.
struct SweptLevels {
  std::string factor;          ///< SweptFactor::name.
  std::vector<double> levels;  ///< Ascending.
};

/// One factor or two, every combination of whose levels is tried.
using Sweep = std::vector<SweptLevels>;

}  // namespace mapproof
