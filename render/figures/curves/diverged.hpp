#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/not_finite.hpp"
#include "render/plot/figure.hpp"

namespace mapproof {

/// The one rule for errors of maps that diverged, in curves, dots and distributions: unless all
/// values of a figure are such, they widen no axis, a triangle at its end stands for them, and a
/// note names whose they are.

/// Above which an error in a unit is that of a map that diverged; infinite where none can be.
/// @param great_errors  Whether such values are of maps that diverged, and no distances.
double divergence_in(std::string_view unit, bool great_errors);

/// Above which values are not on their axis: the divergence, unless all of them are above it.
double axis_ceiling(std::span<const double> values, double divergence);

/// The values that are on their axis.
std::vector<double> without_diverged(std::vector<double> values, double divergence);

/// How many of the values under one label are of maps that diverged.
struct DivergedCount {
  std::string label;
  std::ptrdiff_t diverged = 0;
  std::ptrdiff_t known = 0;

  /// @param divergence  Above which a value is one that diverged.
  void see(double value, double divergence);
};

/// Adds "Diverged, over 1 km: A at 1 of 4 points and B." unless none did.
/// @param preposition  Before "1 of 4".
/// @param of           What are counted, more than one.
void note_diverged(const std::vector<DivergedCount>& counts, std::string_view preposition,
                   std::string_view of, std::vector<Note>& notes);

/// Where triangles stand for what lies above an axis: on it, near its upper end.
double near_end(Scale scale, const Range& limits);

/// An axis of dots, some of which may be of maps that diverged.
struct DotAxis {
  std::optional<Range> limits = {};  ///< None where all dots are on it: they decide.
  double ceiling = kInfinity;        ///< Values above it are not on it.
  double end = kNaN;                 ///< Where the triangles stand that stand for those.

  double place_of(double value) const { return value > ceiling ? end : value; }
};

/// @param values  All that the figure shows.
/// @param scale   Of the axis.
DotAxis dot_axis(const std::vector<double>& values, Scale scale, double divergence);

/// Triangles, as the legend explains them; none yet.
Scatter diverged_dots(ThemeColour colour);

}  // namespace mapproof
