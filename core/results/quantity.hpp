#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace mapproof {

/// How far apart two values may be and still count as the same.
struct Tolerance {
  double absolute = 0.0;  ///< In the unit of the quantity; infinite: never beyond.
  double relative = 0.0;  ///< Of the greater magnitude.

  bool holds(double a, double b) const {
    return a == b || std::abs(a - b) <= absolute + relative * std::max(std::abs(a), std::abs(b));
  }

  bool operator==(const Tolerance&) const = default;
};

/// Which way a quantity improves.
enum class Better { kLower, kHigher, kNeither };

/// "lower", "higher", "neither".
std::string_view name(Better better);
std::optional<Better> better_named(std::string_view name);

/// What nightly runs do with a quantity.
enum class NightlyRule {
  kNone,      ///< It is not kept.
  kKept,      ///< It is in the history and its export.
  kShown,     ///< It has trend figures and tables as well, but is not judged.
  kRatio,     ///< Accuracy, judged by the ratio of the two values.
  kPoints,    ///< Accuracy in percent, judged by their difference.
  kDuration,  ///< Seconds.
};

/// Everything about a measured quantity that its readers ask.
struct Quantity {
  std::string id = {};     ///< [a-z][a-z0-9_]*, with its unit: "mpe_m".
  std::string label = {};  ///< For readers, without the unit: "MPE".
  std::string unit = {};   ///< "m", "%"; empty: a count or a ratio.
  Better better = Better::kNeither;
  Tolerance rounding = {1e-9, 1e-6};  ///< What rounding may do on another processor.
  NightlyRule nightly = NightlyRule::kShown;
  bool of_solver =
      false;  ///< Of the course of a solve, not an error of its result: an indication, no evidence.
  /// The id of a quantity that measures much the same: nightly runs judge this one only where a
  /// method does not have that one.
  std::string stands_in_for = {};

  bool operator==(const Quantity&) const = default;
};

/// The dictionary: all that mapproof itself measures, the most informative first. What rounding may
/// do is not what a reader would shrug at: solvers repeat exactly on the same processor.
std::span<const Quantity> all_quantities();

/// The dictionary's entry; null if there is none of that id.
const Quantity* find_quantity(std::string_view id);

/// The dictionary's entry. @throws InvalidInput if there is none of that id.
const Quantity& known_quantity(std::string_view id);

/// Whether it is [a-z][a-z0-9_]*, not too long.
bool is_quantity_id(std::string_view id);

/// Why a study may not name such a quantity: its id or label cannot be one, or the dictionary has
/// the id with another unit or direction. Empty if it may.
std::string problem_of(const Quantity& quantity);

/// A quantity as a study names it: of an id that the dictionary has, its entry under the study's
/// label; of another, a declaration with the rounding of a new Quantity, which nightly runs judge
/// if one way is better: by points if its unit is %, else by the ratio.
/// @throws InvalidInput with problem_of() it.
Quantity study_quantity(std::string id, std::string label, std::string unit, Better better);

/// The dictionary and what one study declares besides it.
class Quantities {
 public:
  /// Adds a quantity that the dictionary does not have; one that it has is left as it is there.
  /// @throws InvalidInput with problem_of() it, or if the id was declared with another unit or
  ///         direction.
  void declare(const Quantity& quantity);

  /// Null if neither the dictionary nor the study has it.
  const Quantity* find(std::string_view id) const;

  /// @throws InvalidInput if neither the dictionary nor the study has it.
  const Quantity& at(std::string_view id) const;

  /// The study's own, in the order of their ids.
  const std::vector<Quantity>& declared() const { return declared_; }

  /// All, the dictionary's first.
  std::vector<Quantity> all() const;

  bool operator==(const Quantities&) const = default;

 private:
  std::vector<Quantity> declared_;
};

/// "MPE [m]"; without a unit the label alone.
std::string label_with_unit(const Quantity& quantity);

/// Where a quantity stands in the dictionary; of a declared one, its size: after all of them.
std::size_t dictionary_rank(const Quantity& quantity);

}  // namespace mapproof
