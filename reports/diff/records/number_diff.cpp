#include "reports/diff/records/number_diff.hpp"

#include <algorithm>
#include <array>
#include <limits>
#include <map>
#include <string_view>

#include <fmt/format.h>

#include "core/align/rigid.hpp"
#include "core/base/errors.hpp"
#include "core/base/files/byte_source.hpp"
#include "core/base/not_finite.hpp"
#include "core/json/json_document.hpp"
#include "reports/diff/documents/excerpts.hpp"
#include "reports/diff/records/map_transform.hpp"
#include "reports/diff/records/numbers_in_text.hpp"

namespace mapproof {
namespace {

constexpr std::size_t kMostMoves = 20;

/// Whether numbers are equal, NaN at the same indices.
bool equal(const Points& a, const Points& b) {
  if (a.rows() != b.rows()) return false;
  for (Eigen::Index i = 0; i < a.size(); ++i)
    if (a.data()[i] != b.data()[i] && !(std::isnan(a.data()[i]) && std::isnan(b.data()[i])))
      return false;
  return true;
}

bool has_position(const Points& points, Eigen::Index row) { return points.row(row).allFinite(); }

Points rows_of(const Points& points, const std::vector<Eigen::Index>& rows) {
  Points some(static_cast<Eigen::Index>(rows.size()), 2);
  for (std::size_t i = 0; i < rows.size(); ++i)
    some.row(static_cast<Eigen::Index>(i)) = points.row(rows[i]);
  return some;
}

double spread_of(const Points& points) {
  if (points.rows() == 0) return 0.0;
  const Eigen::RowVector2d centre = points.colwise().mean();
  return std::sqrt((points.rowwise() - centre).rowwise().squaredNorm().mean());
}

/// `current` aligned to `baseline`, both in units of the baseline's spread.
void align_to(const Points& baseline, Points& current, const std::vector<Eigen::Index>& rows) {
  if (rows.empty()) return;
  const Points to = rows_of(baseline, rows);
  double least = kInfinity;
  Points best = current;
  for (const double mirror : {1.0, -1.0}) {
    Points turned = current;
    turned.col(1) *= mirror;
    const Points from = rows_of(turned, rows);
    const Similarity map = fit_similarity(from, to, Alignment::kSimilarity);
    const double rest = (map(from) - to).squaredNorm();
    if (rest >= least) continue;
    least = rest;
    best = map(turned);
  }
  current = best;
}

/// Means over the points with a position on both sides and ground truth.
struct Errors {
  double baseline = 0.0, current = 0.0;
  int count = 0;
};

std::string name_of(const AlignedPoints& placed, Eigen::Index row) {
  const auto i = static_cast<std::size_t>(row);
  return i < placed.names.size() ? placed.names[i] : std::to_string(row + 1);
}

PointMove move_of(const AlignedPoints& a, const Points& before, const Points& after,
                  Eigen::Index row) {
  PointMove move{.name = name_of(a, row),
                 .baseline = {before(row, 0), before(row, 1)},
                 .current = {after(row, 0), after(row, 1)},
                 .moved = kInfinity,
                 .baseline_error = std::nullopt,
                 .current_error = std::nullopt};
  if (has_position(before, row) && has_position(after, row))
    move.moved = (before.row(row) - after.row(row)).norm();
  if (a.ground_truth && a.ground_truth->row(row).allFinite()) {
    if (has_position(before, row))
      move.baseline_error = (before.row(row) - a.ground_truth->row(row)).norm();
    if (has_position(after, row))
      move.current_error = (after.row(row) - a.ground_truth->row(row)).norm();
  }
  return move;
}

void note(PointsDiff& diff, Errors& errors, PointMove move, const Tolerance& tolerance,
          double size) {
  const bool before = std::isfinite(move.baseline.x), after = std::isfinite(move.current.x);
  if (!before && !after) return;
  if (before && after) {
    ++diff.points;
    if (move.baseline_error && move.current_error) {
      errors.baseline += *move.baseline_error;
      errors.current += *move.current_error;
      ++errors.count;
    }
    if (move.moved == 0.0) return;
    if (move.moved <= tolerance.absolute + tolerance.relative * size) {
      ++diff.within;
      return;
    }
    ++diff.beyond;
  } else {
    ++(before ? diff.lost : diff.gained);
  }
  diff.moves.push_back(std::move(move));
}

AlignedPoints locations(const Points& points) {
  AlignedPoints placed;
  placed.points = points;
  return placed;
}

void keep_farthest(std::vector<PointMove>& moves) {
  std::ranges::stable_sort(moves, std::ranges::greater(), &PointMove::moved);
  if (moves.size() > kMostMoves) moves.resize(kMostMoves);
}

constexpr std::size_t kMostNumberText = 60;  // Characters of a value in a message.

/// The quantities of keys that do not have the name of a quantity.
struct KeyQuantity {
  std::string_view key, quantity;
};
constexpr std::array kKeys = {KeyQuantity{"estimate", "landmark_m"},
                              KeyQuantity{"ground_truth_m", "landmark_m"},
                              KeyQuantity{"true_landmarks_m", "landmark_m"},
                              KeyQuantity{"landmarks_m", "landmark_m"},
                              KeyQuantity{"path", "path_m"},
                              KeyQuantity{"ground_truth", "path_m"},
                              KeyQuantity{"error_m", "path_m"},
                              KeyQuantity{"positions_m", "path_m"}};

std::string text_in(const JsonCursor& value) {
  return value.text(std::numeric_limits<std::size_t>::max());
}

std::string shown(const JsonCursor& value) {
  if (value.kind() == JsonKind::kString) return printable(text_in(value), kMostNumberText);
  if (value.is_array() || value.is_object())
    return fmt::format("{} of {}", value.is_array() ? "an array" : "an object", value.size());
  return printable(std::string(value.token()), kMostNumberText);
}

double value_in(const JsonCursor& value) { return value.number(-kInfinity, kInfinity); }

double largest(const JsonCursor& value) {
  if (value.kind() == JsonKind::kNumber) return std::abs(value_in(value));
  double most = 0.0;
  if (value.is_array())
    for (const JsonCursor& item : value.elements()) most = std::max(most, largest(item));
  return most;
}

class NumberComparer {
 public:
  NumberComparer(const Tolerances& tolerances, OtherDiff& diff)
      : tolerances_(tolerances), diff_(diff) {}

  void compare(const JsonCursor& a, const JsonCursor& b, const std::string& pointer,
               const Tolerance& tolerance) {
    if (a.kind() != b.kind()) return beyond(a, b, pointer, true);
    switch (a.kind()) {
      case JsonKind::kNumber:
        return number(a, b, pointer, tolerance);
      case JsonKind::kString:
        return text(text_in(a), text_in(b), pointer, tolerance);
      case JsonKind::kArray:
        return array(a, b, pointer, tolerance);
      case JsonKind::kObject:
        return object(a, b, pointer, tolerance);
      default:
        if (a.token() != b.token()) beyond(a, b, pointer, true);
    }
  }

  void lines(std::string_view a, std::string_view b, const Tolerance& tolerance) {
    for (int line = 1; !a.empty() || !b.empty(); ++line) {
      std::string first = take_line(a), second = take_line(b);
      // Ends of lines that both files have are no part of what is shown.
      if (first.ends_with('\r') && second.ends_with('\r')) first.pop_back(), second.pop_back();
      text(first, second, fmt::format("line {}", line), tolerance);
    }
  }

 private:
  /// Notes a difference. @param a, b  As they are shown if it is the first.
  void beyond(std::string a, std::string b, const std::string& location, bool shape) {
    if (diff_.first.empty()) {
      diff_.first = location.empty() ? "/" : location;
      diff_.baseline = std::move(a);
      diff_.current = std::move(b);
    }
    diff_.shape |= shape;
    if (!shape) ++diff_.beyond;
  }

  void beyond(const JsonCursor& a, const JsonCursor& b, const std::string& location, bool shape) {
    beyond(shown(a), shown(b), location, shape);
  }

  void number(const JsonCursor& a, const JsonCursor& b, const std::string& location,
              const Tolerance& tolerance) {
    ++diff_.numbers;
    const double first = value_in(a), second = value_in(b);
    if (first == second) return;
    if (tolerance.holds(first, second))
      ++diff_.within;
    else
      beyond(a, b, location, false);
  }

  void text(const std::string& a, const std::string& b, const std::string& location,
            const Tolerance& tolerance) {
    const TextChange change = text_change(a, b, tolerance);
    if (change == TextChange::kWithin) ++diff_.within;
    if (change <= TextChange::kWithin) return;
    const auto [before, after] = excerpts(a, b, kMostNumberText);
    beyond(before, after, location, change == TextChange::kWords);
  }

  void array(const JsonCursor& a, const JsonCursor& b, const std::string& pointer,
             Tolerance tolerance) {
    if (a.size() != b.size()) return beyond(a, b, pointer, true);
    tolerance.absolute += tolerance.relative * largest(a);
    auto other = b.elements().begin();
    std::size_t i = 0;
    for (const JsonCursor& item : a.elements()) {
      compare(item, *other, fmt::format("{}/{}", pointer, i++), tolerance);
      ++other;
    }
  }

  void object(const JsonCursor& a, const JsonCursor& b, const std::string& pointer,
              const Tolerance& tolerance) {
    const auto frame = a.find("frame");
    const bool is_shape = frame && frame->token() == R"("similarity")";
    for (const auto& [key, value] : a.members()) {
      const std::string location = fmt::format("{}/{}", pointer, key);
      const auto other = b.find(key);
      if (!other)
        beyond(shown(value), "missing", location, true);
      else if (!is_shape || key != "estimate")
        compare(value, *other, location, tolerance_at(key, value, tolerance));
    }
    for (const auto& [key, value] : b.members())
      if (!a.find(key)) beyond("missing", shown(value), fmt::format("{}/{}", pointer, key), true);
  }

  Tolerance tolerance_at(const std::string& key, const JsonCursor& value,
                         const Tolerance& outer) const {
    if (value.is_array() || value.is_object())  // Scores have numbers with the same names.
      for (const KeyQuantity& known : kKeys)
        if (known.key == key) return tolerance_of(known_quantity(known.quantity), tolerances_);
    const Quantity* facts = find_quantity(key);
    return facts == nullptr ? outer : tolerance_of(*facts, tolerances_);
  }

  static std::string take_line(std::string_view& text) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    const std::string line(text.substr(0, end));
    text.remove_prefix(std::min(end + 1, text.size()));
    return line;
  }

  const Tolerances& tolerances_;
  OtherDiff& diff_;
};

}  // namespace

bool same_positions(const AlignedPoints& a, const AlignedPoints& b, const Tolerances& tolerances) {
  if (a.points.rows() != b.points.rows()) return false;
  const std::optional<PointsDiff> diff = points_diff("", a, b, tolerances);
  return !diff || diff->beyond + diff->lost + diff->gained == 0;
}

namespace {

/// The points in the order of the other side's names, if both have the same ones.
AlignedPoints in_order_of(const std::vector<std::string>& names, AlignedPoints points) {
  if (names.size() != points.names.size() || names == points.names) return points;
  std::map<std::string_view, Eigen::Index> rows;
  for (std::size_t i = 0; i < points.names.size(); ++i)
    rows.emplace(points.names[i], static_cast<Eigen::Index>(i));
  std::vector<Eigen::Index> order;
  for (const std::string& name : names)
    if (const auto row = rows.find(name); row != rows.end()) order.push_back(row->second);
  if (order.size() != points.names.size() || rows.size() != order.size()) return points;
  points.points = rows_of(points.points, order);
  if (points.ground_truth) points.ground_truth = rows_of(*points.ground_truth, order);
  points.names = names;
  return points;
}

/// The true position that differs most.
std::optional<PointMove> moved_ground_truth(const AlignedPoints& a, const AlignedPoints& b,
                                            const Tolerances& tolerances) {
  if (!a.ground_truth || !b.ground_truth || a.names != b.names ||
      a.ground_truth->rows() != b.ground_truth->rows())
    return std::nullopt;
  AlignedPoints before = locations(*a.ground_truth);
  before.names = a.names;
  AlignedPoints after = locations(*b.ground_truth);
  after.names = a.names;
  const auto diff = points_diff("", before, after, tolerances);
  return diff && !diff->moves.empty() ? std::optional(diff->moves.front()) : std::nullopt;
}

/// Notes names that differ at equal positions.
/// @return Whether all that differ are such.
bool note_renamed(const AlignedPoints& a, const AlignedPoints& b, PointsDiff& diff) {
  if (a.names.size() != b.names.size() || a.points.rows() != b.points.rows()) return false;
  for (std::size_t i = 0; i < a.names.size(); ++i) {
    if (a.names[i] == b.names[i]) continue;
    const auto row = static_cast<Eigen::Index>(i);
    if (!equal(a.points.row(row), b.points.row(row))) return false;
    diff.renamed.push_back(fmt::format("{} \u2192 {}", a.names[i], b.names[i]));
  }
  return true;
}

}  // namespace

std::optional<PointsDiff> points_diff(const std::string& record, const AlignedPoints& a,
                                      const AlignedPoints& other, const Tolerances& tolerances) {
  const AlignedPoints b = in_order_of(a.names, other);
  if (a.names == b.names && a.quantity == b.quantity && equal(a.points, b.points) &&
      a.ground_truth.has_value() == b.ground_truth.has_value() &&
      (!a.ground_truth || equal(*a.ground_truth, *b.ground_truth)))
    return std::nullopt;
  PointsDiff diff;
  diff.record = record;
  diff.quantity = a.quantity;
  const bool same_ground_truth =
      a.ground_truth.has_value() == b.ground_truth.has_value() &&
      (!a.ground_truth ||
       same_positions(locations(*a.ground_truth), locations(*b.ground_truth), tolerances));
  if (!note_renamed(a, b, diff) || a.quantity != b.quantity || a.points.rows() != b.points.rows() ||
      !same_ground_truth) {
    diff.ground_truth_differs = true;
    diff.moved_ground_truth = moved_ground_truth(a, b, tolerances);
    return diff;
  }
  Points before = a.points, after = b.points;
  std::vector<Eigen::Index> both;
  for (Eigen::Index row = 0; row < before.rows(); ++row)
    if (has_position(before, row) && has_position(after, row)) both.push_back(row);
  const bool is_shape = a.frame == Frame::kSimilarity;
  if (a.is_free && b.is_free && both.size() >= 3 && !equal(before, after))
    after = fit_similarity(rows_of(after, both), rows_of(before, both),
                           Alignment::kRigidWithReflection)(after);
  if (is_shape && !equal(before, after)) {
    align_to(before, after, both);
    const double spread = spread_of(rows_of(before, both));
    if (spread > 0.0) {
      before /= spread;
      after /= spread;
    }
  }
  const Tolerance tolerance = tolerance_of(known_quantity(a.quantity), tolerances);
  const double size = both.empty() ? 0.0 : rows_of(before, both).cwiseAbs().maxCoeff();
  Errors errors;
  for (Eigen::Index row = 0; row < before.rows(); ++row)
    note(diff, errors, move_of(a, before, after, row), tolerance, size);
  if (errors.count > 0 && !is_shape) {
    diff.baseline_error = errors.baseline / errors.count;
    diff.current_error = errors.current / errors.count;
  }
  keep_farthest(diff.moves);
  if (diff.beyond > 2 && a.quantity != "path_m")
    if (const auto transform = map_transform(before, after))
      diff.transform = transform_text(*transform, "landmark", is_shape ? "" : "m");
  return diff;
}

OtherDiff number_diff(const std::string& name, const std::filesystem::path& baseline,
                      const std::filesystem::path& current, const Tolerances& tolerances) {
  OtherDiff diff;
  diff.file = name;
  NumberComparer comparer(tolerances, diff);
  const Tolerance tolerance = tolerance_of_others(tolerances);
  const std::string before = read_input(baseline), after = read_input(current);
  if (name.empty() || baseline.extension() == ".json")
    comparer.compare(parse_json(before, baseline.string()).cursor(),
                     parse_json(after, current.string()).cursor(), "", tolerance);
  else
    comparer.lines(before, after, tolerance_of(known_quantity("path_m"), tolerances));
  return diff;
}

}  // namespace mapproof
