#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "render/base/geometry.hpp"
#include "render/plot/figure.hpp"
#include "reports/diff/verdict/tolerances.hpp"

namespace mapproof {

/// What a difference of two figures is about.
enum class ChangeKind {
  kMetadata,  ///< Words that explain: title, caption, alternative text; numbers in them are data.
  kStyle,     ///< How it is shown: colour, dash, marker, label, scale, limits, legend, layout.
  kData,      ///< What is shown.
};

/// "metadata", "style", "data".
std::string_view name(ChangeKind kind);

/// One difference that is not a movement.
struct FigureChange {
  ChangeKind kind = ChangeKind::kStyle;
  std::string place;     ///< "panel 1, polyline \"ISOMAP\""; "figure".
  std::string what;      ///< "colour", "limits of x", "layer removed", "points".
  std::string baseline;  ///< Empty: there was none.
  std::string current;
};

/// A mark, or a point of a curve, that moved.
struct MarkMove {
  std::string place;                  ///< As FigureChange::place.
  std::string mark;                   ///< Mark::id, "" if it has none.
  std::string landmark;               ///< Its data-landmark, "" if it has none.
  std::string curve;                  ///< Its data-curve, "" if it has none.
  std::size_t point = 0;              ///< Which of its layer, counted from 0.
  Point baseline, current;            ///< In the units of the axes.
  double distance = 0.0;              ///< In the units of the axes; NaN: a place on one side alone.
  std::string unit;                   ///< Of the axes that it moved along; empty: none, or two.
  std::optional<double> distance_px;  ///< On the page of the report's theme.
};

/// What two figures differ in.
struct FigureDiff {
  bool equal = false;                 ///< The values are the same, bit by bit.
  std::vector<FigureChange> changes;  ///< At most 200, data first.
  long total_changes = 0;
  std::vector<MarkMove> moves;  ///< Beyond tolerance; at most 200, the farthest on the page first.
  long moved = 0;               ///< Of all points, those beyond tolerance.
  long within = 0;              ///< Of all points, those that moved less.
  long masked = 0;              ///< Points that moved in a figure marked `varies`: not judged.
  /// Mean of data-error over the marks of both sides, where there are some.
  std::optional<double> baseline_error, current_error;

  /// Whether anything of that kind changed beyond tolerance.
  bool has(ChangeKind kind) const;
};

struct FigureOptions {
  /// In units of the axes, and of the span of the panel's data.
  Tolerance position{1e-9, 1e-6};
};

/// FigureChange::what of a figure that was made of other records.
inline constexpr std::string_view kRecordsWord = "records";

/// How the cause begins of a figure that differs in nothing else.
inline constexpr std::string_view kMadeOfOthers = "made of other records";

/// Gathers what two figures differ in, within bounds.
class FigureLog {
 public:
  /// @param varies  Places and numbers are counted as masked; other words, layers, numbers of
  ///                points and records are told of such figures too.
  explicit FigureLog(bool varies) : varies_(varies) {}

  /// Notes nothing if both values are the same.
  void change(ChangeKind kind, const std::string& place, std::string_view what,
              const std::string& baseline, const std::string& current);
  void move(MarkMove move);
  /// A difference that is not judged, as the figure varies.
  void mask() { ++diff_.masked; }
  /// A point that moved within tolerance.
  void within() { ++diff_.within; }
  /// Errors of marks on both sides: their sums, and how many.
  void errors(double baseline, double current, double count);

  /// All of it: data changes first, far moves first.
  FigureDiff take();

 private:
  bool varies_;
  FigureDiff diff_;
  double baseline_errors_ = 0.0, current_errors_ = 0.0, errors_ = 0.0;
};

}  // namespace mapproof
