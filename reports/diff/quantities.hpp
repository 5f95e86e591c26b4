#pragma once

#include <cmath>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <utility>

namespace mapproof {

/// How far apart two values may be and still count as the same.
struct Tolerance {
  double absolute = 0.0;  ///< In the unit of the quantity; infinite: never beyond.
  double relative = 0.0;  ///< Of the greater magnitude.

  bool holds(double a, double b) const {
    return a == b || std::abs(a - b) <= absolute + relative * std::max(std::abs(a), std::abs(b));
  }
};

/// Which way a quantity improves.
enum class Direction { kLowerIsBetter, kHigherIsBetter, kNeither };

/// Everything about a compared quantity that its readers ask.
struct QuantityFacts {
  std::string_view name;   ///< In files: "mpe_m".
  std::string_view label;  ///< For readers: "MPE".
  std::string_view unit;   ///< "m", "%"; empty: none.
  Direction direction = Direction::kNeither;
  Tolerance tolerance;     ///< Unless settings say otherwise.
  bool of_solver = false;  ///< Of how it went, no error of what came out: a hint, never a proof.
};

/// All that the records are compared by. The tolerances are what rounding may do on another
/// processor, not what a reader would shrug at: solvers repeat exactly on the same one.
std::span<const QuantityFacts> all_quantities();

/// Null if there is none of that name.
const QuantityFacts* find_quantity(std::string_view name);

/// Tolerances by a quantity's name, in place of its own.
using Tolerances = std::map<std::string, Tolerance, std::less<>>;

Tolerance tolerance_of(const QuantityFacts& quantity, const Tolerances& changed);

/// "0.152", four digits, without its unit.
std::string quantity_text(double value);

/// Both in as many digits as tell the two apart, at least so many; "none" for what is no number.
std::pair<std::string, std::string> told_apart(double baseline, double current, int digits);

/// "0.138 → 0.152 m": as many digits as tell the two apart, at least three.
std::string change_text(double baseline, double current, std::string_view unit);

}  // namespace mapproof
