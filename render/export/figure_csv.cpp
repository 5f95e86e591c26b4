#include "render/export/figure_csv.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>
#include <vector>

#include "core/base/text/csv.hpp"

namespace mapproof {
namespace {

/// A cell each by its column.
using Cell = std::pair<std::string, std::string>;

/// Rows whose columns are known once all of them are there.
class LongTable {
 public:
  /// Columns in the order of the file; others follow in the order of their first row.
  explicit LongTable(std::vector<std::string> columns) : columns_(std::move(columns)) {}

  void add(std::vector<Cell> row) {
    for (const auto& [column, value] : row) {
      if (value.empty()) continue;
      used_[column] = true;
      if (std::ranges::find(columns_, column) == columns_.end()) columns_.push_back(column);
    }
    rows_.push_back(std::move(row));
  }

  std::string text() const {
    std::vector<std::string> shown;
    for (const std::string& column : columns_)
      if (used_.contains(column)) shown.push_back(column);
    std::string out = line(shown);
    for (const std::vector<Cell>& row : rows_) {
      std::vector<std::string> cells;
      for (const std::string& column : shown) {
        const auto found = std::ranges::find(row, column, &Cell::first);
        cells.push_back(found == row.end() ? "" : csv_field(found->second));
      }
      out += line(cells);
    }
    return out;
  }

 private:
  static std::string line(const std::vector<std::string>& cells) {
    std::string out;
    for (std::size_t i = 0; i < cells.size(); ++i) (out += i == 0 ? "" : ",") += cells[i];
    return out + "\n";
  }

  std::vector<std::string> columns_;
  std::map<std::string, bool> used_;
  std::vector<std::vector<Cell>> rows_;
};

void add_mark(const Mark& mark, std::vector<Cell>& row) {
  for (const auto& [key, value] : mark.data)
    if (std::ranges::find(row, key, &Cell::first) == row.end()) row.emplace_back(key, value);
}

/// The rows of the layers of one figure.
class LayerRows {
 public:
  LayerRows(LongTable& table, std::size_t panel, std::size_t layer)
      : table_(table), panel_(panel), layer_(layer) {}

  void operator()(const Polyline& line) {
    std::vector<Column> shown = {{"x", &line.x}, {"y", &line.y}};
    if (!line.values.empty()) shown.push_back({"value", &line.values});
    columns("line", line.label, line.mark, shown);
  }
  void operator()(const Band& band) {
    columns("band", band.label, band.mark,
            {{"x", &band.x}, {"low", &band.low}, {"high", &band.high}});
  }
  void operator()(const Scatter& points) {
    columns("point", points.label, points.marks, {{"x", &points.x}, {"y", &points.y}});
  }
  void operator()(const Segments& lines) {
    columns(lines.arrow ? "arrow" : "segment", lines.label, lines.marks,
            {{"x", &lines.x0}, {"y", &lines.y0}, {"x_end", &lines.x1}, {"y_end", &lines.y1}});
  }
  void operator()(const PointLabels& labels) { texts("label", labels.x, labels.y, labels.text); }
  void operator()(const Texts& shown) { texts("text", shown.x, shown.y, shown.text); }
  void operator()(const Area& area) {
    columns("outline", area.label, area.mark, {{"x", &area.x}, {"y", &area.y}});
  }
  void operator()(const Ellipses& shapes) {
    columns("ellipse", shapes.label, shapes.marks,
            {{"x", &shapes.x},
             {"y", &shapes.y},
             {"half_axis_a", &shapes.a},
             {"half_axis_b", &shapes.b},
             {"rotation_rad", &shapes.rotation_rad}});
  }
  void operator()(const Cells& cells) {
    const auto middle = [](const Range& range, std::size_t i, std::size_t count) {
      return std::lerp(range.low, range.high,
                       (static_cast<double>(i) + 0.5) / static_cast<double>(count));
    };
    for (std::size_t i = 0; i < cells.values.size(); ++i) {
      std::vector<Cell> row = begin("cell", cells.label, i);
      const std::size_t from_below = cells.rows() - 1 - i / cells.columns;
      row.emplace_back("x", csv_number(middle(cells.x, i % cells.columns, cells.columns)));
      row.emplace_back("y", csv_number(middle(cells.y, from_below, cells.rows())));
      row.emplace_back("value", csv_number(cells.values[i]));
      if (i < cells.text.size()) row.emplace_back("text", cells.text[i]);
      add_mark(cells.mark, row);
      table_.add(std::move(row));
    }
  }
  void operator()(const ImageLayer&) {}  // Pixels are no data.

 private:
  using Column = std::pair<const char*, const std::vector<double>*>;

  std::vector<Cell> begin(const char* kind, const std::string& label, std::size_t i) const {
    return {{"panel", std::to_string(panel_)},
            {"layer", std::to_string(layer_)},
            {"shape", kind},
            {"label", label},
            {"index", std::to_string(i + 1)}};
  }

  /// @param mark  One of the whole layer, or one a row.
  template <typename Marks>
  void columns(const char* kind, const std::string& label, const Marks& mark,
               const std::vector<Column>& all) {
    for (std::size_t i = 0; i < all.front().second->size(); ++i) {
      std::vector<Cell> row = begin(kind, label, i);
      for (const auto& [name, values] : all) row.emplace_back(name, csv_number((*values)[i]));
      if constexpr (requires { mark.data; })
        add_mark(mark, row);
      else if (i < mark.size())
        add_mark(mark[i], row);
      table_.add(std::move(row));
    }
  }

  void texts(const char* kind, const std::vector<double>& x, const std::vector<double>& y,
             const std::vector<std::string>& text) {
    for (std::size_t i = 0; i < text.size(); ++i) {
      std::vector<Cell> row = begin(kind, "", i);
      row.emplace_back("x", csv_number(x[i]));
      row.emplace_back("y", csv_number(y[i]));
      row.emplace_back("text", text[i]);
      table_.add(std::move(row));
    }
  }

  LongTable& table_;
  std::size_t panel_;
  std::size_t layer_;
};

void put_point(const Point3& at, const char* suffix, std::vector<Cell>& row) {
  constexpr const char* kNames[] = {"x", "y", "z"};
  for (int axis = 0; axis < 3; ++axis)
    row.emplace_back(std::string(kNames[axis]) + suffix, csv_number(at(axis)));
}

/// The rows of the parts of a scene.
class PartRows {
 public:
  PartRows(LongTable& table, std::size_t part) : table_(table), part_(part) {}

  void operator()(const Surface& surface) { points("surface", surface, surface.points); }
  void operator()(const Tube& tube) { points("tube", tube, tube.points); }
  void operator()(const Spheres& spheres) { points("sphere", spheres, spheres.at); }
  void operator()(const Field& field) { points("field", field, field.points); }
  void operator()(const Rods& rods) {
    for (std::size_t i = 0; i < rods.from.size(); ++i) {
      std::vector<Cell> row = begin(rods.arrow ? "arrow" : "rod", rods.label, i);
      put_point(rods.from[i], "", row);
      put_point(rods.to[i], "_end", row);
      put_value(rods.tones, i, row);
      table_.add(std::move(row));
    }
  }

 private:
  std::vector<Cell> begin(const char* kind, const std::string& label, std::size_t i) const {
    return {{"part", std::to_string(part_)},
            {"shape", kind},
            {"label", label},
            {"index", std::to_string(i + 1)}};
  }

  static void put_value(const Tones& tones, std::size_t i, std::vector<Cell>& row) {
    if (i < tones.values.size()) row.emplace_back("value", csv_number(tones.values[i]));
  }

  template <typename One>
  void points(const char* kind, const One& one, const std::vector<Point3>& at) {
    for (std::size_t i = 0; i < at.size(); ++i) {
      std::vector<Cell> row = begin(kind, one.label, i);
      put_point(at[i], "", row);
      put_value(one.tones, i, row);
      table_.add(std::move(row));
    }
  }

  LongTable& table_;
  std::size_t part_;
};

}  // namespace

std::string figure_csv(const Figure& figure) {
  LongTable table({"panel", "layer", "shape", "label", "index", "landmark", "x", "y"});
  for (std::size_t p = 0; p < figure.panels.size(); ++p)
    for (std::size_t k = 0; k < figure.panels[p].layers.size(); ++k)
      std::visit(LayerRows(table, p + 1, k + 1), figure.panels[p].layers[k]);
  return table.text();
}

std::string scene_csv(const Scene& scene) {
  LongTable table({"part", "shape", "label", "index", "x", "y", "z"});
  for (std::size_t p = 0; p < scene.parts.size(); ++p)
    std::visit(PartRows(table, p + 1), scene.parts[p]);
  return table.text();
}

}  // namespace mapproof
