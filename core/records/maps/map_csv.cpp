#include "core/records/maps/map_csv.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <set>

#include <fmt/format.h>

#include "core/base/errors.hpp"
#include "core/base/not_finite.hpp"
#include "core/base/text/retired_names.hpp"
#include "core/json/text_input.hpp"
#include "core/records/tables/table_reader.hpp"

namespace mapproof {
namespace {

constexpr std::array<std::string_view, 14> kMapColumns = {"name",        "x_m",
                                                          "y_m",         "x",
                                                          "y",           "true_x_m",
                                                          "true_y_m",    "error_m",
                                                          "anchor",      "ellipse_a_m",
                                                          "ellipse_b_m", "ellipse_a",
                                                          "ellipse_b",   "ellipse_rotation_deg"};

class MapReader {
 public:
  MapReader(std::string_view text, const std::string& source)
      : source_(source), table_(text, source) {}

  MapRecord read() {
    if (!table_.next(row_)) throw IoError(source_, "has no header");
    read_header();
    while (table_.next(row_)) read_row();
    if (names_.empty()) throw IoError(source_, "has no landmark");
    return map();
  }

 private:
  [[noreturn]] void fail(const std::string& what) const {
    throw IoError(source_, fmt::format("line {}", row_.line), what);
  }

  void read_header() {
    for (const std::string_view cell : row_.cells) {
      if (const std::string_view now = replacement_of(NameKind::kColumn, cell); !now.empty())
        fail(fmt::format("the column {} is now called {}", in_quotes(cell), in_quotes(now)));
      if (std::ranges::find(kMapColumns, cell) == kMapColumns.end())
        fail("unknown column " + in_quotes(cell));
      if (std::ranges::find(columns_, cell) != columns_.end())
        fail(fmt::format("column {} is there twice", in_quotes(cell)));
      columns_.emplace_back(cell);
    }
    is_metric_ = has("x_m");
    for (const char* needed : {"name", is_metric_ ? "x_m" : "x", is_metric_ ? "y_m" : "y"})
      if (!has(needed)) fail(fmt::format("the column \"{}\" is missing", needed));
    if (has("true_x_m") != has("true_y_m")) fail("true_x_m and true_y_m need each other");
  }

  bool has(std::string_view column) const {
    return std::ranges::find(columns_, column) != columns_.end();
  }

  std::string_view cell(std::string_view column) const {
    return row_
        .cells[static_cast<std::size_t>(std::ranges::find(columns_, column) - columns_.begin())];
  }

  double number(std::string_view column) const {
    const std::string_view text = cell(column);
    if (is_missing(text)) return kNaN;
    const std::optional<double> value = number_in(text);
    if (!value || !std::isfinite(*value)) fail(fmt::format("{}: {}", column, number_problem(text)));
    return *value;
  }

  /// Two coordinates, both known or both not.
  std::array<double, 2> pair(std::string_view x, std::string_view y) const {
    const std::array<double, 2> point = {number(x), number(y)};
    const bool has_x = !std::isnan(point[0]), has_y = !std::isnan(point[1]);
    if (has_x != has_y)
      fail(fmt::format("{} has {} and no {}", in_quotes(cell("name")), has_x ? x : y,
                       has_x ? y : x));
    return point;
  }

  void read_row() {
    if (row_.cells.size() != columns_.size())
      fail(fmt::format("has {} cells, expected {}", row_.cells.size(), columns_.size()));
    const std::string name(cell("name"));
    if (name.empty()) fail("the name is missing");
    if (!known_.insert(name).second)
      fail(fmt::format("the name {} is there twice", in_quotes(name)));
    if (has("anchor") && cell("anchor") == "1")
      anchors_.push_back(static_cast<Eigen::Index>(names_.size()));
    names_.push_back(name);
    positions_.push_back(pair(is_metric_ ? "x_m" : "x", is_metric_ ? "y_m" : "y"));
    if (has("true_x_m")) ground_truth_.push_back(pair("true_x_m", "true_y_m"));
  }

  static Points points_of(const std::vector<std::array<double, 2>>& rows) {
    Points points(std::ssize(rows), 2);
    for (Eigen::Index i = 0; i < points.rows(); ++i)
      points.row(i) << rows[static_cast<std::size_t>(i)][0], rows[static_cast<std::size_t>(i)][1];
    return points;
  }

  MapRecord map() const {
    MapRecord map;
    map.frame = is_metric_ ? Frame::kGroundTruth : Frame::kSimilarity;
    map.names = names_;
    map.estimate = points_of(positions_);
    map.anchors = anchors_;
    if (!ground_truth_.empty()) map.ground_truth_m = points_of(ground_truth_);
    return map;
  }

  const std::string& source_;
  TableReader table_;
  TableRow row_;
  std::vector<std::string> columns_, names_;
  std::set<std::string> known_;
  std::vector<std::array<double, 2>> positions_, ground_truth_;
  std::vector<Eigen::Index> anchors_;
  bool is_metric_ = true;
};

}  // namespace

MapRecord parse_map_csv(std::string_view text, const std::string& source) {
  return MapReader(text, source).read();
}

}  // namespace mapproof
