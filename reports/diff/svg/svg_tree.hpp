#pragma once

#include <map>
#include <string>
#include <vector>

namespace mapproof {

/// An element of an SVG file.
struct SvgElement {
  std::string name;  ///< Without a prefix; of another name space than SVG's: "{name space}name".
  std::string id;    ///< Empty if it has none.
  /// Other attributes and the properties of `style`, which hold over attributes, by name.
  std::map<std::string, std::string> values;
  std::string text;  ///< Directly inside, white space as one blank.
  int parent = -1;
  int location = 0;  ///< Among its parent's children of that name, from 1.
  std::vector<int> children;
};

/// An SVG file: its elements in the order of their start tags, the root first.
struct SvgTree {
  std::vector<SvgElement> elements;
  std::string
      generator;  ///< Of a comment before the root: "Created with matplotlib …"; else empty.

  /// "svg/g#marks/circle[2]"
  std::string path(int element) const;
};

/// Which elements of two SVG files are the same one.
struct SvgMatch {
  std::vector<int> partner;  ///< Of each element of the baseline, in the current file; -1: removed.
  std::vector<int> back;     ///< The other way; -1: added.
  std::vector<bool>
      is_reordered;  ///< Of the baseline: it is drawn before or after others it was not.
};

/// Matches by id where both files have it, on elements of the same name, unless ids only count
/// ("line2d_7") and to another end; else below matched parents: first equal ones in order, then
/// what lies between them, so that the least differs. One element that is gone leaves the others
/// matched.
/// @note O(n) for files that agree but for little; at most 2^22 pairs of children are compared, the
///       rest is matched in order alone.
SvgMatch match_svgs(const SvgTree& baseline, const SvgTree& current);

/// How many pixels (1/96 inch) a user unit is long when a file is drawn in its own size, by
/// element: viewBox and size of the root, and transforms. A root without a size counts one a unit.
struct SvgUnits {
  std::vector<double> outer;  ///< Where the element is placed: its transform moves it by these.
  std::vector<double> inner;  ///< Within it: of its own geometry and of its children.
};

SvgUnits svg_units(const SvgTree& tree);

}  // namespace mapproof
