#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "render/theme/theme_colour.hpp"

namespace mapproof {

/// The colour of the i-th curve of a figure, counted from 0; repeats after kSeriesCount.
ThemeColour series_colour(std::size_t i);

enum class Dash { kSolid, kDashed, kDotted, kDashDot, kLongDash };

/// What an outline holds.
enum class Fill {
  kNone,
  kTint,   ///< A little of the colour; what is below shows through.
  kSolid,  ///< The colour.
  kPaper,  ///< The background: hides what is below.
};

/// The colours of a field, from its least to its greatest value.
enum class Ramp {
  kColour,   ///< From the background to the colour.
  kViridis,  ///< From dark to light.
};

/// Where a text stands at its point; in height always about its middle.
enum class Align { kStart, kMiddle, kEnd };

enum class Marker { kNone, kCircle, kSquare, kTriangle, kDiamond, kTriangleDown, kCross, kPlus };

struct Range {
  double low = 0.0;
  double high = 1.0;

  bool operator==(const Range&) const = default;
};

enum class Scale { kLinear, kLog };

/// How a layer's values become colours, and the bar that explains them.
struct ColourScale {
  Range limits = {};  ///< The values at the ends of the ramp; beyond: the ends.
  Ramp ramp = Ramp::kColour;
  Scale scale = Scale::kLinear;  ///< Of the values along the ramp.
  std::string bar_label = {};    ///< With its unit: of a colour bar beside the frame, if any.

  bool operator==(const ColourScale&) const = default;
};

/// Who a mark is: its id within the figure and what a reader of the SVG can ask of it.
struct Mark {
  std::string id;  ///< [a-z0-9-]+, unique in the figure; empty: the mark has none.
  std::vector<std::pair<std::string, std::string>> data;  ///< data-NAME: NAME is [a-z0-9-]+.

  bool operator==(const Mark&) const = default;
};

/// A line through points; a NaN breaks it. With values it is solid and without markers, and each
/// piece has the colour of the greater value of its ends; pieces of greater values cover others.
struct Polyline {
  std::string label = {};  ///< In the legend; empty: not there.
  std::vector<double> x = {};
  std::vector<double> y = {};
  ThemeColour colour = ThemeColour::kSeries1;
  Dash dash = Dash::kSolid;
  double width = 1.0;  ///< In units of the theme's line width.
  Marker marker = Marker::kNone;
  Mark mark = {};
  std::vector<double> values = {};  ///< As many as points, or none; NaN: as a missing point.
  ColourScale colour_scale = {};    ///< Of the values.

  bool operator==(const Polyline&) const = default;
};

/// The area between two curves; a NaN in either breaks it.
struct Band {
  std::string label = {};
  std::vector<double> x = {};
  std::vector<double> low = {};
  std::vector<double> high = {};
  ThemeColour colour = ThemeColour::kSeries1;
  Mark mark = {};

  bool operator==(const Band&) const = default;
};

/// A marker a point; NaN points are not drawn.
struct Scatter {
  std::string label = {};
  std::vector<double> x = {};
  std::vector<double> y = {};
  ThemeColour colour = ThemeColour::kSeries1;
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
  ThemeColour colour = ThemeColour::kMuted;
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
  ThemeColour colour = ThemeColour::kText;

  bool operator==(const PointLabels&) const = default;
};

/// Closed outlines; a NaN ends one and begins the next.
struct Area {
  std::string label = {};
  std::vector<double> x = {};
  std::vector<double> y = {};
  ThemeColour colour = ThemeColour::kMuted;
  Fill fill = Fill::kTint;
  bool outlined = false;
  Dash dash = Dash::kSolid;
  double width = 1.0;
  Mark mark = {};

  bool operator==(const Area&) const = default;
};

/// Ellipses and discs in the units of linear axes, outlined; those with a NaN are not drawn.
struct Ellipses {
  std::string label = {};
  std::vector<double> x = {};  ///< Of the centres.
  std::vector<double> y = {};
  std::vector<double> a = {};             ///< Half axes, >= 0.
  std::vector<double> b = {};             ///< As many; the same as `a` for discs.
  std::vector<double> rotation_rad = {};  ///< Of `a` from the x axis, counter-clockwise.
  ThemeColour colour = ThemeColour::kSeries1;
  Fill fill = Fill::kNone;
  Dash dash = Dash::kSolid;
  double width = 1.0;
  std::vector<Mark> marks = {};

  bool operator==(const Ellipses&) const = default;
};

/// A matrix of coloured cells on linear axes; NaN cells stay empty.
struct Cells {
  std::string label = {};
  Range x = {};  ///< From the left edge of the first column to the right edge of the last.
  Range y = {};  ///< From the lower edge of the last row to the upper edge of the first.
  std::size_t columns = 0;
  std::vector<double> values = {};  ///< Row by row, the uppermost row first.
  ColourScale colour_scale = {};
  ThemeColour colour = ThemeColour::kText;  ///< For Ramp::kColour.
  Mark mark = {};
  std::vector<std::string> text = {};  ///< As many as values, or none: drawn if all of them fit.

  std::size_t rows() const { return columns == 0 ? 0 : values.size() / columns; }
  bool operator==(const Cells&) const = default;
};

/// Texts exactly at points; the frame leaves room for those that reach over its sides.
struct Texts {
  std::vector<double> x = {};
  std::vector<double> y = {};
  std::vector<std::string> text = {};
  Align align = Align::kMiddle;
  ThemeColour colour = ThemeColour::kText;

  bool operator==(const Texts&) const = default;
};

/// The position of a raster image, and what in it labels must not cover.
struct ImageLayer {
  Range x = {};
  Range y = {};
  std::size_t source = 0;             ///< Index of the image, for the painter.
  std::vector<double> clear_x = {};   ///< Middles of squares that stay free of labels.
  std::vector<double> clear_y = {};   ///< As many.
  std::vector<double> clear_by = {};  ///< As many: half their sides, >= 0.

  bool operator==(const ImageLayer&) const = default;
};

using Layer = std::variant<Band, Segments, Polyline, Scatter, PointLabels, Area, Ellipses, Cells,
                           Texts, ImageLayer>;

struct Axis {
  std::string label = {};  ///< With its unit: "MPE [m]".
  Scale scale = Scale::kLinear;
  std::optional<Range> limits = {};     ///< Empty: what the layers need, and a little more.
  bool whole = false;                   ///< Linear: ticks at whole numbers alone.
  std::vector<std::string> names = {};  ///< Linear: of the numbers 0, 1, ..., instead of them.

  bool operator==(const Axis&) const = default;
};

/// One pair of axes and what is drawn in it, the first layer lowest.
struct Panel {
  std::string title;  ///< May hold line feeds; long lines are wrapped.
  Axis x, y;
  bool equal_aspect = false;  ///< One unit of x is as long as one unit of y.
  bool bare = false;          ///< No frame, grid, ticks or axis labels.
  std::vector<Layer> layers;

  bool operator==(const Panel&) const = default;
};

/// A line of text under the title.
struct Note {
  std::string text;
  ThemeColour colour = ThemeColour::kText;

  bool operator==(const Note&) const = default;
};

/// An arrow from a panel to the next one.
struct PanelArrow {
  std::size_t from = 0;
  std::string label;

  bool operator==(const PanelArrow&) const = default;
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
  std::vector<Panel> panels;  ///< At least one, row by row.
  std::size_t columns = 0;  ///< Most panels in a row, fewer where they would be too narrow; 0: all.
  bool shared_x = false;    ///< One x axis for all: the same limits, labels below the grid alone.
  bool shared_y = false;    ///< One y axis likewise. Panels that share an axis share a legend.
  std::vector<PanelArrow> arrows = {};

  bool operator==(const Figure&) const = default;
};

/// Whether a figure may have that id.
bool is_figure_id(std::string_view id);

/// Puts `prefix` before the ids of all marks, so that panels of one figure have none in common.
void prefix_mark_ids(Panel& panel, const std::string& prefix);

/// What a layer is called in the legend; empty: it is not there, as no layer without labels is.
const std::string& label_of(const Layer& layer);

/// Nothing happens to a layer without labels. @param label  Empty: it leaves the legend.
void set_label(Layer& layer, const std::string& label);

/// Whether the layer has nothing to draw.
bool is_empty(const Layer& layer);

/// What keeps the figure from being drawn, as one line that names the location; empty if nothing
/// does: ids, sizes that do not match, limits that are not range, values <= 0 on a log axis.
std::string problem(const Figure& figure);

/// @throws InvalidInput with `problem(figure)` if there is one.
void require_valid(const Figure& figure);

}  // namespace mapproof
