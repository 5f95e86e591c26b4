#pragma once

#include <map>
#include <string>
#include <string_view>
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
  int place = 0;  ///< Among its parent's children of that name, from 1.
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

inline constexpr std::size_t kMostSvgBytes = std::size_t{1} << 26;
inline constexpr std::size_t kMostSvgElements = std::size_t{1} << 19;
inline constexpr std::size_t kMostSvgDepth = 256;

/// @throws InvalidInput with the reason if it is not a well-formed SVG or exceeds the limits above,
/// or
///         holds what runs or loads something: entities, scripts, event handlers, references to
///         other files. A DOCTYPE without declarations is allowed and not followed.
SvgTree parse_svg(std::string_view bytes);

}  // namespace mapproof
