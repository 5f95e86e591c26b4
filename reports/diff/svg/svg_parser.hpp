#pragma once

#include <cstddef>
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

}  // namespace mapproof
