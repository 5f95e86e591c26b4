#pragma once

#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "render/base/geometry.hpp"
#include "render/plot/figure.hpp"
#include "reports/diff/figures/figure_layers.hpp"
#include "reports/diff/figures/figure_match.hpp"
#include "reports/diff/figures/figure_positions.hpp"
#include "reports/diff/verdict/tolerances.hpp"

namespace mapproof {

/// The subject of a difference of two figures.
enum class ChangeKind {
  kMetadata,  ///< Texts: title, caption, alternative text. Numbers in them are data.
  kStyle,     ///< Appearance: colour, dash, marker, label, scale, limits, legend, layout.
  kData,      ///< Content.
};

/// "metadata", "style", "data".
std::string_view name(ChangeKind kind);

/// One difference that is not a movement.
struct FigureChange {
  ChangeKind kind = ChangeKind::kStyle;
  std::string location;  ///< "panel 1, polyline \"ISOMAP\""; "figure".
  std::string what;      ///< "colour", "limits of x", "layer removed", "points".
  std::string baseline;  ///< Empty: none.
  std::string current;
};

/// A mark, or a point of a curve, that moved.
struct MarkMove {
  std::string location;     ///< As FigureChange::location.
  std::string mark;         ///< Mark::id, "" if it has none.
  std::string landmark;     ///< Its data-landmark, "" if it has none.
  std::string curve;        ///< Its data-curve, "" if it has none.
  std::size_t panel = 0;    ///< Its index in the figure, from 0.
  std::size_t point = 0;    ///< Its index in the layer, from 0.
  Point baseline, current;  ///< In the units of the axes.
  double distance = 0.0;    ///< In the units of the axes; NaN: a position on only one side.
  std::string unit;         ///< Of the axis along which it moved; empty: none, or two units.
  std::string x_unit, y_unit;         ///< Of the axes; empty: none.
  std::optional<double> distance_px;  ///< On the page of the report's theme.
  bool is_line = false;               ///< Of lines that join points of other layers.
  bool on_map = false;                ///< Both axes have one scale.
};

/// The differences of two figures.
struct FigureDiff {
  bool equal = false;                 ///< The values are the same, bit by bit.
  std::vector<FigureChange> changes;  ///< At most 200, data first.
  long total_changes = 0;
  std::vector<MarkMove> moves;  ///< Beyond tolerance; at most 200, the farthest on the page first.
  std::vector<std::string> transforms;  ///< What moved all points of a layer together.
  long moved = 0;                       ///< Of all points, those beyond tolerance.
  /// Of all points, those that moved within tolerance: a landmark once, however many layers draw
  /// it, and not if it moved beyond tolerance in one of them.
  long within = 0;
  long within_landmarks = 0;  ///< Of these, the landmarks.
  long masked = 0;  ///< Points that moved in a figure marked `varies`: not judged.
  /// Mean of data-error over the marks of both sides that are no anchors; none if there are no such
  /// marks.
  std::optional<double> baseline_error, current_error;

  /// Whether there is a change of that kind beyond tolerance.
  bool has(ChangeKind kind) const;
};

struct FigureOptions {
  /// Absolute in units of the axes, relative to the span of the panel's data.
  Tolerance position{1e-9, 1e-6};
};

/// FigureChange::what of a figure that was made from different records.
inline constexpr std::string_view kRecordsWord = "records";

/// The beginning of the cause of a figure that differs only in its records.
inline constexpr std::string_view kMadeOfOthers = "made from other records";

/// Collects the differences of two figures, up to a limit.
class FigureLog {
 public:
  /// @param varies  Positions and numbers are then only counted as masked. Changed texts, layers,
  /// numbers of points and records are still reported.
  explicit FigureLog(bool varies) : varies_(varies) {}

  /// Adds a change; does nothing if both values are equal.
  void change(ChangeKind kind, const std::string& location, std::string_view what,
              const std::string& baseline, const std::string& current);
  void move(MarkMove move);
  /// What moved all points of a layer together.
  void transform(std::string text);
  /// Counts a difference that is not judged, as the figure varies.
  long moved() const { return diff_.moved; }
  void mask() { ++diff_.masked; }
  /// Counts a point that moved within tolerance. @param landmark  Empty: it is none.
  void within(std::size_t panel = 0, std::string_view landmark = {});
  /// Adds the errors of marks on both sides: their sums, and their number.
  void errors(double baseline, double current, double count);

  /// Returns all differences: changes of data first, large movements first.
  FigureDiff take();

 private:
  bool varies_;
  FigureDiff diff_;
  /// With their panels.
  std::set<std::pair<std::size_t, std::string>> moved_landmarks_, within_landmarks_;
  double baseline_errors_ = 0.0, current_errors_ = 0.0, errors_ = 0.0;
};

/// One panel of a figure that is compared. What it refers to must outlive it.
struct ComparedPanel {
  std::size_t panel = 0;  ///< Its index in the figure.
  const Figure& figure;   ///< The baseline.
  const FigurePositions& locations;
  const FigureOptions& options;
  /// In a figure that varies: the names of the points that are on both sides of the panel, see
  /// shared_names(). It is not judged in which layer they are. Else null.
  const std::set<std::string>* shared = nullptr;
};

/// Compares the layers of one panel.
class LayerDiff {
 public:
  /// @param log  Must outlive this.
  LayerDiff(const ComparedPanel& panel, FigureLog& log);

  /// Compares two layers of one kind.
  void compare(const LayerView& baseline, const LayerView& current);
  /// Adds a layer of one side only.
  void lone(const Layer& layer, bool removed);
  /// Adds the errors of the marks, whether they differ or not.
  void add_errors(const LayerView& baseline, const LayerView& current);
  /// "panel 2, polyline \"ISOMAP\"".
  std::string location(const LayerView& layer) const;

 private:
  void compare_point(const LayerView& a, std::size_t i, const LayerView& b, std::size_t j);
  void compare_values(const LayerView& a, const LayerView& b, const std::vector<Match>& matches);
  void compare_data(const Mark& a, const Mark& b);
  bool may_vary(const LayerView& layer, std::size_t point) const;
  void lone_points(const char* what, const LayerView& layer,
                   const std::vector<std::size_t>& points);
  void take_renamed(const LayerView& a, std::vector<std::size_t>& removed, const LayerView& b,
                    std::vector<std::size_t>& added);
  void note_transform(const LayerView& a, const LayerView& b, const std::vector<Match>& matches);
  MarkMove mark_move(const LayerView& layer, std::size_t point, Point before, Point after) const;

  ComparedPanel panel_;
  FigureLog& log_;
  std::string location_;  ///< The location of the layer that is compared.
  /// Landmarks with known positions: a mean error is without them.
  std::set<std::string> anchors_;
};

/// Names of the points that both panels have, in any layers.
std::set<std::string> shared_names(const Panel& a, const Panel& b);

}  // namespace mapproof
