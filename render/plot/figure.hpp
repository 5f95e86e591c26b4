#pragma once

#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "render/theme/ink.hpp"

namespace mapproof {

/// The ink of the i-th curve of a figure, counted from 0; repeats after seven.
Ink series_ink(std::size_t i);

enum class Dash { kSolid, kDashed, kDotted, kDashDot, kLongDash };

enum class Marker { kNone, kCircle, kSquare, kTriangle, kDiamond, kTriangleDown, kCross, kPlus };

/// Who a mark is: its id within the figure and what a reader of the SVG can ask of it.
struct Mark {
  std::string id;  ///< [a-z0-9-]+, unique in the figure; empty: the mark has none.
  std::vector<std::pair<std::string, std::string>> data;  ///< data-NAME: NAME is [a-z0-9-]+.

  bool operator==(const Mark&) const = default;
};

/// A line through points; a NaN breaks it.
struct Polyline {
  std::string label = {};  ///< In the legend; empty: not there.
  std::vector<double> x = {};
  std::vector<double> y = {};
  Ink ink = Ink::kSeries1;
  Dash dash = Dash::kSolid;
  double width = 1.0;  ///< In units of the theme's line width.
  Marker marker = Marker::kNone;
  Mark mark = {};

  bool operator==(const Polyline&) const = default;
};

/// The area between two curves; a NaN in either breaks it.
struct Band {
  std::string label = {};
  std::vector<double> x = {};
  std::vector<double> low = {};
  std::vector<double> high = {};
  Ink ink = Ink::kSeries1;
  Mark mark = {};

  bool operator==(const Band&) const = default;
};

/// A marker a point; NaN points are not drawn.
struct Scatter {
  std::string label = {};
  std::vector<double> x = {};
  std::vector<double> y = {};
  Ink ink = Ink::kSeries1;
  Marker marker = Marker::kCircle;
  bool filled = true;
  double size = 1.0;             ///< In units of the theme's marker size.
  std::vector<Mark> marks = {};  ///< As many as points, or none.

  bool operator==(const Scatter&) const = default;
};

/// Straight lines from (x0, y0) to (x1, y1); those with a NaN are not drawn.
struct Segments {
  std::string label = {};
  std::vector<double> x0 = {};
  std::vector<double> y0 = {};
  std::vector<double> x1 = {};
  std::vector<double> y1 = {};
  Ink ink = Ink::kMuted;
  Dash dash = Dash::kSolid;
  double width = 1.0;
  bool arrow = false;  ///< With a head at (x1, y1).
  std::vector<Mark> marks = {};

  bool operator==(const Segments&) const = default;
};

/// Texts beside points, placed where they cover nothing; one that fits nowhere is left out.
struct PointLabels {
  std::vector<double> x = {};
  std::vector<double> y = {};
  std::vector<std::string> text = {};
  Ink ink = Ink::kText;

  bool operator==(const PointLabels&) const = default;
};

using Layer = std::variant<Band, Segments, Polyline, Scatter, PointLabels>;

enum class Scale { kLinear, kLog };

struct Range {
  double low = 0.0;
  double high = 1.0;

  bool operator==(const Range&) const = default;
};

struct Axis {
  std::string label = {};  ///< With its unit: "MPE [m]".
  Scale scale = Scale::kLinear;
  std::optional<Range> limits = {};  ///< Empty: what the layers need, and a little more.

  bool operator==(const Axis&) const = default;
};

/// One pair of axes and what is drawn in it, the first layer lowest.
struct Panel {
  std::string title;
  Axis x, y;
  bool equal_aspect = false;  ///< One unit of x is as long as one unit of y.
  std::vector<Layer> layers;

  bool operator==(const Panel&) const = default;
};

/// A line of text under the title.
struct Note {
  std::string text;
  Ink ink = Ink::kText;

  bool operator==(const Note&) const = default;
};

/// A figure as a value: the same for every back end, size and theme.
struct Figure {
  std::string id;  ///< [a-z][a-z0-9-]*, at most 120 characters; never taken from data.
  std::string title;
  std::string caption;
  std::string alt;                      ///< What the figure shows, in words with numbers.
  std::vector<std::string> record_ids;  ///< The records it was made from.
  bool varies = false;                  ///< Shows what differs from run to run, such as seconds.
  std::vector<Note> notes;
  std::vector<Panel> panels;  ///< At least one, side by side.

  bool operator==(const Figure&) const = default;
};

/// What keeps the figure from being drawn, as one line that names the place; empty if nothing does:
/// ids, sizes that do not match, limits that are no range, values <= 0 on a log axis.
std::string problem(const Figure& figure);

/// @throws InvalidInput with `problem(figure)` if there is one.
void require_valid(const Figure& figure);

}  // namespace mapproof
