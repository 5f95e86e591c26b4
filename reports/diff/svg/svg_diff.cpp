#include "reports/diff/svg/svg_diff.hpp"

#include <algorithm>
#include <iterator>
#include <map>
#include <string_view>
#include <utility>

#include <fmt/format.h>

#include "core/base/errors.hpp"
#include "reports/diff/documents/excerpts.hpp"
#include "reports/diff/svg/svg_attributes.hpp"
#include "reports/diff/svg/svg_tree.hpp"

namespace mapproof {
namespace {

constexpr std::size_t kMostChanges = 200;
constexpr std::size_t kMostShown = 120;  // Characters of a value.
constexpr double kStyleNumber = 0.001;
constexpr double kTurn = 1e-4;  // Of a transform's matrix: a tenth of a pixel over 1000.

// Names of attributes, with a blank before and after each.
constexpr std::string_view kGeometry =
    " d points transform x y x1 y1 x2 y2 cx cy r rx ry dx dy width height fx fy viewBox "
    "patternTransform gradientTransform ";
constexpr std::string_view kUnseen =
    " role version baseProfile space lang aria-label aria-labelledby aria-describedby aria-hidden "
    "focusable tabindex ";

bool is_one_of(std::string_view name, std::string_view names) {
  return names.find(" " + std::string(name) + " ") != std::string_view::npos;
}

/// Names and values that nobody sees.
bool is_remark(std::string_view name) {
  return name.starts_with("data-") || name.starts_with("{") || is_one_of(name, kUnseen);
}

bool is_remark_element(const SvgElement& element) {
  const std::string& name = element.name;
  return name.starts_with("{") || name == "metadata" || name == "title" || name == "desc";
}

/// The value of an attribute, or the text, of an element of the baseline in both files.
struct Value {
  int element = 0;
  std::string_view name;
  const std::string &before, &after;
};

class Differ {
 public:
  Differ(const SvgTree& a, const SvgTree& b, const SvgTolerances& tolerances)
      : a_(a),
        b_(b),
        tolerances_(tolerances),
        match_(match_svgs(a, b)),
        units_(svg_units(a)),
        moved_(a.elements.size(), 0.0) {
    mark_remarks(a_, remarks_a_);
    mark_remarks(b_, remarks_b_);
    for (std::size_t i = 0; i < a.elements.size(); ++i)
      if (match_.partner[i] >= 0 && !a.elements[i].id.empty())
        new_id_["#" + a.elements[i].id] = "#" + b.elements[match_.partner[i]].id;
  }

  SvgDiff run() {
    for (int i = 0; i < static_cast<int>(a_.elements.size()); ++i) {
      if (match_.partner[i] >= 0)
        compare(i, match_.partner[i]);
      else if (is_top(a_, match_.partner, i))
        add_structure(a_, i, "removed", remarks_a_[i]);
    }
    for (int j = 0; j < static_cast<int>(b_.elements.size()); ++j)
      if (match_.back[j] < 0 && is_top(b_, match_.back, j))
        add_structure(b_, j, "added", remarks_b_[j]);
    std::ranges::move(tolerated_, std::back_inserter(diff_.changes));
    if (diff_.changes.size() > kMostChanges) diff_.changes.resize(kMostChanges);
    return std::move(diff_);
  }

 private:
  static void mark_remarks(const SvgTree& tree, std::vector<bool>& out) {
    for (const SvgElement& element : tree.elements)
      out.push_back(is_remark_element(element) || (element.parent >= 0 && out[element.parent]));
  }

  /// Whether the parent is matched: what is below something that is gone is gone with it.
  static bool is_top(const SvgTree& tree, const std::vector<int>& partner, int i) {
    const int parent = tree.elements[i].parent;
    return parent < 0 || partner[parent] >= 0;
  }

  void compare(int i, int j) {
    const SvgElement &a = a_.elements[i], &b = b_.elements[j];
    const bool is_remark_here = remarks_a_[i];
    const bool is_elsewhere = a.parent >= 0 && match_.partner[a.parent] != b.parent;
    if ((is_elsewhere || match_.is_reordered[i]) &&
        count_one(SvgChangeKind::kStructure, is_remark_here))
      add({.kind = SvgChangeKind::kStructure,
           .element = a_.path(i),
           .what = "moved",
           .baseline = "",
           .current = b_.path(j),
           .tolerated = is_remark_here});
    const bool is_nudged = nudge(i, a, b);
    if (a.id != b.id) add_value({i, "id", a.id, b.id}, SvgChangeKind::kMetadata, {}, true);
    if (a.text != b.text) compare_text({i, "text", a.text, b.text}, a.name, is_remark_here);
    for_each_difference(
        a, b, [&](std::string_view name, const std::string& before, const std::string& after) {
          compare_value({i, name, before, after}, is_remark_here, is_nudged);
        });
  }

  /// Calls `what` with each name, in their order, that one of both lacks or whose values differ,
  /// and with the values; empty: none.
  template <typename What>
  static void for_each_difference(const SvgElement& a, const SvgElement& b, const What& what) {
    static const std::string none;
    auto one = a.values.begin();
    auto other = b.values.begin();
    while (one != a.values.end() || other != b.values.end()) {
      const bool only_a =
          other == b.values.end() || (one != a.values.end() && one->first < other->first);
      const bool only_b = !only_a && (one == a.values.end() || other->first < one->first);
      if (only_a || only_b || one->second != other->second)
        what(only_b ? other->first : one->first, only_b ? none : one->second,
             only_a ? none : other->second);
      if (!only_b) ++one;
      if (!only_a) ++other;
    }
  }

  void compare_text(const Value& text, std::string_view of_element, bool is_remark_here) {
    if (of_element == "style")
      add_value(text, SvgChangeKind::kStyle, value_distance("", text.before, text.after), false);
    else
      add_value(text, is_remark_here ? SvgChangeKind::kMetadata : SvgChangeKind::kText, {},
                is_remark_here);
  }

  void compare_value(const Value& value, bool is_remark_here, bool is_nudged) {
    // That of the root tells of the whole; below it stands for text drawn as outlines.
    if (value.name == "aria-label" && value.element > 0 && !is_remark_here)
      return add_value(value, SvgChangeKind::kText, {}, false);
    if (is_remark_here || is_remark(value.name))
      return add_value(value, SvgChangeKind::kMetadata, {}, true);
    if (with_new_ids(value.before) == value.after) return;
    const ValueDistance found = value_distance(value.name, value.before, value.after);
    if (found.is_number && found.distance == 0.0) return;
    const SvgChangeKind kind =
        is_one_of(value.name, kGeometry) ? SvgChangeKind::kGeometry : SvgChangeKind::kStyle;
    const bool is_near =
        value.name == "transform" ? is_nudged
        : kind == SvgChangeKind::kGeometry
            ? is_near_enough(value, found)
            : found.distance <= (found.is_colour ? tolerances_.colour : kStyleNumber);
    add_value(value, kind, found, found.is_number && is_near);
  }

  /// Whether the element's transform moves it by so little that nobody sees it, all that its groups
  /// did added; what is moved farther is reported once, and not of all below it.
  bool nudge(int i, const SvgElement& a, const SvgElement& b) {
    if (a.parent >= 0) moved_[i] = moved_[a.parent];
    const auto before = a.values.find("transform"), after = b.values.find("transform");
    const auto distance = transform_distance(before == a.values.end() ? "" : before->second,
                                             after == b.values.end() ? "" : after->second);
    const double moved = distance ? moved_[i] + distance->shift * units_.outer[i] : 0.0;
    const bool is_nudged =
        distance && distance->linear <= kTurn && moved <= tolerances_.distance_px;
    moved_[i] = is_nudged ? moved : 0.0;
    return is_nudged;
  }

  bool is_near_enough(const Value& value, const ValueDistance& found) const {
    double distance = found.distance;
    if (value.name.ends_with("Transform")) {
      const auto apart = transform_distance(value.before, value.after);
      if (!apart || apart->linear > kTurn) return false;
      distance = apart->shift;
    }
    return moved_[value.element] + distance * units_.inner[value.element] <=
           tolerances_.distance_px;
  }

  /// The value with references to elements of the baseline led to what they are now.
  std::string with_new_ids(const std::string& value) const {
    const std::size_t hash = value.find('#');
    if (hash == std::string::npos) return value;
    const std::size_t end = std::min(value.find_first_of(")\"' ", hash), value.size());
    const auto found = new_id_.find(value.substr(hash, end - hash));
    return found == new_id_.end() ? value
                                  : value.substr(0, hash) + found->second + value.substr(end);
  }

  void add_value(const Value& value, SvgChangeKind kind, const ValueDistance& found,
                 bool is_tolerated) {
    if (!count_one(kind, is_tolerated)) return;
    const auto [before, after] = excerpts(value.before, value.after, kMostShown);
    add({.kind = kind,
         .element = a_.path(value.element),
         .what = std::string(value.name),
         .baseline = before,
         .current = after,
         .distance = found.is_number ? found.distance : 0.0,
         .tolerated = is_tolerated});
  }

  void add_structure(const SvgTree& tree, int i, const char* what, bool is_remark_here) {
    const SvgChangeKind kind =
        is_remark_here ? SvgChangeKind::kMetadata : SvgChangeKind::kStructure;
    if (!count_one(kind, is_remark_here)) return;
    const SvgElement& element = tree.elements[i];
    const auto label = element.values.find("aria-label");
    const std::string text =
        printable(label != element.values.end() ? label->second : element.text, kMostShown);
    const bool is_removed = what[0] == 'r';
    add({.kind = kind,
         .element = tree.path(i),
         .what = what,
         .baseline = is_removed ? text : "",
         .current = is_removed ? "" : text,
         .tolerated = is_remark_here});
  }

  /// Counts a change. @return Whether it is to be listed too.
  bool count_one(SvgChangeKind kind, bool is_tolerated) {
    ++diff_.total;
    ++count(kind);
    diff_.tolerated += is_tolerated;
    return (is_tolerated ? tolerated_ : diff_.changes).size() < kMostChanges;
  }

  void add(SvgChange change) {
    change.element = printable(change.element, 400);
    (change.tolerated ? tolerated_ : diff_.changes).push_back(std::move(change));
  }

  std::int64_t& count(SvgChangeKind kind) {
    switch (kind) {
      case SvgChangeKind::kGeometry:
        return diff_.geometry;
      case SvgChangeKind::kStyle:
        return diff_.style;
      case SvgChangeKind::kText:
        return diff_.text;
      case SvgChangeKind::kMetadata:
        return diff_.metadata;
      case SvgChangeKind::kStructure:
        break;
    }
    return diff_.structure;
  }

  const SvgTree &a_, &b_;
  const SvgTolerances& tolerances_;
  SvgMatch match_;
  SvgUnits units_;             ///< Of the baseline.
  std::vector<double> moved_;  ///< Pixels, by transforms that are within tolerance.
  std::vector<bool> remarks_a_, remarks_b_;
  std::map<std::string, std::string> new_id_;
  SvgDiff diff_;
  std::vector<SvgChange> tolerated_;
};

}  // namespace

SvgDiff svg_diff(const SvgTree& baseline, const SvgTree& current, const SvgTolerances& tolerances) {
  if (!(tolerances.distance_px >= 0.0))
    throw InvalidInput("svg_distance is not a number from 0 on");
  if (!(tolerances.colour >= 0.0)) throw InvalidInput("svg_colour is not a number from 0 on");
  return Differ(baseline, current, tolerances).run();
}

}  // namespace mapproof
