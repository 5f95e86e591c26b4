#pragma once

#include <cstddef>
#include <string>
#include <string_view>

#include "reports/diff/svg/svg_tree.hpp"

namespace mapproof {

inline constexpr std::size_t kMostSvgBytes = std::size_t{1} << 26;
inline constexpr std::size_t kMostSvgElements = std::size_t{1} << 19;
inline constexpr std::size_t kMostSvgDepth = 256;

/// @throws InvalidInput with the line and the reason if it is not well-formed XML with a root
/// `svg`,
///         exceeds the limits above, or holds what runs or loads something: entities, style
///         sheets of other files, and all that svg_active.hpp names. A DOCTYPE without declarations
///         is allowed and not followed.
SvgTree parse_svg(std::string_view bytes);

/// A name as expat gives it: "name space|name", or a name alone.
struct XmlName {
  std::string_view space;
  std::string_view local;
};

XmlName xml_name(std::string_view name);

/// What an element of a file runs or loads, in words: "a script element"; empty if nothing.
///
/// Refused are scripts, frames, media and HTML within SVG, whatever their case and name space: a
/// page that a viewer makes of the file may read names in another case, and runs HTML in it.
std::string active_element(const XmlName& element);

/// What an attribute runs or loads, in words; empty if nothing.
///
/// A reference may lead to a part of the file; that of an image also to an image in the file, that
/// of a link to a page by http, https or mailto, as nothing loads it before somebody clicks.
std::string active_attribute(const XmlName& element, const XmlName& attribute,
                             std::string_view value);

/// Whether CSS loads anything but a part of the file, an image or a font in the file. Escapes are
/// read as CSS reads them.
bool css_loads(std::string_view css);

/// The text without what browsers leave out of an address: control characters and blanks around
/// it, tabs and line breaks anywhere.
std::string cleaned_address(std::string_view address);

}  // namespace mapproof
