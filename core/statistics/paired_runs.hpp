#pragma once

#include <span>
#include <string>
#include <vector>

#include "core/base/interned.hpp"
#include "core/results/quantity.hpp"
#include "core/statistics/paired_change.hpp"

namespace mapproof {

/// How runs of two records are compared in pairs, by `diff` and by nightly runs: what a change is,
/// which units are independent, and which test they take.

/// With fewer units there is no test.
inline constexpr int kLeastUnits = 3;

/// With so many groups their means are the units, with fewer the runs are.
inline constexpr int kLeastGroups = 6;

/// By how much one value of a run changed. 16 bytes: a nightly run may have 10^7.
struct RunChange {
  Name run = {}, group = {};
  double value = 0.0;
};

/// Whether a quantity changes by the difference of its values; else by the logarithm of their
/// ratio.
bool changes_in_points(const Quantity& quantity);

/// Below it an error counts as nothing: in ratios this stands for it.
inline constexpr double kLeastError = 1e-9;

/// The change of a value: a difference, or the logarithm of a ratio, in which kLeastError stands
/// for less.
double value_change(bool in_points, double before, double after);

/// Changes that are independent of each other.
struct PairedUnits {
  std::vector<double> changes = {};
  std::string unit = "run";  ///< "layout", "group"; "run" also if each run is a group of its own.
};

/// The means of the changes of each group, or of each run.
/// @param changes  In ascending order of the runs; a run may have several.
/// @param draws_groups  Groups are the units, however few (StudyContents::draws_groups).
PairedUnits paired_units(std::vector<RunChange> changes, bool draws_groups);

/// The tests of one comparison of two records.
struct PairedTests {
  std::vector<PairedChange> changes = {};  ///< Of each quantity.
  std::vector<double> p = {};  ///< Of each, then of the others, corrected by Holm for all of them.
};

/// Judges the units of several quantities by paired_change(): by ranks where these can pass the
/// correction for so many tests at the level of a nightly run.
/// @param others  p of other tests of the same comparison.
PairedTests test_pairs(std::span<const std::span<const double>> units,
                       std::span<const double> others = {});

}  // namespace mapproof
