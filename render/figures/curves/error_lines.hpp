#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "core/base/not_finite.hpp"
#include "render/plot/figure.hpp"

namespace mapproof {

/// What x is.
struct LineAxis {
  std::string name;
  std::string unit = {};
};

/// Of the label of an axis: "noise of bearings [°]".
LineAxis line_axis(const std::string& label);

/// The style of the i-th curve of a figure: colour, dash and marker; no two of the first 350 are
/// alike, and no two of the first ten, or of any ten, have one colour.
struct SeriesStyle {
  ThemeColour colour = ThemeColour::kSeries1;
  Dash dash = Dash::kSolid;
  Marker marker = Marker::kCircle;
};
SeriesStyle series_style(std::size_t i);

/// How many markers there are: those of the first styles, each once.
inline constexpr std::size_t kMarkerCount = 7;

/// How the paired test with the best line, over the runs that both have, judges a mean.
enum class PairedWithBest { kUntested, kBest, kAlike, kWorse };

/// An error over something. All vectors are as long as `x`; NaN: nothing known.
struct ErrorLine {
  std::string label;           ///< In the legend; lines of one label have one style in all panels.
  std::string key;             ///< [a-z0-9-]+, unique in its panel; ids of marks are made of it.
  std::vector<double> x = {};  ///< Ascending.
  std::vector<double> mean = {};  ///< Over runs.
  std::vector<double> low = {};   ///< Of the 95 % interval; empty, with `high`: no band.
  std::vector<double> high = {};
  /// Which style it takes (see series_style), so that a method has one style in all figures. Who
  /// asks for none, or for one that another line of the figure has, gets one that is left.
  std::optional<std::size_t> series = std::nullopt;
  /// Which of the lines of one label in a panel it is, in tips and the alt text; may be empty.
  std::string setting = {};
  std::string end_label = {};  ///< Likewise, beside its last point; may be empty.
  /// At each x, for titles: where the best line is kBest, tests judge and not intervals. Empty:
  /// untested. A test is of the lines' points at one x, or of one point of each.
  std::vector<PairedWithBest> paired = {};
};

/// A point that differs from the lines, such as a published value.
struct ErrorPoint {
  std::string label;  ///< In the legend, shared by all points of one kind.
  std::string line;   ///< The label of the line whose colour it takes.
  double x = 0.0;
  double y = 0.0;
  Marker marker = Marker::kDiamond;
  double size = 2.0;  ///< In units of the theme's marker size.
  std::string setting = {};  ///< That of the line; may be empty.
};

struct ErrorPanel {
  std::string title;
  Axis x;
  std::vector<ErrorLine> lines;
  std::vector<ErrorPoint> points;
};

struct ErrorLinesSpec {
  std::string id;  ///< [a-z][a-z0-9-]*.
  std::string title;
  std::string y_label = "MPE [m]";
  std::string quantity = "mean position error";  ///< In words, for caption and alt text.
  std::vector<ErrorPanel> panels;                ///< Side by side on one y axis.
  std::string caption;   ///< Empty: one is made of `quantity`, `over`, the intervals and `remark`.
  std::string over;      ///< " over the number of anchors"; may be empty.
  bool has_runs = true;  ///< The lines are means over several runs, which the caption then says.
  std::string remark;    ///< Sentences that end the caption, with a space before; may be empty.
  std::string alt;       ///< Empty: one is made of the panels' numbers.
  std::vector<std::string> record_ids;
  std::vector<Note> notes;
  double ceiling = kInfinity;  ///< Means above do not widen the
                               ///< frame; a note counts them.
  double log_from = 20.0;      ///< Greatest over least mean from which the y axis is logarithmic.
  /// Whether values above greatest_error() are of maps that diverged (see diverged.hpp), and pages
  /// say so in words.
  bool great_errors = true;
};

/// The styles that mapproof's own methods have, see method_series(): 0 to this, exclusive.
inline constexpr std::size_t kMethodStyles = 10;

/// So many more styles, each with a colour that neither those taken nor the ones before it have,
/// until all colours are in use; then each colour once more, and so on.
/// @param from  Where the search begins, unless none is taken: then at 0.
std::vector<std::size_t> free_series(const std::vector<std::size_t>& taken, std::size_t count,
                                     std::size_t from);

/// The style of each label: what its line asks for if no label before it did; else one of
/// free_series(), behind those of mapproof's methods if some line asks for one.
std::vector<std::size_t> series_of(const std::vector<std::optional<std::size_t>>& asked);

/// Lines with their 95 % intervals in panels that share the y axis. Intervals are bands, or bars
/// where more than three bands would lie on each other. The axis is logarithmic if the means span
/// more than `log_from`, and then holds the upper ends of intervals as far as these take no more of
/// it than the means do, and the lower ends down to a third of the least mean; notes count those
/// beyond. Else it holds all intervals and is from 0, or from the lowest interval if that reaches
/// below, or if the values would take less than a third of an axis from 0.
/// @throws InvalidInput if a line's vectors disagree in length, or a key is not an id or there
/// twice.
Figure error_lines_figure(const ErrorLinesSpec& spec);

/// The y axis for means and their intervals as error_lines_figure takes it.
struct ErrorAxis {
  Scale scale = Scale::kLinear;
  Range limits;

  /// Values that a log axis cannot show, raised to just below its lower end.
  std::vector<double> raised(std::vector<double> values) const;
};

/// @param intervals  Both ends of the intervals; may be empty.
/// @param points     Other values that the frame holds, as of single runs. One of 0 does not keep
///                   the axis from being logarithmic, and then lies below it.
ErrorAxis error_axis(const std::vector<double>& means, const std::vector<double>& intervals,
                     double log_from = 20.0, const std::vector<double>& points = {});

}  // namespace mapproof
