#include "reports/diff/svg/svg_diff.hpp"

#include <algorithm>
#include <map>
#include <set>

#include <fmt/format.h>

#include "core/base/errors.hpp"
#include "reports/diff/diff_settings.hpp"
#include "reports/diff/documents/excerpts.hpp"
#include "reports/diff/svg/svg_match.hpp"
#include "reports/diff/svg/svg_units.hpp"
#include "reports/diff/svg/svg_values.hpp"

namespace mapproof {
namespace {

constexpr std::size_t kMostChanges = 200;
constexpr std::size_t kMostShown = 120;  // Characters of a value.
constexpr double kStyleNumber = 0.001;
constexpr double kTurn = 1e-4;  // Of a transform's matrix: a tenth of a pixel over 1000.

bool is_one_of(const std::string& name, const std::set<std::string_view>& names) {
  return names.contains(name);
}

bool is_geometry(const std::string& name) {
  return is_one_of(name, {"d",
                          "points",
                          "transform",
                          "x",
                          "y",
                          "x1",
                          "y1",
                          "x2",
                          "y2",
                          "cx",
                          "cy",
                          "r",
                          "rx",
                          "ry",
                          "dx",
                          "dy",
                          "width",
                          "height",
                          "fx",
                          "fy",
                          "viewBox",
                          "patternTransform",
                          "gradientTransform"});
}

/// Names and values that nobody sees.
bool is_remark(const std::string& name) {
  return name == "aria-label" || name.starts_with("data-") || name.starts_with("{") ||
         name == "role" ||
         is_one_of(name, {"version", "baseProfile", "space", "lang", "aria-labelledby",
                          "aria-describedby", "aria-hidden", "focusable", "tabindex"});
}

bool is_remark_element(const SvgElement& element) {
  return element.name.starts_with("{") || is_one_of(element.name, {"metadata", "title", "desc"});
}

class Differ {
 public:
  Differ(const SvgTree& a, const SvgTree& b, const PictureOptions& options)
      : a_(a),
        b_(b),
        options_(options),
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
    if (a.id != b.id) add_value(i, "id", a.id, b.id, SvgChangeKind::kMetadata, {}, true);
    if (a.text != b.text) compare_text(i, a, b, is_remark_here);
    auto one = a.values.begin();
    auto other = b.values.begin();
    static const std::string none;
    while (one != a.values.end() || other != b.values.end()) {
      const bool only_a =
          other == b.values.end() || (one != a.values.end() && one->first < other->first);
      const bool only_b = !only_a && (one == a.values.end() || other->first < one->first);
      const std::string& name = only_b ? other->first : one->first;
      if (only_a || only_b || one->second != other->second)
        compare_value(i, name, only_b ? none : one->second, only_a ? none : other->second,
                      is_remark_here, is_nudged);
      if (!only_b) ++one;
      if (!only_a) ++other;
    }
  }

  void compare_text(int i, const SvgElement& a, const SvgElement& b, bool is_remark_here) {
    if (a.name == "style")
      add_value(i, "text", a.text, b.text, SvgChangeKind::kStyle,
                value_distance("", a.text, b.text), false);
    else
      add_value(i, "text", a.text, b.text,
                is_remark_here ? SvgChangeKind::kMetadata : SvgChangeKind::kText, {},
                is_remark_here);
  }

  void compare_value(int i, const std::string& name, const std::string& before,
                     const std::string& after, bool is_remark_here, bool is_nudged) {
    // That of the root tells of the whole; below it stands for text drawn as outlines.
    if (name == "aria-label" && i > 0 && !is_remark_here)
      return add_value(i, name, before, after, SvgChangeKind::kText, {}, false);
    if (is_remark_here || is_remark(name))
      return add_value(i, name, before, after, SvgChangeKind::kMetadata, {}, true);
    if (with_new_ids(before) == after) return;
    const ValueDistance found = value_distance(name, before, after);
    if (found.is_number && found.distance == 0.0) return;
    const SvgChangeKind kind = is_geometry(name) ? SvgChangeKind::kGeometry : SvgChangeKind::kStyle;
    const bool is_near =
        name == "transform" ? is_nudged
        : kind == SvgChangeKind::kGeometry
            ? is_near_enough(i, name, before, after, found)
            : found.distance <= (found.is_colour ? options_.svg_colour : kStyleNumber);
    add_value(i, name, before, after, kind, found, found.is_number && is_near);
  }

  /// Whether the element's transform moves it by so little that nobody sees it, all that its groups
  /// did added; what is moved farther is told once, and not of all below it.
  bool nudge(int i, const SvgElement& a, const SvgElement& b) {
    if (a.parent >= 0) moved_[i] = moved_[a.parent];
    const auto before = a.values.find("transform"), after = b.values.find("transform");
    const auto distance = transform_distance(before == a.values.end() ? "" : before->second,
                                             after == b.values.end() ? "" : after->second);
    const double moved = distance ? moved_[i] + distance->shift * units_.outer[i] : 0.0;
    const bool is_nudged = distance && distance->linear <= kTurn && moved <= options_.svg_distance;
    moved_[i] = is_nudged ? moved : 0.0;
    return is_nudged;
  }

  bool is_near_enough(int i, const std::string& name, const std::string& before,
                      const std::string& after, const ValueDistance& found) const {
    double distance = found.distance;
    if (name.ends_with("Transform")) {
      const auto apart = transform_distance(before, after);
      if (!apart || apart->linear > kTurn) return false;
      distance = apart->shift;
    }
    return moved_[i] + distance * units_.inner[i] <= options_.svg_distance;
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

  void add_value(int i, const std::string& name, const std::string& before,
                 const std::string& after, SvgChangeKind kind, const ValueDistance& found,
                 bool is_tolerated) {
    if (!count_one(kind, is_tolerated)) return;
    const double distance = found.is_number ? found.distance : 0.0;
    const auto [first, second] = excerpts(before, after, kMostShown);
    add({.kind = kind,
         .element = a_.path(i),
         .what = name,
         .baseline = first,
         .current = second,
         .distance = distance,
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
  const PictureOptions& options_;
  SvgMatch match_;
  SvgUnits units_;             ///< Of the baseline.
  std::vector<double> moved_;  ///< Pixels, by transforms that are within tolerance.
  std::vector<bool> remarks_a_, remarks_b_;
  std::map<std::string, std::string> new_id_;
  SvgDiff diff_;
  std::vector<SvgChange> tolerated_;
};

}  // namespace

SvgDiff svg_diff(const SvgTree& baseline, const SvgTree& current, const PictureOptions& options) {
  if (const std::string problem = problem_of(options); !problem.empty())
    throw InvalidInput(problem);
  return Differ(baseline, current, options).run();
}

}  // namespace mapproof
